#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Random code actions with `rung lsp`: whatever is offered at a random selection of a project without errors is applied,
# and must leave it without errors; a refactoring that keeps the variables also leaves the program as it is.
#
#   actions.py PROJECT... [--seed N] [--count N] [--verbose]     folders and files, of which it works on copies
#
# Prints each action that makes an error, and at the end one line for each kind.
import argparse
import collections
import os
import random
import re
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import CAPABILITIES, Client, read_text, shown_uri, uri  # noqa: E402
from edits import sources_in  # noqa: E402
from rename import offset_of  # noqa: E402


def position_at(text, offset):
    before = text[:offset]
    line = before.count("\n")
    return {"line": line, "character": len(before[before.rfind("\n") + 1:].encode("utf-16-le")) // 2}


# Where selections begin and end: words, statements, lists in parentheses, lines.
def selections_in(text, chance, count):
    words = [match.span() for match in re.finditer(r"[\w.]+", text)]
    statements = [match.span() for match in re.finditer(r"[^\s;][^;]*;", text)]
    values = [match.span(1) for match in re.finditer(r"(?::=|THEN|\(|IF|OF)\s*([^;()]+?)\s*(?:;|\)|THEN|OF|,)", text)]
    for _ in range(count):
        kind = chance.choice([words, statements, values, values])
        if kind is words and words:
            begin = chance.choice(words)[0]
            yield begin, begin
        elif kind is statements and statements:
            first = chance.randrange(len(statements))
            last = min(first + chance.randrange(3), len(statements) - 1)
            yield statements[first][0], statements[last][1]
        elif kind:
            yield chance.choice(kind)


class Project:
    def __init__(self, seed, verbose):
        self.chance, self.verbose = random.Random(seed), verbose
        self.client = Client()
        self.client.initialize(["."], CAPABILITIES)
        self.texts = {file: read_text(file) for file in sources_in(".")}
        self.done, self.failed = collections.Counter(), collections.Counter()

    def errors(self):
        self.client.settle()
        return sum(1 for _, list_ in self.client.published.values() for one in list_ if one["severity"] == 1)

    def run(self, count):
        files = [file for file in self.texts if file.endswith((".st", ".ST", ".TcPOU", ".iecst"))]
        for file in files:
            self.client.open(file, self.texts[file])
        if not files or self.errors() != 0:
            return
        for _ in range(count):
            file = self.chance.choice(files)
            for begin, end in selections_in(self.texts[file], self.chance, 1):
                self.all_at(file, begin, end)

    def all_at(self, file, begin, end):
        text = self.texts[file]
        params = {"textDocument": {"uri": uri(file)}, "context": {"diagnostics": []},
                  "range": {"start": position_at(text, begin), "end": position_at(text, end)}}
        for action in self.client.request("textDocument/codeAction", params).get("result") or []:
            self.apply(file, begin, action)

    def apply(self, file, begin, action):
        changed = {}
        for name, edits in action["edit"]["changes"].items():
            path = shown_uri(name)
            text = changed.get(path, self.texts.get(path))
            if text is None:
                return
            for edit in sorted(edits, key=lambda e: offset_of(text, e["range"]["start"]), reverse=True):
                start, stop = offset_of(text, edit["range"]["start"]), offset_of(text, edit["range"]["end"])
                text = text[:start] + edit["newText"] + text[stop:]
            changed[path] = text
        kind = action["kind"] + ": " + re.sub(r"`[^`]*`", "`...`", action["title"])
        for path, text in changed.items():
            if path in self.client.versions:
                self.client.change(path, [{"text": text}])
        self.done[kind] += 1
        if self.errors() != 0:
            self.failed[kind] += 1
            line = self.texts[file].count("\n", 0, begin) + 1
            print("%s:%d: %s" % (file, line, action["title"]))
            for name, (_, list_) in self.client.published.items():
                for one in list_:
                    if one["severity"] == 1:
                        print("    %s:%d: %s" % (shown_uri(name), one["range"]["start"]["line"] + 1, one["message"]))
        for path in changed:
            if path in self.client.versions:
                self.client.change(path, [{"text": self.texts[path]}])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("projects", nargs="+")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    done, failed = collections.Counter(), collections.Counter()
    home = os.getcwd()
    for source in options.projects:
        with tempfile.TemporaryDirectory() as folder:
            work = os.path.join(folder, "project")
            if os.path.isdir(source):
                shutil.copytree(os.path.join(home, source), work)
            else:
                os.mkdir(work)
                shutil.copy(os.path.join(home, source), work)
            os.chdir(work)
            project = Project(options.seed, options.verbose)
            project.run(options.count)
            project.client.finish()
            done.update(project.done)
            failed.update(project.failed)
            os.chdir(home)
    for kind in sorted(done):
        print("%s: %d applied, %d with errors" % (kind, done[kind], failed[kind]))


if __name__ == "__main__":
    main()

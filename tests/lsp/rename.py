#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Random renames with `rung lsp`: the project with an unused name compiles to the C++ of before but for this name.
# A used name is refused, or leads to the same sources: renamed once more, they are as if renamed at once.
#
#   rename.py PROJECT... [--seed N] [--count N] [--verbose]     folders and files, of which it works on copies
#
# Prints each rename that fails, and at the end one line; with --verbose also how often what was refused.
import argparse
import collections
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import CAPABILITIES, Client, merged, read_text, uri  # noqa: E402
from edits import path_of, position_of, sources_in  # noqa: E402

NAMED = {"type", "class", "interface", "struct", "enum", "enumMember", "variable", "parameter", "property", "function",
         "method", "namespace"}
# What may be refused although the new name is unused.
REFUSED = ("is declared in a library", "has a meaning because of its name", "has its name from a file or a library",
           "the C++ body of", "there is no name here")
RENAMES_FILES = {"workspace": {"workspaceEdit": {"documentChanges": True, "resourceOperations": ["rename"]}}}
OTHERS = 30  # words of a project that are tried as names, beside those with a color: labels, steps, tasks, namespaces
SUFFIX = "0zq7"  # makes an unused name, and leaves it where it is in a sorted list
OF_LIBRARY = 8  # the modifier defaultLibrary


def offset_of(text, position):
    lines = re.split(r"(?<=\n)|(?<=\r)(?!\n)", text)
    before = sum(len(line) for line in lines[:position["line"]])
    line = lines[position["line"]] if position["line"] < len(lines) else ""
    return before + len(line.encode("utf-16-le")[:2 * position["character"]].decode("utf-16-le"))


class Project:
    def __init__(self, source, seed):
        self.random = random.Random(seed)
        self.source = source
        self.client = Client()
        answer = self.client.initialize(["."], merged(CAPABILITIES, RENAMES_FILES))
        self.types = answer["result"]["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"]
        self.texts = {file: read_text(file) for file in sources_in(".")}
        self.base = self.emitted(self.texts)
        self.names = [name for file in self.texts for name in self.names_in(file)]
        self.names += self.other_names()

    def other_names(self):
        words = [(file, match.start(), match.end()) for file, text in self.texts.items()
                 for match in re.finditer(r"(?<![\w#%])[A-Za-z_]\w*", text)]
        words = sorted(set(words) - set(self.names))
        found = []
        for file, begin, end in self.random.sample(words, min(OTHERS, len(words))):
            params = {"textDocument": {"uri": uri(file)}, "position": position_of(self.texts[file], begin)}
            answer = self.client.request("textDocument/prepareRename", params).get("result")
            if answer and answer["range"]["start"] == params["position"]:
                found.append((file, begin, end))
        return found

    # Of a file: its path, and where a name begins and ends.
    def names_in(self, file):
        answer = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri(file)}})["result"]
        text, line, character, found = self.texts[file], 0, 0, []
        data = answer["data"] if answer else []
        for i in range(0, len(data), 5):
            character = data[i + 1] + (character if data[i] == 0 else 0)
            line += data[i]
            if self.types[data[i + 3]] in NAMED and data[i + 4] & OF_LIBRARY == 0:
                begin = offset_of(text, {"line": line, "character": character})
                found.append((file, begin, begin + data[i + 2]))
        return found

    # The generated C++ by file, or None: the project has errors.
    def emitted(self, texts):
        with tempfile.TemporaryDirectory() as folder:
            inputs = os.path.join(folder, "in")
            shutil.copytree(".", inputs)
            for file in self.texts.keys() - texts.keys():  # those that have another name
                os.remove(os.path.join(inputs, file))
            for file, text in texts.items():
                with open(os.path.join(inputs, file), "w", encoding="utf-8", newline="") as stream:
                    stream.write(text)
            output = os.path.join(folder, "out")
            run = subprocess.run(["rung", "emit", ".", "-o", output, "--root=."], cwd=inputs, capture_output=True, text=True)
            if run.returncode != 0:
                return None
            return {name: read_text(os.path.join(output, name)) for name in sorted(os.listdir(output))
                    if name.endswith((".cpp", ".h", ".hpp"))}

    # The texts with the edits of an answer, and which files have other names then.
    def edited(self, texts, changes):
        result, moves = dict(texts), {}
        for change in changes:
            if change.get("kind") == "rename":
                moves[path_of(change["oldUri"])] = path_of(change["newUri"])
        for change in changes:
            if "edits" not in change:
                continue
            name, edits = change["textDocument"]["uri"], change["edits"]
            file = path_of(name)
            text = texts[file] if file in texts else self.texts.setdefault(file, read_text(file))
            for edit in reversed(edits):
                begin, end = (offset_of(text, edit["range"][side]) for side in ("start", "end"))
                text = text[:begin] + edit["newText"] + text[end:]
            result[file] = text
        return {moves.get(file, file): text for file, text in result.items()}, moves

    # The texts with another name, where the name is then, and why not.
    def renamed(self, texts, file, offset, name):
        params = {"textDocument": {"uri": uri(file)}, "position": position_of(texts[file], offset), "newName": name}
        answer = self.client.request("textDocument/rename", params)
        if "error" in answer:
            return None, (file, offset), answer["error"]["message"]
        changes = answer["result"]["documentChanges"]
        moved = offset
        for change in changes:
            if "edits" not in change or path_of(change["textDocument"]["uri"]) != file:
                continue
            for edit in change["edits"]:
                begin, end = (offset_of(texts[file], edit["range"][side]) for side in ("start", "end"))
                if begin < offset:
                    moved += len(edit["newText"]) - (end - begin)
        edited, moves = self.edited(texts, changes)
        return edited, (moves.get(file, file), moved), ""

    # ---- one rename, and what is wrong with it

    def fresh(self, file, begin, end):
        old = self.texts[file][begin:end]
        texts, _, refusal = self.renamed(self.texts, file, begin, old + SUFFIX)
        if texts is None:
            return refusal, "" if any(part in refusal for part in REFUSED) else "refused: " + refusal
        after = self.emitted(texts)
        if after is None:
            return "", "the project has errors then"
        return "", self.difference(after)

    # What is defined and declared in all files: names decide the order of both, and in which file a body is. Tables of
    # names have hashes of them, and where they begin in one text: their comments say what is in them.
    @staticmethod
    def shape(files):
        found = set()
        for name, text in files.items():
            text = re.sub(r"[ \t]+|// bodies from .*", " ", text.lower().replace(SUFFIX, ""))
            text = text.replace("_globals", "").replace("rung_inline ", "")
            text = re.sub(r'(assertion = \{"[^"]*", \d+), \d+', r"\1", text)  # the column
            if name == "sites.cpp":  # lines and columns
                continue
            if name == "module.cpp":
                found.update(re.findall(r"// .*", text))
                continue
            # Numbers of sites count in each file.
            text = re.sub(r"\bsites_code\w*( \+ \d+u)?|, \d+u(?=, )|\bat = \d+", "site", text)
            definition = []
            for line in text.split("\n"):
                if line.strip() == "" or line.startswith(("//", "namespace")):
                    continue
                definition.append(line)
                if line[0] != " " and not line.endswith(("{", ":")):
                    found.add("\n".join(definition))
                    definition = []
        return found

    def difference(self, after):
        before, then = self.shape(self.base), self.shape(after)
        changed = sorted(before - then) + sorted(then - before)
        return "there is another `%s`" % changed[0].split("\n")[0] if changed else ""

    def taken(self, file, begin, end):
        other_file, other_begin, other_end = self.random.choice(self.names)
        name = self.texts[other_file][other_begin:other_end]
        texts, moved, refusal = self.renamed(self.texts, file, begin, name)
        if texts is None:
            return "taken: " + refusal.split(": ")[-1], ""
        fresh = self.texts[file][begin:end] + SUFFIX
        direct, _, _ = self.renamed(self.texts, file, begin, fresh)
        changed = [changed_file for changed_file in texts if texts[changed_file] != self.texts.get(changed_file)]
        gone = [gone_file for gone_file in self.texts if gone_file not in texts]
        self.put_on_disk(texts, changed, gone)
        twice, _, refusal = self.renamed(texts, *moved, fresh)
        for new_file in texts.keys() - self.texts.keys():
            os.remove(new_file)
        self.put_on_disk(self.texts, [known for known in changed if known in self.texts] + gone,
                         texts.keys() - self.texts.keys())
        if twice != direct:
            return "", "renamed to `%s` and again, it is another project: %s" % (name, refusal)
        return "", ""

    def put_on_disk(self, texts, written, removed):
        for name in written:
            with open(name, "w", encoding="utf-8", newline="") as stream:
                stream.write(texts[name])
        for name in removed:
            if os.path.exists(name):
                os.remove(name)
        self.client.notify("workspace/didChangeWatchedFiles",
                           {"changes": [{"uri": uri(name), "type": 2} for name in [*written, *removed]]})

    def one(self):
        file, begin, end = self.random.choice(self.names)
        is_taken = self.random.random() < 0.3
        refusal, wrong = self.taken(file, begin, end) if is_taken else self.fresh(file, begin, end)
        if wrong:
            text = self.texts[file]
            line = text[:begin].count("\n") + 1
            print("%s: %s:%d `%s`: %s" % (self.source, file, line, text[begin:end], wrong))
        return refusal, not wrong


def run(source, seed, count, refusals):
    failed = done = 0
    here = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "project")
        if os.path.isdir(source):
            shutil.copytree(source, copy)
        else:
            os.mkdir(copy)
            shutil.copy(source, copy)
        os.chdir(copy)
        project = Project(source, seed)
        for _ in range(count if project.base and project.names else 0):
            refusal, ok = project.one()
            failed += not ok
            done += 1
            if refusal:
                refusals[re.sub(r"`[^`]*`", "`…`", refusal)] += 1
        project.client.finish()
        os.chdir(here)
    return done, failed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("projects", nargs="+")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10, help="renames of each project")
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    refusals = collections.Counter()
    done = failed = 0
    for number, source in enumerate(arguments.projects):
        renames, wrong = run(os.path.abspath(source), arguments.seed + number, arguments.count, refusals)
        done += renames
        failed += wrong
    if arguments.verbose:
        for refusal, times in refusals.most_common():
            print("%6d  %s" % (times, refusal))
    print("%d renames, %d failed" % (done, failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Completions at random places of real sources: a name is taken out, and each name that the server offers there is put in.
# In: projects, of which it works on copies. Out: at how many places what is offered first leads to a program without a new
# error, and the errors of the others by how often. A measure, not a test: the part of good places should grow.
#
#   completions.py PROJECT... [--seed N] [--count N] [--items N]
import argparse
import collections
import os
import random
import re
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import CAPABILITIES, Client, merged, read_text, uri  # noqa: E402
from edits import position_of, sources_in  # noqa: E402
from rename import NAMED, offset_of  # noqa: E402

DECLARATION = 1  # the modifier of semantic tokens
WITHOUT_SNIPPETS = merged(CAPABILITIES, {"textDocument": {"completion": {"completionItem": {"snippetSupport": False}}}})


class Session:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.client = Client()
        legend = self.client.initialize(["."], WITHOUT_SNIPPETS)["result"]["capabilities"]["semanticTokensProvider"]["legend"]
        self.types = legend["tokenTypes"]
        self.texts = {file: read_text(file) for file in sources_in(".") if file.lower().endswith((".st", ".tcpou"))}
        self.places = [place for file in self.texts for place in self.uses_in(file)]

    # The names in code that are not declarations.
    def uses_in(self, file):
        answer = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri(file)}})["result"]
        line, character, found, data = 0, 0, [], answer["data"] if answer else []
        for i in range(0, len(data), 5):
            character = data[i + 1] + (character if data[i] == 0 else 0)
            line += data[i]
            if self.types[data[i + 3]] in NAMED and data[i + 4] & DECLARATION == 0:
                begin = offset_of(self.texts[file], {"line": line, "character": character})
                found.append((file, begin, begin + data[i + 2]))
        return found

    # How often each error is in the project, with another text of the open file.
    def errors_with(self, file, text):
        self.client.change(file, [{"text": text}])
        self.client.settle()
        return collections.Counter(
            (re.sub(r"`[^`]*`", "`…`", diagnostic["message"].split("\n")[0]))
            for _, diagnostics in self.client.published.values() for diagnostic in diagnostics
            if diagnostic["severity"] == 1)

    # What is offered where a name was, the first rank only.
    def offered(self, file, begin, end):
        text = self.texts[file]
        self.client.change(file, [{"text": text[:begin] + text[end:]}])
        params = {"textDocument": {"uri": uri(file)}, "position": position_of(text, begin)}
        items = self.client.request("textDocument/completion", params)["result"]["items"]
        best = min((item["sortText"][0] for item in items), default="")
        return [item["textEdit"]["newText"] for item in items if item["sortText"][0] == best]

    # The errors that came with the offered names, at most `most` of them tried; none: nothing was offered.
    def one(self, most, causes):
        file, begin, end = self.random.choice(self.places)
        text = self.texts[file]
        self.client.open(file, text)
        base = self.errors_with(file, text)
        names = self.offered(file, begin, end)
        is_good = True
        for name in self.random.sample(names, min(most, len(names))):
            new = self.errors_with(file, text[:begin] + name + text[end:]) - base
            causes.update(new.keys())
            is_good = is_good and not new
        self.client.close(file)
        return is_good if names else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("projects", nargs="+")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20, help="places of each project")
    parser.add_argument("--items", type=int, default=3, help="names that are tried at each place")
    arguments = parser.parse_args()
    causes, results = collections.Counter(), collections.Counter()
    here = os.getcwd()
    for number, source in enumerate(arguments.projects):
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, "project")
            shutil.copytree(source, copy)
            os.chdir(copy)
            session = Session(arguments.seed + number)
            for _ in range(arguments.count if session.places else 0):
                results[session.one(arguments.items, causes)] += 1
            session.client.finish()
            os.chdir(here)
    for cause, times in causes.most_common():
        print("%6d  %s" % (times, cause))
    print("%d places: %d without a new error, %d with one, at %d nothing is offered"
          % (sum(results.values()), results[True], results[False], results[None]))


if __name__ == "__main__":
    main()

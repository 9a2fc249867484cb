#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Completions at random places of real sources: a name is taken out, and what the server offers there is put in, as an
# editor would do it, with the default texts of the places of a snippet. In: projects, of which it works on copies. Out: at
# how many places everything that was tried leads to a program without an error that the project did not have; and the
# others by cause: where, what was offered, and the message.
#
#   completions.py PROJECT... [--seed N] [--count N] [--items N] [--letters N] [--verbose]
#
# A place is any name in code that is not a declaration. `--items`: as many of what is offered are tried, at random, of all
# ranks. `--letters`: so many letters of the name stay in the text, as if they had been typed; names of libraries are
# offered then too. Where nothing is offered the place is not counted.
# A measure, not a test: the part of good places should grow.
import argparse
import collections
import os
import random
import re
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
from client import CAPABILITIES, Client, read_text, uri  # noqa: E402
from edits import position_of, sources_in  # noqa: E402
from rename import NAMED, offset_of  # noqa: E402

DECLARATION = 1  # the modifier of semantic tokens
KINDS = {2: "method", 3: "function", 5: "field or pin", 6: "variable", 7: "block", 8: "interface", 9: "list", 10: "property",
         13: "enumeration", 14: "keyword", 15: "snippet", 20: "item", 21: "constant", 22: "structure", 25: "type"}


# The text with the first texts of its places.
def accepted(item):
    text = item["textEdit"]["newText"]
    if item.get("insertTextFormat") != 2:
        return text
    return re.sub(r"\$\{\d+:([^}]*)\}|\$\{\d+\}|\$\d+", lambda match: match[1] or "", text)


class Session:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.tried = collections.Counter()  # by whether they are good
        self.client = Client()
        legend = self.client.initialize(["."], CAPABILITIES)["result"]["capabilities"]["semanticTokensProvider"]["legend"]
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

    # What is offered where a name was, of which some letters stay.
    def offered(self, file, begin, end):
        text = self.texts[file]
        self.client.change(file, [{"text": text[:begin] + text[end:]}])
        params = {"textDocument": {"uri": uri(file)}, "position": position_of(text, begin)}
        return self.client.request("textDocument/completion", params)["result"]["items"]

    # What the place is, by the tokens around it.
    def kind_of(self, text, begin, end):
        before = re.sub(r"\(\*.*?\*\)|//[^\n]*", " ", text[max(0, begin - 400):begin], flags=re.S)
        last = re.findall(r"[A-Za-z_]\w*|:=|=>|<>|<=|>=|\S", before)
        following = re.match(r"\s*(:=|=>|[A-Za-z_]\w*|\S)?", text[end:])[1] or "nothing"
        if re.match(r"[A-Za-z_]", following) and following.upper() not in ("THEN", "DO", "OF", "TO", "AND", "OR"):
            following = "name"
        before = last[-1] if last else "nothing"
        if re.match(r"[A-Za-z_]", before) and before.upper() not in ("THEN", "IF", "OF", "AND", "OR", "NOT", "ELSIF"):
            before = "name"
        return "%s | %s" % (before, following)

    # Whether all that was tried is good, at most `most` of what is offered; none: nothing was offered.
    def one(self, most, letters, causes, verbose):
        file, begin, end = self.random.choice(self.places)
        begin, first = min(begin + letters, end), begin
        text = self.texts[file]
        if file not in self.client.versions:
            self.client.open(file, text)
        base = self.errors_with(file, text)
        items = self.offered(file, begin, end)
        is_good = True
        for item in self.random.sample(items, min(most, len(items))):
            new = self.errors_with(file, text[:first] + accepted(item) + text[end:]) - base
            for message in new:
                causes[(self.kind_of(text, first, end), KINDS.get(item["kind"], "?"), message)] += 1
            if new and verbose:
                line = text[:begin].count("\n") + 1
                print("%s:%d `%s` becomes `%s`: %s" % (file, line, text[first:end], accepted(item), next(iter(new))))
            self.tried[not new] += 1
            is_good = is_good and not new
        self.client.change(file, [{"text": text}])
        return is_good if items else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("projects", nargs="+")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20, help="places of each project")
    parser.add_argument("--items", type=int, default=5, help="how many of what is offered are tried at each place")
    parser.add_argument("--letters", type=int, default=0, help="letters of the name that stay")
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    client.SECONDS = 36000
    causes, results, tried = collections.Counter(), collections.Counter(), collections.Counter()
    here = os.getcwd()
    for number, source in enumerate(arguments.projects):
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, "project")
            shutil.copytree(source, copy)
            os.chdir(copy)
            session = Session(arguments.seed + number)
            for _ in range(arguments.count if session.places else 0):
                results[session.one(arguments.items, arguments.letters, causes, arguments.verbose)] += 1
            tried.update(session.tried)
            session.client.finish()
            os.chdir(here)
    for (place, kind, message), times in causes.most_common():
        print("%6d  %-12s %-12s %s" % (times, place, kind, message))
    print("%d of %d that were tried are good" % (tried[True], tried[True] + tried[False]))
    counted = results[True] + results[False]
    print("%d places: %d of %d where something is offered without a new error (%.1f %%)"
          % (counted + results[None], results[True], counted, 100 * results[True] / max(1, counted)))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""Looks for the phrases of phrases.tsv: in comments and strings of the code, in doc comments of the libraries, in the
prose of the docs (not in code blocks and back-quoted words). Prints file:line, the phrase and what to write. Called by
checks/phrases.sh."""
import os
import re
import sys

from sources import HOUSE, TOKEN, read, tracked

NOT_SEARCHED = re.compile(r"^(docs/compliance[-\w]*\.md|tests/conformance/features\.tsv|tools/house/phrases\.|tests/golden/|LICENSE)")

ST_COMMENT = re.compile(r"//[^\n]*|\(\*.*?\*\)|'[^'\n]*'", re.S)


def prose_of_code(source):
    """(line, prose) of each comment and each string that reads like a sentence."""
    for match in TOKEN.finditer(source):
        token = match.group()
        if token[0] == "#" or (token[0] in "\"'R" and " " not in token):
            continue
        first = source.count("\n", 0, match.start()) + 1
        for offset, line in enumerate(token.split("\n")):
            yield first + offset, line


def prose_of_library(source):
    for match in ST_COMMENT.finditer(source):
        if match.group().startswith("'"):
            continue
        first = source.count("\n", 0, match.start()) + 1
        for offset, line in enumerate(match.group().split("\n")):
            yield first + offset, line


def prose_of_page(source):
    fence = None
    for number, line in enumerate(source.split("\n"), 1):
        mark = re.match(r"(`{3,})", line)
        if fence is None and mark:
            fence = mark.group(1)
        elif fence is not None:
            if line == fence:
                fence = None
        elif not line.startswith("    "):
            yield number, line


def prose_of_script(source):
    for number, line in enumerate(source.split("\n"), 1):
        if "#" in line:
            yield number, line[line.index("#"):]


def prose_of(path, source):
    if path.endswith((".cpp", ".h", ".def")):
        return prose_of_code(source)
    if path.endswith(".st"):
        return prose_of_library(source) if path.startswith("stdlib/") else ()
    if path.endswith(".md"):
        return prose_of_page(source)
    return prose_of_script(source)


def main():
    rules = []
    for line in open(os.path.join(HOUSE, "phrases.tsv"), encoding="utf-8"):
        if line.strip() and not line.startswith("#"):
            pattern, instead, *allowed = line.rstrip("\n").split("\t")
            rules.append((re.compile(pattern, re.I), instead, re.compile(allowed[0], re.I) if allowed else None))
    quick = re.compile("|".join(f"(?:{pattern.pattern})" for pattern, _, _ in rules), re.I)
    found = 0
    for path in tracked(".md", ".cpp", ".h", ".def", ".st", ".sh", ".txt", ".cmake"):
        if NOT_SEARCHED.match(path):
            continue
        source = read(path)
        if not quick.search(source):
            continue
        for number, line in prose_of(path, source):
            line = re.sub(r"`[^`]*`", "``", line)
            if not quick.search(line):
                continue
            for pattern, instead, allowed in rules:
                match = pattern.search(line)
                if match and not (allowed and allowed.search(line)):
                    print(f"{path}:{number}: \"{match.group()}\"; write: {instead}")
                    found += 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

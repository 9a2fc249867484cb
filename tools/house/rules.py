#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares each rule of sema/checks/rules.def with its file and its pages.

The head of a rule's file is the source of its pages: docs/errors/CODE.md quotes, below its title, the first sentence of
the head. Prints what differs; with --write the pages get the sentence.
  tools/house/rules.py [--write]
"""
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = ROOT / "sema/checks/rules.def"


def rules():
    """Of each row: its file and its messages as (code, name)."""
    found = []
    for line in LIST.read_text().splitlines():
        if row := re.match(r"RUNG_RULE\(\w+, (\w+), (\w+)\)", line):
            found.append((row[1], row[2], []))
        elif message := re.match(r"RUNG_(?:ERROR|WARNING|INFO)\((\w+), (\w+),", line):
            found[-1][2].append((message[1], message[2]))
    return found


def head(source):
    """The comment on top of a file, without the licence."""
    lines = []
    for line in source.splitlines()[1:]:
        if not line.startswith("//"):
            break
        lines.append(line[2:])
    return lines


def first_sentence(lines):
    text = " ".join(line.strip() for line in lines if not line.startswith("   "))
    return re.match(r".*?[.](?= [A-Z]|$)", text)[0]


def quoted(sentence):
    return textwrap.fill(sentence, 138, initial_indent="> ", subsequent_indent="> ", break_long_words=False,
                         break_on_hyphens=False)


def with_quote(page, quote):
    title, *rest = page.splitlines()
    while rest and rest[0].startswith(">"):
        rest.pop(0)
    if rest and rest[0] == "":
        rest.pop(0)
    return "\n".join([title, quote, "", *rest]) + "\n"


def main():
    problems = []
    for name, function, messages in rules():
        path = ROOT / f"sema/checks/{name}.cpp"
        source = path.read_text()
        lines = head(source)
        if not re.match(r" (Forbids|Warns) ", lines[0] if lines else ""):
            problems.append(f"{path}:2: the head of a rule begins with `Forbids` or `Warns of`")
            continue
        if not any(re.match(r"   (fails|warns) ", line) for line in lines):
            problems.append(f"{path}:2: the head shows no program that fails")
        if not re.search(rf"^void {function}\(", source, re.MULTILINE):
            problems.append(f"{path}: does not define {function}")
        quote = quoted(first_sentence(lines))
        for code, message in messages:
            if f"diag::{message}" not in source:
                problems.append(f"{path}: does not report {message}, which {LIST.name} has below its row")
            page = ROOT / f"docs/errors/{code}.md"
            if not page.exists():
                continue  # checks/codes.sh tells
            text = page.read_text()
            if text == with_quote(text, quote):
                continue
            if "--write" in sys.argv:
                page.write_text(with_quote(text, quote))
            else:
                problems.append(f"{page}:2: is not the first sentence of {name}.cpp; run tools/house/rules.py --write")
    for problem in problems:
        print(problem.replace(f"{ROOT}/", ""))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())

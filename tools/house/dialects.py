#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The table of dialects as a page, and the rule that nobody else knows them.  dialects.py [--check]

In: frontend/source/dialects.def and the C++ sources. Out: docs/dialects.md; with --check nothing is written, but a stale
page, a feature that nobody asks for and a source that asks which dialect it has are printed. Exit code 1 if there are any.
Called by tools/house/checks.
"""
import os
import re
import sys

from sources import ROOT, code_only, read, tracked

TABLE = "frontend/source/dialects.def"
PAGE = "docs/dialects.md"
# Names of dialects stand where one is chosen: the default, the first guess of `rung init`, the profiles of the suite.
CHOOSERS = {"frontend/source/dialect.h", "frontend/source/dialect.cpp", "tools/driver/init.cpp",
            "tools/conformance/program.h", "tools/conformance/suite.cpp", "tools/conformance/trial.cpp"}
DIALECT = re.compile(r'RUNG_DIALECT\((\w+),\s*"([^"]+)",\s*(true|false),\s*"([^"]+)"\)')
ROW = re.compile(r'RUNG_FEATURES\("([^"]+)"\)|RUNG_FEATURE\(\(([^)]*)\),\s*(\w+),\s*"((?:[^"\\]|\\.)*)"\)')
# A column is picked without a question for Rung's own files.
QUESTION = re.compile(r'\bDialect::(?!Library\b)\w+|[!=]=\s*\w*[dD]ialect\b|\b[dD]ialect_?\s*[!=]=|\bprofile_?\.name\s*[!=]=')


def rows(text):
    """Titles as strings, features as (name, meaning, cells)."""
    for match in ROW.finditer(text):
        title, cells, name, meaning = match.groups()
        yield title if title else (name, meaning, [cell.strip() for cell in cells.split(",")])


def page(text):
    dialects = DIALECT.findall(text)
    lines = ["# Dialects", "",
             "What differs between the dialects of `--std`. Each row is a question that the compiler asks; the name in the last",
             "column is that of the feature in `%s`, from which `tools/house/dialects.py` makes this page." % TABLE,
             "[Languages](language.md#dialects) explains the rows with their sources.", ""]
    for _, name, chosen, meaning in dialects:
        lines.append("- `%s`: %s%s" % (name, meaning, "" if chosen == "true" else "; not a value of `--std`"))
    head = "| | " + " | ".join("`%s`" % name for _, name, _, _ in dialects) + " | feature |"
    for row in rows(text):
        if isinstance(row, str):
            lines += ["", "## " + row, "", head, "|---|" + "---|" * (len(dialects) + 1)]
            continue
        name, meaning, cells = row
        shown = " | ".join("yes" if cell == "yes" else "–" for cell in cells)
        lines.append("| %s | %s | `%s` |" % (meaning.replace("|", "\\|"), shown, name))
    return "\n".join(lines) + "\n"


def questions(features):
    found, asked = [], set()
    for path in tracked(".cpp", ".h"):
        if path.startswith("tests/"):
            continue
        code = code_only(read(path))
        if path not in CHOOSERS:
            for match in QUESTION.finditer(code):
                line = code.count("\n", 0, match.start()) + 1
                found.append("%s:%d: `%s`: ask for a feature of %s" % (path, line, match.group(), TABLE))
        asked |= set(re.findall(r"\.(\w+)", code))
    found += ["%s: nobody asks for `%s`" % (TABLE, name) for name in features if name not in asked]
    return found


def main():
    text = read(TABLE)
    made = page(text)
    if "--check" not in sys.argv[1:]:
        with open(os.path.join(ROOT, PAGE), "w", encoding="utf-8") as file:
            file.write(made)
        return 0
    found = questions([row[0] for row in rows(text) if not isinstance(row, str)])
    if not os.path.isfile(os.path.join(ROOT, PAGE)) or read(PAGE) != made:
        found.append("%s is stale: run tools/house/dialects.py" % PAGE)
    print("".join(line + "\n" for line in found), end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the rows that a test names in its `features:` and `covers:` lines with the test: a row must occur in its program,
and a value that depends on it must be asserted, printed by a session, or in a line that a diagnostic names.
  tools/compliance/evidence.py [FILE...]      prints each row without evidence; fails when there is one
  tools/compliance/evidence.py --undecided    prints the rows that no pattern decides, with the reasons
evidence.tsv, beside this script, has a pattern for each row or family of rows of the standard's tables, or the reason why none
decides; tests/conformance/rules.tsv has one for each rule of a manual that a test covers. A row of a manual without a line is a
name, and must occur as one. flow.py says what an assertion depends on.
Called by the checks before a commit and by the runner of the tests, at the end of a full run."""
import fnmatch
import pathlib
import re
import sys

from flow import Program

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).with_name("evidence.tsv")
FOLDERS = ("tests/conformance", "tests/programs")
KINDS = (".st", ".xml", ".test", ".txt")
# A name of a catalogue may have a prefix for its chapter, and say which of several things of that name it is.
CHAPTER = re.compile(r"^(?:IL|SFC|LD|FBD|CFC):")
WHICH = re.compile(r"_\([a-z]\w*\)$")


class Table:
    """Patterns of evidence.tsv. `~` in a row stands for any text. An exact row wins over a family, a later family over an earlier one.
    In a pattern, `@(...)` is the place that counts, and:
      <name>            the first word of a row of the standard's tables, or the name that a row of a catalogue has
      <number> <stem>   of a name such as MR31 or 16#31, and of one such as INT_TO_<TYPE>
      <in WORD>         after WORD and before its END_WORD
      <section VAR_X>   after VAR_X and before END_VAR
      <il>              the begin of a line of IL, with its label
      text:             before the pattern: comments count, too"""

    def __init__(self):
        self.features = {}
        for line in (ROOT / "tests/conformance/features.tsv").read_text().splitlines()[1:]:
            row, editions, name = line.split("\t")
            if editions:
                self.features[row] = name
        self.exact, self.families, self.problems, self.used = {}, [], [], set()
        for number, line in enumerate(TABLE.read_text().splitlines()[1:], 2):
            if not line or line.startswith("#"):
                continue
            rows, pattern, reason = line.split("\t")
            if bool(pattern) == bool(reason):
                self.problems.append(f"{TABLE.name}:{number}: a row has a pattern or a reason why there is none")
            for row in rows.split():
                if row in self.exact:
                    self.problems.append(f"{TABLE.name}:{number}: `{row}` is in line {self.exact[row][2]}, too")
                entry = (pattern, reason, number, row)
                if "~" in row:
                    self.families.append((re.sub(r"([\[?*])", r"[\1]", row).replace("~", "*"), entry))
                else:
                    self.exact[row] = entry
        self.rules = {}
        for line in (ROOT / "tests/conformance/rules.tsv").read_text().splitlines()[1:]:
            rule, _, pattern, text = line.split("\t")
            self.rules["rule:" + rule] = pattern, text

    def entry(self, row):
        """The pattern of a row, with its macros replaced, or the reason why there is none; two None when it has no line."""
        if row.startswith("rule:"):
            self.used.add(row)
            pattern = self.rules.get(row, (None, None))[0]
            return (self.replaced(pattern, row), "") if pattern else (None, None)
        found = self.exact.get(row) or next((entry for family, entry in reversed(self.families)
                                             if fnmatch.fnmatchcase(row, family)), None)
        if found is None and row in self.features:
            return None, None
        pattern, reason = found[:2] if found else ("<name>", "")
        self.used.add(found[3] if found else row)
        return self.replaced(pattern, row), reason

    def replaced(self, pattern, row):
        name = re.match(r"\w*", self.features[row]).group() if row in self.features else row.partition(":")[2] or row
        name = WHICH.sub("", CHAPTER.sub("", name))
        quoted = (r"(?<!\w)" if name[:1].isalnum() else "") + re.escape(name) + (r"(?!\w)" if name[-1:].isalnum() else "")
        number = re.search(r"(?:16#|MR|MW)(\w+)$", row)
        for macro, text in (("<name>", quoted), ("<number>", number.group(1) if number else ""), ("<stem>", name.partition("_TO_")[0]),
                            ("<il>", r"^[ \t]*(?:\w+:[ \t]*)?")):
            pattern = pattern.replace(macro, text)
        pattern = re.sub(r"<in (\w+)>", lambda found: inside(rf"\b{found.group(1)}", f"END_{found.group(1)}"), pattern)
        pattern = re.sub(r"<section ([^<>]+)>", lambda found: inside(rf"\b{found.group(1)}", "END_VAR"), pattern)
        first, *parts = pattern.split("@(")
        return first + "".join(f"(?P<place{number}>{part}" for number, part in enumerate(parts))


def inside(first, last):
    return rf"{first}\b(?:(?!\b{last.replace('END_INITIAL_', 'END_')}\b)[\s\S])*?"


def tests():
    names = re.compile(r"^(?://|#|<!--) (?:features|covers):", re.M)
    return [file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*"))
            if file.suffix in KINDS and names.search(file.read_text(errors="replace"))]


def main():
    table = Table()
    files = [pathlib.Path(name).resolve() for name in sys.argv[1:] if not name.startswith("--")]
    undecided = {}
    problems = table.problems
    for file in files or tests():
        program = Program(file)
        for row in program.rows["features"] + program.rows["covers"]:
            pattern, reason = table.entry(row)
            name = f"`{row}`" + (f", {table.features[row]}," if row in table.features else "")
            if pattern is None:
                problems.append(f"{name} has no pattern in {'rules.tsv' if row.startswith('rule:') else TABLE.name}")
            elif reason:
                undecided.setdefault(reason, set()).add(row)
            else:
                lack = program.lacks(re.compile(pattern.removeprefix("text:"), re.I | re.M), pattern.startswith("text:"),
                                     row.startswith("nct-language:"))
                if lack:
                    problems.append(f"{file.relative_to(ROOT)} names {name} without evidence: {lack}")
    if not files:
        lines = {**table.exact, **{entry[3]: entry for _, entry in table.families}}
        problems += [f"{TABLE.name}:{entry[2]}: no test names `{row}`" for row, entry in lines.items() if row not in table.used]
        problems += [f"rules.tsv: no test covers `{row}`; remove its pattern" for row, (pattern, _) in table.rules.items()
                     if pattern and row not in table.used]
    if "--undecided" in sys.argv:
        print("\n".join(f"{' '.join(sorted(rows))}: {reason}" for reason, rows in undecided.items()))
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())

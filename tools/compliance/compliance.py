#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the statements of compliance: what each standard and manual lists, whether Rung supports it, and the tests.
  docs/compliance.md           edition 3 of IEC 61131-3 (tests/conformance/features.tsv), and an overview of all pages
  docs/compliance-edition2.md  edition 2 (edition2.tsv), whose features are proved by rows of edition 3
  docs/compliance-edition4.md  edition 4 (features.tsv): what is new, what it no longer has, and the rest
  docs/compliance-motion.md    PLCopen's form for motion part 1 (plcopen_motion.tsv, comments in motion_comments.tsv), compared
                               with the blocks as `rung list` prints them
  docs/compliance-manuals.md   the names of the manuals, by chapter (chapters.tsv)
  docs/compliance-rules.md     rules of the manuals (rules.tsv), in our words
A row is supported when tests name it and all of them passed, and not supported when none does.
  tools/compliance/compliance.py [--check] [build/test-results.tsv]   --check: writes nothing, fails when a page is stale
Takes the results of a full run of the test runner, which calls this with --check at its end. BUILD names the build folder."""
import difflib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("BUILD", "build")
DATA = ROOT / "tests/conformance"
MADE = "Made from a run of all tests by `tools/compliance/compliance.py`; do not edit."
CATALOGUES = {  # in the order of the page: those of manuals have chapters
    "tm-tp-language": "TM/TP manual, chapters 1 to 5", "tm-tp-library": "TM/TP manual, chapters 6 to 10",
    "motion": "Motion: TM/TP manual, chapter 7, and AX manual, chapters 7 and 8", "ax-series": "AX manual",
    "iec-syntax": "Syntax manual", "nct-language": "NCT manual, the language", "nct-nc-interface": "NCT manual, the interface",
    "codesys": "CODESYS", "twincat": "TwinCAT", "beremiz": "Beremiz"}
MANUALS = {"tm-tp": "TM/TP manual", "iec-syntax": "Syntax manual", "nct": "NCT manual", "ax": "AX manual"}  # those with rules
# Of PLCopen's appendix A 2: the data types that the specification uses; then the derived ones, with their structure here.
BASIC = ("BOOL", "INT", "WORD", "DWORD", "REAL", "UINT")


def table(name):
    """The rows of a .tsv file below its heading."""
    return [line.split("\t") for line in (DATA / name).read_text().splitlines()[1:]]


def escaped(text):
    return re.sub(r"[*|<>]", r"\\\g<0>", text)


class Tests:
    """Which files prove a feature or a name, from the results of a run."""

    def __init__(self, file):
        self.files, self.failed, self.names = {}, set(), []
        for line in file.read_text().splitlines()[1:]:
            path, _, status, features, covers = line.split("\t")
            for word in (features + " " + covers).split():
                named = self.files.setdefault(word, [])
                if path not in named:
                    named.append(path)
                if status != "passed":
                    self.failed.add(word)
            self.names += covers.split()
        self.names = sorted({name for name in self.names if not name.startswith("rule:")}, key=str.encode)

    def status(self, words):
        if not words or any(word not in self.files for word in words):
            return "not supported"
        return "fails" if any(word in self.failed for word in words) else "supported"

    def links(self, words):
        files = []
        for word in words:
            files += [file for file in self.files.get(word, []) if file not in files]
        return ", ".join(link(file) for file in files)


def link(file):
    name = re.sub(r"^tests/(conformance/\w+/)?", "", file)
    return f"[{re.sub(r'/test[.]txt$|[.][a-z]+$', '', name)}](../{file})"


class Section:
    """One table of a page."""

    def __init__(self, title):
        self.title, self.rows, self.supported = title, [], 0

    def add(self, number, name, status, tests, reason=""):
        self.supported += status == "supported"
        self.rows.append(f"| {number} | {escaped(name)} | {status}{': ' + escaped(reason) if reason else ''} | {tests} |")

    def text(self, head="feature"):
        return "\n".join([f"## {escaped(self.title)}", "", f"| {head} | what it is | status | tests |", "|---|---|---|---|",
                          *self.rows, ""])


def counted(sections):
    return sum(section.supported for section in sections), sum(len(section.rows) for section in sections)


def overview(sections):
    lines = ["| table | supported | features |", "|---|---|---|"]
    return lines + [f"| {escaped(section.title)} | {section.supported} | {len(section.rows)} |" for section in sections]


def page(title, introduction, sections, head="feature", noun="features"):
    done, of = counted(sections)
    lines = [f"# {title}", "", MADE, *introduction, "", f"{done} of {of} {noun} are supported.", "", *overview(sections), ""]
    return "\n".join(lines) + "\n" + "\n".join(section.text(head) for section in sections)


# ---- the standard

def titleOf(number, name):
    return f"Table {number}: {name}" if number[0].isdigit() else name


def standard(tests, wanted):
    """The tables of the rows that `wanted` accepts, by the editions that have them."""
    sections, current = {}, None
    for row, editions, name in table("features.tsv"):
        if not editions:
            current = row, titleOf(row, name)
            continue
        if not wanted(editions):
            continue
        section = sections.setdefault(current[0], Section(current[1]))
        section.add(row.split("/", 1)[1], name, tests.status([row]), tests.links([row]))
    return list(sections.values())


def edition2(tests):
    sections = []
    for row, proofs, name, reason in table("edition2.tsv"):
        if "/" not in row:
            sections.append(Section(f"Table {row}: {name}"))
            continue
        words = proofs.split()
        number = row.split("/", 1)[1] or f"(ed. 3: {proofs})"
        sections[-1].add(number, name, tests.status(words), tests.links(words), reason)
    return sections


# ---- PLCopen motion

def declared(name):
    """The pins of a block, name in upper case -> (name, role, type), and the file of its declaration; or None."""
    result = subprocess.run([BUILD / "bin/rung", "list", f"--signature={name}", "--format=json"], cwd=ROOT,
                            capture_output=True, text=True)
    if result.returncode != 0:
        return None
    found = next((one for one in json.loads(result.stdout) if one["file"].startswith("motion/")), None)
    if found is None:
        return None
    text = re.sub(r"///?[^\n]*|\{[^{}]*\}", "", found["declaration"])
    pins = {}
    for section, body in re.findall(r"VAR_(INPUT|OUTPUT|IN_OUT)\b(?: CONSTANT)?(.*?)END_VAR", text, re.S):
        role = {"INPUT": "IN", "OUTPUT": "OUT", "IN_OUT": "INOUT"}[section]
        for names, type_name in re.findall(r"([\w\s,]+?)\s*:\s*([^;:=]+?)\s*(?::=[^;]*)?;", body):
            for pin in names.split(","):
                pins[pin.strip().upper()] = (pin.strip(), role, type_name.strip())
    return pins


def motion(tests):
    specified, blocks = {}, {}
    for block, pin, role, type_name, level in table("plcopen_motion.tsv"):
        specified.setdefault(block, []).append((pin, role, type_name, level))
    comments = {(block, pin): comment for block, pin, comment in table("motion_comments.tsv")}
    by_name = {}  # tests by the name of a block, in whatever catalogue
    for word in tests.names:
        by_name.setdefault(word.rpartition(":")[2].upper(), []).append(word)
    blocks = {block: declared(block) for block in specified}
    here = {block: pins for block, pins in blocks.items() if pins is not None}
    levels = {level: [0, 0] for level in "BEV"}
    details = []
    for block, pins in specified.items():
        details += [f"### {block}", "", f"| {block} | supported | comments |", "|---|---|---|"]
        for role, heading in (("INOUT", "VAR_IN_OUT"), ("IN", "VAR_INPUT"), ("OUT", "VAR_OUTPUT")):
            some = [pin for pin in pins if pin[1] == role]
            if some:
                details.append(f"| **{heading}** | | |")
            for pin, _, type_name, level in some:
                mine = (blocks[block] or {}).get(pin.upper())
                is_here = mine is not None and mine[1] == role
                comment = comments.get((block, pin)) or comments.get(("", pin), "") if not is_here else ""
                if blocks[block] is None:
                    comment = ""
                if is_here and mine[2].upper() != type_name.rstrip("_").upper():
                    comment = f"type {mine[2]}"
                levels[level][0] += is_here
                levels[level][1] += 1
                details.append(f"| {level} {pin} | {'Yes' if is_here else 'No'} | {escaped(comment)} |")
        if blocks[block]:
            extra = [f"{pin} : {type_name}" for key, (pin, _, type_name) in blocks[block].items()
                     if key not in {one[0].upper() for one in pins}]
            details += [f"| V {escaped(one)} | Yes | supplier's own |" for one in extra]
        details.append("")
    used = {}
    for block, pins in specified.items():
        for _, _, type_name, _ in pins:
            used.setdefault(type_name, []).append(block)
    mine = {}
    for block, pins in here.items():
        for pin, role, type_name, _ in specified[block]:
            found = pins.get(pin.upper())
            if found is not None and found[1] == role:
                mine.setdefault(type_name, set()).add(found[2])
    lines = ["# Statement of the supplier: PLCopen motion control, part 1, version 2.0", "", MADE,
             "In the form of appendix A of PLCopen's *Function blocks for motion control*: the data types, the blocks, and for",
             "each block its pins. B is basic, E extended, V the supplier's own. A pin is supported when a block of the library",
             "SM3_Basic declares it under the specified name, as the same kind of pin; the blocks follow the TM/TP manual, chapter",
             "7, whose pins have other names in places. A comment names the type where it is not the specified one. No statement has",
             "been submitted to PLCopen.", "",
             f"{len(here)} of {len(specified)} blocks are supported; of their pins {levels['B'][0]} of {levels['B'][1]} basic and "
             f"{levels['E'][0]} of {levels['E'][1]} extended ones"
             + (f", {levels['V'][0]} of {levels['V'][1]} of suppliers." if levels["V"][1] else "."), "",
             "## Supported data types", "", "| data type of the specification | supported | type here |", "|---|---|---|"]
    for type_name in BASIC:
        lines.append(f"| {type_name} | {'Yes' if type_name in mine else 'No'} | {types(mine, type_name)} |")
    lines += ["", "## Supported derived data types", "", "| derived data type | where used | supported | type here |",
              "|---|---|---|---|"]
    for type_name in sorted(set(used) - set(BASIC)):
        places = sorted(set(used[type_name]), key=list(specified).index)
        where = ", ".join(places[:4]) + (f" and {len(places) - 4} more" if len(places) > 4 else "")
        lines.append(f"| {type_name} | {where} | {'Yes' if type_name in mine else 'No'} | {types(mine, type_name)} |")
    lines += ["", "## Overview of the function blocks", "", "| function block | supported | tests or comments |", "|---|---|---|"]
    for block in specified:
        words = by_name.get(block.upper(), [])
        comment = tests.links(words) if block in here else escaped(comments.get((block, ""), ""))
        lines.append(f"| {block} | {'Yes' if block in here else 'No'} | {comment} |")
    lines += ["", "## The function blocks and their pins", "", *details]
    return "\n".join(lines).rstrip("\n") + "\n", len(here), len(specified)


def types(mine, type_name):
    return escaped(", ".join(sorted(mine.get(type_name, ()))))


# ---- the manuals

def manuals(tests):
    chapters = dict(table("chapters.tsv"))
    sections = {catalogue: Section(title) for catalogue, title in CATALOGUES.items()}

    def order(word):
        numbers = [int(number) for number in re.findall(r"\d+", chapters.get(word, "").split(",")[0])]
        return (numbers or [999], word.encode())

    for word in sorted(tests.names, key=order):
        catalogue, _, name = word.rpartition(":") if word.partition(":")[0] in CATALOGUES else ("motion", "", word)
        if catalogue not in CATALOGUES:
            catalogue, _, name = word.partition(":")
        sections[catalogue].add(chapters.get(word, ""), name, tests.status([word]), tests.links([word]))
    return [section for section in sections.values() if section.rows]


def rules(tests):
    sections = {manual: Section(title) for manual, title in MANUALS.items()}
    for rule, chapter, _, text in table("rules.tsv"):
        sections[rule.partition(":")[0]].add(chapter, text, tests.status(["rule:" + rule]), tests.links(["rule:" + rule]))
    return list(sections.values())


# ---- the pages

def pages(tests):
    made = {}
    third = standard(tests, lambda editions: "3" in editions)
    second = edition2(tests)
    fourth = standard(tests, lambda editions: editions == "4")
    kept = standard(tests, lambda editions: editions == "3+4")
    named, ruled = manuals(tests), rules(tests)
    made["compliance-motion.md"], blocks, all_blocks = motion(tests)
    withdrawn = [f"| {row.replace('/', ', ', 1)} | {escaped(name)} |" for row, editions, name in table("features.tsv")
                 if editions == "3"]
    made["compliance-edition2.md"] = page(
        "Compliance with IEC 61131-3, edition 2 (2003)",
        ["Tables in the numbers of edition 2. A feature has its number of edition 2 where published lists of suppliers agree on it;",
         "the others have that of the row of edition 3 which continues them. It is supported when the tests of those rows pass, some of",
         "which run in another dialect than `--std=iec2`; [language.md](language.md) says where the dialects differ."], second)
    made["compliance-edition4.md"] = "\n".join([
        page("Compliance with IEC 61131-3, edition 4 (2025)",
             ["First what edition 4 adds, then what it no longer has, which Rung still supports, then the rest, in the numbers of the",
              "tables of edition 3. IEC has removed IL, octal literals and the untyped TRUNC."], fourth + kept)
        .replace(fourth[0].text(), "\n".join(["## No longer in edition 4", "", "| table, feature of edition 3 | what it is |",
                                              "|---|---|", *withdrawn, "", fourth[0].text()]), 1)])
    made["compliance-manuals.md"] = page(
        "The names of the manuals",
        ["What the programs of the manuals use, by catalogue and chapter, as in the `covers:` lines of the tests;",
         "[references.md](references.md#manuals-of-plcs) names the manuals."], named, "chapter", "names")
    made["compliance-rules.md"] = page(
        "The rules of the manuals",
        ["What the manuals say of meaning, order, limits and defaults, in our words: a first catalogue, of the rules that most programs",
         "meet. A rule is supported when tests that cover it pass, and not supported when none does;",
         "[references.md](references.md#manuals-of-plcs) names the manuals."], ruled, "chapter", "rules")
    totals = [("[edition 2](compliance-edition2.md)", *counted(second)), ("edition 3, below", *counted(third)),
              ("[edition 4](compliance-edition4.md)", *counted(fourth + kept)),
              ("[PLCopen motion control, part 1: blocks](compliance-motion.md)", blocks, all_blocks),
              ("[names of the manuals](compliance-manuals.md)", *counted(named)),
              ("[rules of the manuals](compliance-rules.md)", *counted(ruled))]
    introduction = [
        "The tables of edition 3 are below: numbers of edition 3, names in our words; tables 23 to 25 are numbered as they run. A",
        "feature is supported when tests prove it and all of them passed, at every level of optimization. Without such a test it",
        "counts as not supported.", "", "| statement | supported | features |", "|---|---|---|",
        *[f"| {name} | {done} | {of} |" for name, done, of in totals], "",
        "Motion control: the blocks of CNC that the manuals name in error texts only (SMC_NCDecoder, SMC_Interpolator, "
        "SMC_Interpolator2Dir,",
        "SMC_GCodeViewer, SMC_ReadNCFile, SMC_ReadNCQueue, SMC_AxisDiagnosticLog, SMC_WriteDriveParamsToFile, SMC_ResetAxisGroup) "
        "and their types,",
        "but the queue that SMC_CheckVelocities takes, are not built, not even empty: no manual describes them, and a path needs the "
        "language of a", "CNC, which is another product."]
    made["compliance.md"] = page("Compliance with IEC 61131-3", introduction, third)
    return made


def main():
    arguments = sys.argv[1:]
    check = arguments[:1] == ["--check"]
    results = pathlib.Path(arguments[check] if len(arguments) > check else BUILD / "test-results.tsv")
    if not results.exists():
        sys.exit(f"{results} not found; a full run of build/bin/rung_test_runner writes it")
    if not (BUILD / "bin/rung").exists():
        sys.exit(f"{BUILD}/bin/rung not found; build it first")
    stale = 0
    for name, text in pages(Tests(results)).items():
        file = ROOT / "docs" / name
        old = file.read_text() if file.exists() else ""
        if text == old:
            continue
        if not check:
            file.write_text(text)
            continue
        print(f"docs/{name} does not match the last run; tools/compliance/compliance.py updates it:")
        changes = difflib.unified_diff(old.splitlines(), text.splitlines(), lineterm="", n=0)
        print("\n".join(list(changes)[2:22]))
        stale = 1
    return stale


if __name__ == "__main__":
    sys.exit(main())

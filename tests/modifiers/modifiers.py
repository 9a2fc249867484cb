#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the tests notice a missing modifier. For each row of the standard that is named after one (FINAL method, RETAIN
inputs, VAR_EXTERNAL CONSTANT), the programs that claim the row are run with one occurrence of the word left out.
  tests/modifiers/modifiers.py [FILE...]     prints each occurrence that nothing notices; exits 0 when there is none
BUILD names the build folder (build)."""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUNNER = ROOT / os.environ.get("BUILD", "build") / "bin/rung_test_runner"
MODIFIERS = ("ABSTRACT CONSTANT FINAL F_EDGE INTERNAL NON_RETAIN OVERLAP OVERRIDE PERSISTENT PRIVATE PROTECTED PUBLIC "
             "READ_ONLY READ_WRITE RETAIN R_EDGE").split()
COMMENT = re.compile(r"^# [^\n]*|//[^\n]*|\(\*.*?\*\)|'[^'\n]*'", re.S | re.M)


def rows_by_modifier():
    """Row -> the modifiers in its name. A default needs no word, so nothing notices when it is left out."""
    rows = {}
    for line in (ROOT / "tests/conformance/features.tsv").read_text().splitlines()[1:]:
        row, _, name = (line.split("\t") + ["", ""])[:3]
        words = set(re.findall(r"\w+", name)) & set(MODIFIERS)
        if words and "default" not in name:
            rows[row] = words
    return rows


def occurrences(text, words):
    """Where one of the words stands in a program, outside of comments and strings."""
    hidden = COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    return [match for match in re.finditer(r"\b(" + "|".join(sorted(words)) + r")\b ?", hidden)]


def is_noticed(file, text, match):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "tests/runner").mkdir(parents=True)
        (root / "tests/runner/main.cpp").touch()  # by which the runner knows the root of a project
        for entry in ROOT.iterdir():
            if entry.name not in ("tests", "build", ".git"):
                (root / entry.name).symlink_to(entry)
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        for beside in (ROOT / file).parent.iterdir():
            if beside.name != file.name:
                (root / file).with_name(beside.name).symlink_to(beside)
        (root / file).write_text(text[: match.start()] + text[match.end():])
        result = subprocess.run([RUNNER, "--ways=--engine=interp", "-j", "1", str(file)], cwd=root, capture_output=True)
        return result.returncode != 0


def main():
    rows = rows_by_modifier()
    wanted = [pathlib.Path(os.path.relpath(name, ROOT)) for name in sys.argv[1:]]
    tasks, claimed = [], set()
    files = [file for folder in ("conformance", "programs") for file in sorted((ROOT / "tests" / folder).rglob("*.*"))
             if file.suffix in (".st", ".test")]
    for file in files:
        name = file.relative_to(ROOT)
        if wanted and name not in wanted:
            continue
        text = file.read_text(errors="replace")
        features = set(" ".join(re.findall(r"(?://|#) features: (.*)", text)).split()) & set(rows)
        claimed |= features
        words = set().union(*(rows[row] for row in features)) if features else set()
        if words:
            tasks += [(name, text, match) for match in occurrences(text, words)]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for task, noticed in zip(tasks, pool.map(lambda task: is_noticed(*task), tasks)):
            if noticed:
                continue
            name, text, match = task
            print(f"{name}:{text.count(chr(10), 0, match.start()) + 1}: nothing notices when {match[1]} is missing")
            failed += 1
    if not wanted:
        for row in sorted(set(rows) - claimed):
            print(f"row {row}: no program claims it")
    print(f"{len(tasks)} modifiers left out, {failed} of them not noticed")
    return failed != 0


sys.exit(main())

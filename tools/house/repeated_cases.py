#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Finds pairs of switches that repeat a list of more than six kinds.

A list is a row of labels before one statement: `case TypeKind::Int: case TypeKind::DInt: … return …;`. What several
functions say of the same kinds belongs in a column of the table of those kinds (nodes.def, instructions.def, tokens.def,
the categories of TypeKind), or in a function that both ask.
  tools/house/repeated_cases.py             lists the pairs with what they share   [--most N] [FOLDER ...]
  tools/house/repeated_cases.py --check     fails for an enumeration with more pairs than repeated_cases.tsv allows
  tools/house/repeated_cases.py --tighten   lowers the numbers of repeated_cases.tsv to what is left; nothing is added
"""
import argparse
import collections
import itertools
import re
import sys
from pathlib import Path

from sources import HOUSE, code_only, read, tracked

TABLE = Path(HOUSE) / "repeated_cases.tsv"
FOLDERS = ("frontend", "sema", "ir", "codegen", "stdlib", "cam", "tools")
ROW = re.compile(r"(?:\bcase\s+[\w:]+\s*:(?!:)\s*)+")
LABEL = re.compile(r"\bcase\s+((?:\w+::)*)(\w+)::(\w+)\s*:(?!:)")
OF_TREE_AND_IR = ("ExprKind", "StmtKind", "BodyKind")  # two enumerations each


def full_name(path, scope, enumeration):
    """`ir::ExprKind` for an enumeration of the IR whose name the tree has, too."""
    in_ir = path.startswith(("ir/", "codegen/")) and not scope.startswith("rung::")
    return "ir::" + enumeration if enumeration in OF_TREE_AND_IR and (in_ir or scope == "ir::") else enumeration


def lists(path, most):
    """(line, enumeration, kinds) of each list that is long enough."""
    code = code_only(read(path))
    for row in ROW.finditer(code):
        by_type = collections.defaultdict(set)
        for scope, enumeration, kind in LABEL.findall(row.group()):
            by_type[full_name(path, scope, enumeration)].add(kind)
        for enumeration, kinds in by_type.items():
            if len(kinds) > most:
                yield code.count("\n", 0, row.start()) + 1, enumeration, frozenset(kinds)


def repeated(folders, most):
    """By enumeration: a line for each pair."""
    by_type = collections.defaultdict(list)
    for path in tracked(".cpp", ".h"):
        if path.startswith(tuple(folder.rstrip("/") + "/" for folder in folders)):
            for line, enumeration, kinds in lists(path, most):
                by_type[enumeration].append((f"{path}:{line}", kinds))
    pairs = collections.defaultdict(list)
    for enumeration, places in sorted(by_type.items()):
        for (first, some), (second, others) in itertools.combinations(places, 2):
            shared = some & others
            if len(shared) > most:
                pairs[enumeration].append(f"{first} and {second}: {len(shared)} kinds of {enumeration}: "
                                          + " ".join(sorted(shared)))
    return pairs


def read_limits():
    rows = [line.split("\t") for line in TABLE.read_text().splitlines() if not line.startswith("#")]
    return {enumeration: int(pairs) for enumeration, pairs in rows}


def check(pairs):
    known, bad = read_limits(), 0
    for enumeration, found in pairs.items():
        if len(found) > known.get(enumeration, 0):
            print("\n".join(found))
            print(f"{enumeration}: {len(found)} pairs of switches repeat a list, at most {known.get(enumeration, 0)}")
            bad = 1
    return bad


def tighten(pairs):
    lines = [line for line in TABLE.read_text().splitlines() if line.startswith("#")]
    for enumeration, limit in sorted(read_limits().items()):
        left = min(limit, len(pairs[enumeration]))
        if left > 0:
            lines.append(f"{enumeration}\t{left}")
    TABLE.write_text("\n".join(lines) + "\n")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--most", type=int, default=6, help="kinds that two lists may share (default: 6)")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--tighten", action="store_true")
    parser.add_argument("folders", nargs="*", default=FOLDERS)
    options = parser.parse_args()
    pairs = repeated(options.folders, options.most)
    if options.check:
        return check(pairs)
    if options.tighten:
        return tighten(pairs)
    for found in pairs.values():
        print("\n".join(found))
    return 1 if pairs else 0


if __name__ == "__main__":
    sys.exit(main())

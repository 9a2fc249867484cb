#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lists pairs of switches that repeat a list of more than six kinds.  repeated_cases.py [--most N] [FOLDER ...]

A list is a row of labels before one statement: `case TypeKind::Int: case TypeKind::DInt: … return …;`. What several
functions say of the same kinds belongs in a column of the table of those kinds (nodes.def, instructions.def, tokens.def,
the categories of TypeKind). Prints each pair with what they share; exit code 1 if there are any. Called by hand.
"""
import argparse
import collections
import itertools
import re
import sys

from sources import code_only, read, tracked

FOLDERS = ("frontend", "sema", "ir", "codegen", "stdlib", "cam", "tools")
ROW = re.compile(r"(?:\bcase\s+[\w:]+\s*:(?!:)\s*)+")
LABEL = re.compile(r"\bcase\s+(?:\w+::)*(\w+)::(\w+)\s*:(?!:)")


def lists(path, most):
    """(line, enumeration, kinds) of each list that is long enough."""
    code = code_only(read(path))
    for row in ROW.finditer(code):
        by_type = collections.defaultdict(set)
        for enumeration, kind in LABEL.findall(row.group()):
            by_type[enumeration].add(kind)
        for enumeration, kinds in by_type.items():
            if len(kinds) > most:
                yield code.count("\n", 0, row.start()) + 1, enumeration, frozenset(kinds)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--most", type=int, default=6, help="kinds that two lists may share (default: 6)")
    parser.add_argument("folders", nargs="*", default=FOLDERS)
    options = parser.parse_args()
    by_type = collections.defaultdict(list)
    for path in tracked(".cpp", ".h"):
        if not path.startswith(tuple(folder.rstrip("/") + "/" for folder in options.folders)):
            continue
        for line, enumeration, kinds in lists(path, options.most):
            by_type[enumeration].append(("%s:%d" % (path, line), kinds))
    found = 0
    for enumeration, places in sorted(by_type.items()):
        for (first, some), (second, others) in itertools.combinations(places, 2):
            shared = some & others
            if len(shared) <= options.most:
                continue
            found += 1
            print("%s and %s: %d kinds of %s: %s" % (first, second, len(shared), enumeration, " ".join(sorted(shared))))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Long functions and wide classes. A table counts for nothing: a function whose lines are mostly rows `{…},` or
# `case …:` of one line each.
#   tools/house/sizes.py                lists functions of more than 60 lines, and classes with more than 60 member
#                                       functions or 30 data members   [--lines N] [--members N] [--fields N]
#   tools/house/sizes.py --check        prints what exceeds these limits, outside of tests, and what size_limits.tsv
#                                       allows beyond them; exit code 1 when there is any
#   tools/house/sizes.py --tighten      takes from size_limits.tsv what is shorter now; nothing is ever added
import argparse
import re
import sys
from pathlib import Path

from sources import HOUSE, code_only, read, tracked

TABLE = Path(HOUSE) / "size_limits.tsv"
LIMITS = {"lines": 60, "members": 80, "fields": 30}
TEST_LIMITS = {"lines": 120, "members": 80, "fields": 30}
WORDS = {"lines": "lines", "members": "member functions", "fields": "data members"}

FUNCTION = re.compile(r"([\w:~<>]+|operator\S+)\s*\([^;{}]*\)\s*(?:const|noexcept|override|-> [\w:<>]+|\s)*(?::\s*[^;{}]*(?:\{[^{}]*\}[^;{}]*)*)?$",
                      re.S)
CLASS = re.compile(r"\b(?:class|struct)\s+([\w:]+)(?:\s+final)?\s*(?::[^;{}()]*)?$")
ROW = re.compile(r"^\s*(\{.*\},?|case [\w:]+:.*;|RUNG_\w+\(.*\);?)\s*$")
NOT_FUNCTIONS = {"if", "for", "while", "switch", "catch", "return", "sizeof", "requires"}


def blocks(source):
    """(head, first line, last line, text, depth of classes around it) of each brace block outside of functions."""
    source = code_only(source)
    stack, begin = [], 0
    for at, c in enumerate(source):
        if c == "{":
            stack.append((source[begin:at], at))
            begin = at + 1
        elif c == "}" and stack:
            head, opened = stack.pop()
            yield head.strip(), opened, at, source, [h for h, _ in stack]
            begin = at + 1
        elif c == ";":
            begin = at + 1


def name_of_function(head):
    match = FUNCTION.search(head)
    if not match or match.group(1).split("<")[0] in NOT_FUNCTIONS or head.endswith("="):
        return None
    return match.group(1)


NO_FIELD = re.compile(r"(?:using|typedef|friend|static|enum|struct|class|union|template|explicit|return)\b")
FIELD = re.compile(r"[A-Za-z_][\w:]*[\w:&*\s]*[\s&*]\w+(?:\s*,\s*[&*]?\w+)*$")


def fields_of(inside):
    """The number of data members in the text between the braces of a class, whose inner braces are gone."""
    count = 0
    for member in re.sub(r"\b(?:public|private|protected)\s*:(?!:)", ";", inside).split(";"):
        member = re.sub(r"\[[^\]]*\]", "", re.sub(r"=\s*[^,(]*(?:\([^()]*\))?", "", member))
        while "<" in member and (again := re.sub(r"<[^<>]*>", "", member)) != member:
            member = again
        member = member.strip()
        if FIELD.match(member) and not NO_FIELD.match(member):
            count += member.count(",") + 1
    return count


def measured():
    """(kind, path, line, name, size) of each function and class: "lines", "members" and "fields"."""
    for path in tracked(".cpp", ".h"):
        original = read(path)
        lines = original.split("\n")
        for head, opened, closed, source, around in blocks(original):
            first, last = source.count("\n", 0, opened) + 1, source.count("\n", 0, closed) + 1
            if any(name_of_function(outer) for outer in around):
                continue
            name = name_of_function(head)
            if name:
                rows = [line for line in lines[first:last - 1] if line.strip()]
                if sum(bool(ROW.match(line)) for line in rows) * 2 < len(rows):
                    yield "lines", path, first, name, last - first + 1
            match = CLASS.search(head)
            if match:
                inside = re.sub(r"\{[^{}]*\}", ";", source[opened + 1:closed])
                while (again := re.sub(r"\{[^{}]*\}", ";", inside)) != inside:
                    inside = again
                members = len(re.findall(r"(?:^|[\s*&])~?(\w+|operator[^\s(]+)\s*\([^;]*?\)[^;(]*;", inside))
                yield "members", path, first, match.group(1), members
                yield "fields", path, first, match.group(1), fields_of(inside)


def is_test(path):
    return path.startswith("tests/")


def read_limits():
    """(kind, path, name) -> size, from size_limits.tsv."""
    rows = [line.split("\t") for line in TABLE.read_text().splitlines() if not line.startswith("#")]
    return {tuple(row[:3]): int(row[3]) for row in rows}


def check():
    known, bad = read_limits(), 0
    for kind, path, line, name, size in measured():
        general = (TEST_LIMITS if is_test(path) else LIMITS)[kind]
        limit = max(general, known.get((kind, path, name), 0))
        if size > limit:
            print(f"{path}:{line}: {name} has {size} {WORDS[kind]}, at most {limit}")
            bad += 1
    return 1 if bad else 0


def tighten():
    found = {}
    for kind, path, _, name, size in measured():
        found[kind, path, name] = max(size, found.get((kind, path, name), 0))
    lines = [line for line in TABLE.read_text().splitlines() if line.startswith("#")]
    for key, limit in sorted(read_limits().items()):
        size = min(limit, found.get(key, 0))
        if size > LIMITS[key[0]]:
            lines.append("\t".join([*key, str(size)]))
    TABLE.write_text("\n".join(lines) + "\n")
    return 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--lines", type=int, default=60)
    parser.add_argument("--members", type=int, default=60)
    parser.add_argument("--fields", type=int, default=30)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--tighten", action="store_true")
    options = parser.parse_args()
    if options.check:
        return check()
    if options.tighten:
        return tighten()
    found = list(measured())
    for kind, limit in (("lines", options.lines), ("members", options.members), ("fields", options.fields)):
        large = sorted(((size, f"{path}:{line}", name) for of, path, line, name, size in found
                        if of == kind and size > limit), reverse=True)
        print(f"{len(large)} with over {limit} {WORDS[kind]}")
        for size, place, name in large:
            print(f"  {size:5}  {place}  {name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

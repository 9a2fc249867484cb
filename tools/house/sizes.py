#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Functions of more than 100 lines and classes with more than 60 member functions, tables left out: a function whose
# lines are mostly rows `{…},` or `case …:` of one line each is a table.
#   tools/house/sizes.py [--lines N] [--members N]      exit code 1 when there are any
import argparse
import re
import sys

from sources import code_only, read, tracked

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


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--lines", type=int, default=100)
    parser.add_argument("--members", type=int, default=60)
    options = parser.parse_args()
    functions, classes = [], []
    for path in tracked(".cpp", ".h"):
        original = read(path)
        lines = original.split("\n")
        for head, opened, closed, source, around in blocks(original):
            first, last = source.count("\n", 0, opened) + 1, source.count("\n", 0, closed) + 1
            if any(name_of_function(outer) for outer in around):
                continue
            name = name_of_function(head)
            if name and last - first + 1 > options.lines:
                body = [line for line in lines[first:last - 1] if line.strip()]
                if sum(bool(ROW.match(line)) for line in body) * 2 < len(body):
                    functions.append((last - first + 1, f"{path}:{first}", name))
            match = CLASS.search(head)
            if match:
                inside = re.sub(r"\{[^{}]*\}", ";", source[opened + 1:closed])
                while "{" in inside and "}" in inside and (again := re.sub(r"\{[^{}]*\}", ";", inside)) != inside:
                    inside = again
                members = len(re.findall(r"(?:^|[\s*&])~?(\w+|operator[^\s(]+)\s*\([^;]*?\)[^;(]*;", inside))
                if members > options.members:
                    classes.append((members, f"{path}:{first}", match.group(1)))
    print(f"{len(functions)} functions over {options.lines} lines")
    for count, place, name in sorted(functions, reverse=True):
        print(f"  {count:5}  {place}  {name}")
    print(f"{len(classes)} classes with over {options.members} member functions")
    for count, place, name in sorted(classes, reverse=True):
        print(f"  {count:5}  {place}  {name}")
    return 1 if functions or classes else 0


if __name__ == "__main__":
    sys.exit(main())

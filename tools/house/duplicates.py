#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lists pairs of places that share six or more consecutive lines of code, equal or of the same shape.
    tools/house/duplicates.py [--lines N] [FOLDER ...]
Lines have the same shape when they differ only in names, numbers and strings. Four of the lines must have names, the
others may be closing braces. Comments, labels, declarations without a value or with a plain one, the first and last
lines of types, rows of tables and prototypes do not count as lines. A pair that overlaps another one at both ends is
not listed."""
import argparse
import collections
import re

from sources import read, tracked

FOLDERS = ("frontend", "sema", "ir", "codegen", "stdlib", "cam", "tools")
COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*', re.S | re.M)
TOKEN = re.compile(r'[A-Za-z_]\w*|\d[\w.\']*|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)+\'|[^\s\w]')
NAME = re.compile(r"[A-Za-z_]")
KEYWORDS = frozenset(
    "if else for while do switch case default return break continue const constexpr auto void bool int char struct "
    "class enum using namespace template typename static inline public private true false nullptr this sizeof "
    "static_cast reinterpret_cast const_cast new delete".split())
ROW = re.compile(r"^(?:n|0|\{|\}|,|:|=|-|<|>|\.|&|\|)*,?$")  # of a table or an enumeration
VALUE = r"(?:n|n::n|0|-0|true|false|nullptr|\{\})"  # of a member, where none other is given
DECLARATION = re.compile(rf"^(?:const )?(?:[n:<>&*, ]|bool|int|char)+(?: ?= ?{VALUE}(?:,n ?= ?{VALUE})*)?;$")
TYPE = r"(?:const )?(?:n(?:::n)*|bool|int|char|void|auto)(?:<[^()]*>)?(?:[&*]| const)*"
PARAMETER = rf"{TYPE}(?: ?n)?(?: ?= ?[^,()]*)?"
PROTOTYPE = re.compile(rf"^(?:static |virtual |explicit |friend )*{TYPE} ?~?n\((?:{PARAMETER}(?:, ?{PARAMETER})*)?\)"
                       rf"(?: const)?(?: n)?(?: ?= ?(?:0|delete|default))?;$")
ONE_NAME = re.compile(r"^n n\(n(?:, ?n)*\);$")  # a variable and the arguments of its constructor
OPENING = re.compile(r"^(?:typedef )?(?:struct|class|enum class|enum) n|^\} ?n;$|^(?:public|private|n):$")
TABLE_ROW = re.compile(r"^\{[^;]*\},?$")


def code_lines(path):
    """(line number, whether it has names, shape) of the lines that count."""
    source = COMMENT.sub(lambda t: t.group() if t.group()[0] == '"' else re.sub(r"[^\n]", " ", t.group()), read(path))
    for number, line in enumerate(source.split("\n"), 1):
        tokens = TOKEN.findall(line)
        if tokens and all(token in "{}();," for token in tokens):
            yield number, False, " ".join(tokens)
            continue
        if not any(NAME.match(token) for token in tokens) or tokens[0] in ("case", "default", "using", "namespace"):
            continue
        words = ["n" if NAME.match(t) and t not in KEYWORDS else "0" if t[0].isdigit() or t[0] in "\"'" else t
                 for t in tokens]
        shape = " ".join(words)
        compact = re.sub(r" ?([^\w ]) ?", r"\1", shape)
        if ROW.match(compact) or DECLARATION.match(compact) or OPENING.match(compact) or TABLE_ROW.match(compact):
            continue
        if PROTOTYPE.match(compact) and not ONE_NAME.match(compact):
            continue
        if path.endswith(".h") and compact.endswith(";") and "=" not in compact and not compact.startswith("return"):
            continue
        yield number, True, shape


def alike(left, right):
    """How many lines from the start have the same shape."""
    count = 0
    for a, b in zip(left, right):
        if a[2] != b[2]:
            break
        count += 1
    return count


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--lines", type=int, default=6)
    arguments.add_argument("folders", nargs="*", default=FOLDERS)
    options = arguments.parse_args()
    n = options.lines

    files = [p for p in tracked(".cpp", ".h") if p.startswith(tuple(f.rstrip("/") + "/" for f in options.folders))]
    lines = {path: list(code_lines(path)) for path in files}
    windows = collections.defaultdict(list)
    for path in files:
        for at in range(len(lines[path]) - n + 1):
            windows[tuple(shape for _, _, shape in lines[path][at:at + n])].append((path, at))

    candidates = []
    for places in windows.values():
        for i, (p, a) in enumerate(places):
            for q, b in places[i + 1:]:
                limit = b - a if p == q else len(lines[q])
                length = alike(lines[p][a:a + min(limit, 400)], lines[q][b:b + 400])
                if length >= n and sum(named for _, named, _ in lines[p][a:a + length]) >= 4:
                    candidates.append((length, p, a, q, b))
    candidates.sort(key=lambda c: (-c[0], c[1:]))

    found, taken = [], collections.defaultdict(list)
    for length, p, a, q, b in candidates:
        if any(a < x + m and x < a + length and b < y + m and y < b + length for x, y, m in taken[p, q]):
            continue
        taken[p, q].append((a, b, length))
        found.append((length, f"{p}:{lines[p][a][0]}", f"{q}:{lines[q][b][0]}"))
    for length, left, right in found:
        print(f"{length:4}  {left}  {right}")
    print(f"{len(found)} pairs of places share {n} or more lines")


try:
    main()
except BrokenPipeError:
    pass

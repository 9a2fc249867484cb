#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# The timing diagrams that editors show for blocks of the standard library, in characters. In: the programs in
# samples/library/standard that `rung run` draws for the library pages, of which the traces are taken. Out: the table
# tools/ide/timing_drawings.def. With --check nothing is written, and a difference ends with exit code 1.
#
#   timing_drawings.py [--check]       `rung` from PATH
import csv
import io
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "tools/ide/timing_drawings.def"
WIDTH = 48
UNITS = {"d": 86400e3, "h": 3600e3, "m": 60e3, "s": 1e3, "ms": 1.0, "us": 1e-3, "ns": 1e-6}
LOW, HIGH, BOTH = "▁", "▔", "|"


def number(text):
    if "#" not in text:
        return float(text)
    parts = re.findall(r"([\d.]+)(ms|us|ns|[dhms])", text.split("#")[1])
    return sum(float(value) * UNITS[unit] for value, unit in parts)


# The values of each column of the drawing, at most WIDTH of them.
def columns(values):
    step = -(-len(values) // WIDTH)
    return [values[at:at + step] for at in range(0, len(values), step)]


def levels(values):
    return "".join(HIGH if set(part) == {"TRUE"} else LOW if set(part) == {"FALSE"} else BOTH for part in columns(values))


# A ramp for a time, else each new value where it begins.
def curve(values):
    out, before, shown = "", None, None
    most = max(number(value) for value in values)
    for at, part in enumerate(columns(values)):
        value = number(part[-1])
        if "#" in part[-1]:
            rises = before is not None and value > before
            out += "/" if rises else HIGH if value == most and value > 0 else LOW if value == 0 else "-"
        elif len(out) <= at:  # a longer number takes the columns of the next ones
            out += part[-1] if part[-1] != shown else " "
            shown = part[-1]
        before = value
    return out


def drawing(path):
    lines = path.read_text(encoding="utf-8").split("\n")
    blocks = [line[len("// shows: "):] for line in lines if line.startswith("// shows: ")]
    options = [line[len("// run: "):] for line in lines if line.startswith("// run: ")]
    if not blocks or not options or "--watch" not in options[0]:
        return None
    run = subprocess.run(["rung", "run", str(path), *options[0].split(), "--engine=interp", "--trace", "-"],
                         capture_output=True, text=True, check=True)
    rows = list(csv.reader(io.StringIO(run.stdout)))
    if any("'" in value or "-" in value for value in rows[1]):  # a string, a date
        return None
    names = [name.split(".")[1:] or [name] for name in rows[0][2:]]
    last = [name[-1] for name in names]
    shown = [name[-1] if last.count(name[-1]) == 1 else ".".join(name) for name in names]
    left = max(len(name) for name in shown) + 1
    out = []
    for at, name in enumerate(shown):
        values = [row[at + 2] for row in rows[1:]]
        if values[0] not in ("TRUE", "FALSE") and any(value.isdigit() and len(value) > 1 for value in values):
            continue  # there is no room for longer numbers
        out.append(name.ljust(left) + (levels(values) if values[0] in ("TRUE", "FALSE") else curve(values)).rstrip())
    if len(out) < 2:
        return None
    width = len(columns(rows[1:]))
    end = rows[-1][1] + " ms"
    out.append(" " * left + "0" + end.rjust(width - 1))
    return blocks[0], "\n".join(out)


def main():
    text = ("// SPDX-License-Identifier: Apache-2.0\n"
            "// The timing diagrams of blocks, made by tools/house/timing_drawings.py.\n")
    for path in sorted((ROOT / "samples/library/standard").glob("*.st")):
        found = drawing(path)
        if found:
            text += 'RUNG_DRAWING(" %s ", R"(%s)")\n' % found
    if "--check" not in sys.argv:
        TABLE.write_text(text, encoding="utf-8")
    elif TABLE.read_text(encoding="utf-8") != text:
        sys.exit("%s differs: run tools/house/timing_drawings.py" % TABLE.relative_to(ROOT))


if __name__ == "__main__":
    main()

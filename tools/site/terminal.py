#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what a command prints on a terminal with colors as an SVG for light and dark pages.
    COMMAND --color=always 2>&1 | tools/site/terminal.py '$ COMMAND' > picture.svg
Each argument is a line above the output. Called for the pictures of README.md and docs/."""
import html
import re
import sys

STYLE = """text{font:13px 'DejaVu Sans Mono',Consolas,Menlo,monospace;white-space:pre;fill:#1f2328}
.page{fill:#f6f8fa;stroke:#d0d7de}.b{font-weight:bold}.c31{fill:#cf222e}.c32{fill:#116329}.c33{fill:#9a6700}.c34{fill:#0550ae}
.c35{fill:#8250df}.c36{fill:#1b7c83}.c90{fill:#6e7781}
@media(prefers-color-scheme:dark){text{fill:#e6edf3}.page{fill:#161b22;stroke:#30363d}.c31{fill:#ff7b72}.c32{fill:#7ee787}
.c33{fill:#e3b341}.c34{fill:#79c0ff}.c35{fill:#d2a8ff}.c36{fill:#76e3ea}.c90{fill:#9198a1}}"""
ADVANCE, LINE = 7.83, 19


def spans(line):
    """The parts of a line with one look each, as (classes, text)."""
    classes, parts = [], []
    for piece in re.split(r'(\x1b\[[0-9;]*[mK])', line):
        code = re.fullmatch(r'\x1b\[([0-9;]*)m', piece)
        if code:
            for number in code.group(1).split(';'):
                if number in ('', '0'):
                    classes = []
                elif number == '1':
                    classes = classes + ['b']
                else:
                    classes = [c for c in classes if c == 'b'] + ['c' + number]
        elif piece and not piece.startswith('\x1b'):
            parts.append((' '.join(classes), piece))
    return parts


def main():
    lines = [[('c90', line)] for line in sys.argv[1:]]
    lines += [spans(line) for line in sys.stdin.read().splitlines()]
    columns = max(sum(len(text) for _, text in line) for line in lines)
    width, height = round(columns * ADVANCE) + 32, len(lines) * LINE + 26
    print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">')
    print(f'<style>{STYLE}</style>\n<rect class="page" x=".5" y=".5" width="{width - 1}" height="{height - 1}" rx="6"/>')
    for row, line in enumerate(lines):
        parts = ''.join(f'<tspan class="{look}">{html.escape(text, False)}</tspan>' if look else html.escape(text, False)
                        for look, text in line)
        print(f'<text x="16" y="{row * LINE + 26}">{parts}</text>')
    print('</svg>')


main()

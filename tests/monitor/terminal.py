#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# `rung monitor URL watch` on a terminal: runs it on a pseudo-terminal of some size, keeps what the terminal would show,
# and ends it with Ctrl-C.
#   terminal.py ROWS COLUMNS SECONDS ARGUMENTS ...     `rung monitor $URL ARGUMENTS`
# Out: the screen at the end, the exit code, and whether the cursor is visible again.
import fcntl
import os
import pty
import re
import select
import struct
import sys
import termios
import time

SEQUENCE = re.compile(r"\x1b\[(\??)(\d*)([A-Za-z])|\r|\n|[^\x1b\r\n]+")


class Screen:
    """A terminal of some rows that understands what the table sends."""

    def __init__(self, rows, columns):
        self.lines, self.row, self.column, self.columns = [""] * rows, 0, 0, columns
        self.is_cursor_visible = True

    def feed(self, text):
        for part in SEQUENCE.finditer(text):
            private, number, letter = part.groups()
            if letter is None:
                self.write(part[0])
            elif private:
                self.is_cursor_visible = letter == "h"
            elif letter == "A":
                self.row = max(self.row - int(number), 0)
            elif letter == "K":
                self.lines[self.row] = self.lines[self.row][: self.column]
            elif letter == "J":
                self.lines[self.row] = self.lines[self.row][: self.column]
                self.lines[self.row + 1 :] = [""] * (len(self.lines) - self.row - 1)
            else:
                sys.exit("unknown sequence " + repr(part[0]))

    def write(self, text):
        if text == "\r":
            self.column = 0
        elif text == "\n":
            self.row += 1
            if self.row == len(self.lines):
                self.lines = self.lines[1:] + [""]
                self.row -= 1
        else:
            line = self.lines[self.row].ljust(self.column)
            self.lines[self.row] = line[: self.column] + text + line[self.column + len(text) :]
            self.column += len(text)
            if self.column > self.columns:
                sys.exit("a line is longer than the terminal: " + repr(self.lines[self.row]))


def main():
    rows, columns, seconds = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
    child, terminal = pty.fork()
    if child == 0:
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        os.execvp("rung", ["rung", "monitor", os.environ["URL"], *sys.argv[4:]])
    screen, received = Screen(rows, columns), b""
    end, interrupt = time.monotonic() + 60, None
    while time.monotonic() < end:
        if interrupt is None and received:
            interrupt = time.monotonic() + seconds
        if interrupt is not None and time.monotonic() > interrupt:
            os.write(terminal, b"\x03")
            interrupt = end
        if not select.select([terminal], [], [], 0.02)[0]:
            continue
        try:
            data = os.read(terminal, 65536)
        except OSError:
            break
        if not data:
            break
        received += data
    screen.feed(received.decode().replace("^C", ""))
    status = os.waitpid(child, 0)[1]
    print("\n".join(re.sub(r"^cycle \d+, \d+( m?s?)?", "cycle N, T", line.rstrip()) for line in screen.lines if line))
    print("exit", os.waitstatus_to_exitcode(status), "cursor", "visible" if screen.is_cursor_visible else "hidden")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Types keys into a command on a pseudo-terminal, each after the prompt has come, and prints what is on the screen.
#   keys.py COMMAND ... < KEYS      a line each, as a string of Python without quotes: `brea\t`, `\x1b[A`
import os
import pty
import re
import select
import sys
import time

SECONDS = 60


def read(fd, until, seconds=SECONDS):
    text = b""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if not select.select([fd], [], [], 0.1)[0]:
            if until is None or re.search(until, text):
                return text
            continue
        try:
            data = os.read(fd, 4096)
        except OSError:
            return text
        if not data:
            return text
        text += data
    return text


def main():
    pid, fd = pty.fork()
    if pid == 0:
        os.execvp(sys.argv[1], sys.argv[1:])
    screen = read(fd, rb"\(rung\) ")
    for line in sys.stdin:
        keys = line.rstrip("\n").encode().decode("unicode_escape").encode("latin-1")
        os.write(fd, keys)
        screen += read(fd, rb"\(rung\) [^\n]*$" if keys != b"run\r" else None, SECONDS if keys != b"run\r" else 1)
    os.close(fd)
    os.waitpid(pid, 0)
    text = re.sub(rb"\x1b\[[0-9]*[A-Z]", b"", screen).decode()
    for part in text.split("\n"):
        print(part.rstrip("\r").split("\r")[-1].rstrip())


if __name__ == "__main__":
    main()

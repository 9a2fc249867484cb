#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# The client of tests/bench/monitor_load.sh.
#   load.py COMMAND ...             takes the 1000 values of Main.a at the full rate, and asks for symbols, tasks and values
#                                   as fast as it gets answers, until the program ends; then its output, and a line of
#                                   what the client got
#   load.py --symbols COMMAND ...   the median of eleven lists of all symbols; exit code 1 when it takes more than 50 ms
import http.client
import statistics
import sys
import threading
import time

from client import Program

MOST_MS = 50


def follow(program, counts):
    for _ in program.events("/api/stream?paths=Main.a&rate=1000"):
        counts["events"] += 1


def ask(program, counts):
    connection = http.client.HTTPConnection(program.host, program.port, timeout=10)
    try:
        while True:
            for path in ("/api/values?paths=Main.a", "/api/symbols?count=100", "/api/tasks"):
                connection.request("GET", path, headers={"Authorization": "Bearer " + program.token})
                connection.getresponse().read()
                counts["answers"] += 1
    except (OSError, http.client.HTTPException):
        pass  # the program has ended


def load(program):
    counts = {"events": 0, "answers": 0}
    for work in (follow, ask):
        threading.Thread(target=work, args=(program, counts), daemon=True).start()
    code, output, _ = program.process.wait(), program.process.stdout.read(), program.process.stderr.read()
    print(output, end="")
    print(f"the client got {counts['events']} events and {counts['answers']} answers")
    return code


def list_symbols(program):
    times = []
    for _ in range(11):
        connection = http.client.HTTPConnection(program.host, program.port, timeout=10)
        begin = time.perf_counter()
        connection.request("GET", "/api/symbols?count=100000", headers={"Authorization": "Bearer " + program.token})
        size = len(connection.getresponse().read())
        times.append((time.perf_counter() - begin) * 1000)
        connection.close()
    program.end()
    median = statistics.median(times)
    print(f"symbols: 100000 in {median:.1f} ms, {size / 1e6:.1f} MB (at most {MOST_MS} ms)")
    return 0 if median <= MOST_MS else 1


def main():
    if sys.argv[1] == "--symbols":
        return list_symbols(Program(sys.argv[2:]))
    return load(Program(sys.argv[1:]))


if __name__ == "__main__":
    sys.exit(main())

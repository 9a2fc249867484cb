#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Random requests to the monitor of a program: right ones, ones with wrong paths, values and JSON, and damaged ones, sent
# in parts, in rows and cut short. Each whole request gets one answer of a status that there is, and the monitor goes on
# as before. In: the seed, how many, and the command that starts the program of fuzzed.st. Out: a line of figures; exit
# code 1 with the bytes of a request that was answered in another way.
#   fuzz.py FIRST COUNT COMMAND ...
import json
import random
import socket
import sys
import urllib.parse

from client import Program

STATUSES = {200, 400, 401, 403, 404, 405, 409, 413}
PATHS = ["Main.n", "main.MODE", "Main.points[1,2].name", "Main.points", "Main.counters[3].count", "Main.wide", "Main.span"]
PATHS += ["Main.day", "Main.word_", "Main.word_.3", "Main.target^", "Main.target", "Main.lamp", "%IX0.2", "%QB0", "Main"]
PATHS += ["Main.most", "Main.points[9,9].x", "Main.points[0,", "Main.none", "", ".", "Main..n", "Main.n^", "%MD99999999", "^" * 9]
VALUES = ["0", "1", "-7", "TRUE", "16#FF", "1.5", "1e999", "'text'", "'$'", '"wide"', "T#1s", "D#2026-11-28", "Fast", "Mode#Slow"]
VALUES += ["", "x" * 300, "'" + "y" * 100 + "'", "99999999999999999999", "\u00e4", "\0"]
COMMANDS = ["stop", "start", "cycle", "reset warm", "reset cold", "status", "event bell", "get Main.n", "set Main.n=3"]
COMMANDS += ["force Main.lamp=TRUE", "unforce *", "forces", "reset", "fly", "", "get", "set Main.n", "# no"]
URLS = ["/", "/api/info", "/api/symbols", "/api/values", "/api/watch", "/api/stream", "/api/write", "/api/force", "/api/unforce"]
URLS += ["/api/forces", "/api/tasks", "/api/faults", "/api/messages", "/api/command", "/api/pous", "/api/diagram", "/api", "/../x", "//"]


class Requests:
    def __init__(self, program, seed):
        self.program, self.random = program, random.Random(seed)

    def one_of(self, items):
        return self.random.choice(items)

    def some(self, items):
        return [self.one_of(items) for _ in range(self.random.randrange(6))]

    def body(self):
        value = self.one_of([
            lambda: {"paths": self.some(PATHS)},
            lambda: {"values": {path: self.one_of(VALUES) for path in self.some(PATHS)}},
            lambda: {"values": {path: self.one_of([1, None, True, 2.5, [], {}]) for path in self.some(PATHS)}},
            lambda: {"command": self.one_of(COMMANDS)},
            lambda: {"all": self.one_of([True, False, 1])},
            lambda: self.one_of([None, [], "text", 12, {"paths": 3}, {"values": []}, {"command": {}}]),
        ])()
        return json.dumps(value).encode()

    def url(self):
        query = {}
        for name, values in (("paths", [",".join(self.some(PATHS))]), ("prefix", PATHS), ("from", ["0", "5", "-1", "x"]),
                             ("count", ["1", "1000", "999999999", ""]), ("watch", ["1", "7", "a"]), ("rate", ["1", "1000", "0"]), ("pou", PATHS)):
            if self.random.random() < 0.3:
                query[name] = self.one_of(values)
        return self.one_of(URLS) + ("?" + urllib.parse.urlencode(query) if query else "")

    def request(self):
        body = self.body() if self.random.random() < 0.7 else b""
        method = self.one_of(["GET", "POST", "POST", "GET", "PUT", "HEAD"]) if body else "GET"
        token = self.program.token if self.random.random() < 0.9 else "0" * 32
        lines = [f"{method} {self.url()} HTTP/1.1", f"Host: 127.0.0.1:{self.program.port}", f"Authorization: Bearer {token}"]
        if body:
            lines.append(f"Content-Length: {len(body)}")
        return "\r\n".join([*lines, "Connection: close", "", ""]).encode() + body

    def damaged(self):
        data = bytearray(self.request())
        for _ in range(self.random.randrange(1, 4)):
            at = self.random.randrange(len(data))
            kind = self.random.randrange(4)
            if kind == 0:
                data[at] = self.random.randrange(256)
            elif kind == 1:
                del data[at : at + self.random.randrange(1, 20)]
            elif kind == 2:
                data[at:at] = bytes(self.random.randrange(256) for _ in range(self.random.randrange(1, 20)))
            else:
                data[at:at] = data[: self.random.randrange(1, 200)]
            if not data:
                data = bytearray(b" ")
        return bytes(data)


def exchange(program, data, parts):
    """The bytes of the answers; a stream is read once."""
    with socket.create_connection((program.host, program.port), timeout=60) as peer:
        received = b""
        try:
            for at in range(0, len(data), parts):
                peer.sendall(data[at : at + parts])
            peer.shutdown(socket.SHUT_WR)
            while b"text/event-stream" not in received:
                part = peer.recv(65536)
                if not part:
                    break
                received += part
        except ConnectionError:
            pass
        return received


def status_of(received):
    if not received.startswith(b"HTTP/1.1 "):
        return None
    return int(received[9:12])


def main():
    first, count = int(sys.argv[1]), int(sys.argv[2])
    program = Program(sys.argv[3:])
    requests, counts = Requests(program, first), {}
    try:
        for number in range(count):
            is_damaged = requests.random.random() < 0.4
            data = requests.damaged() if is_damaged else requests.request()
            received = exchange(program, data, requests.one_of([1, 7, 1000, 100_000]))
            status = status_of(received)
            if status not in STATUSES and not (is_damaged and status is None):
                print("request", number, data, "was answered by", received[:300])
                sys.exit(1)
            counts[status] = counts.get(status, 0) + 1
            if number % 100 == 0:
                program.post("/api/command", {"command": "start"})
        program.post("/api/unforce", {"all": True})
        program.post("/api/command", {"command": "reset cold"})
        program.post("/api/command", {"command": "start"})
        program.until("/api/values?paths=Main.n", lambda body: 0 < int(body["values"]["Main.n"]) < 10_000_000)
    finally:
        code, _, messages = program.end()
    print(count, "requests:", ", ".join(f"{counts[status]} times {status or 'cut off'}" for status in sorted(counts, key=str)))
    print("exit code", code, [line for line in messages.splitlines() if not line.startswith("note")])


if __name__ == "__main__":
    main()

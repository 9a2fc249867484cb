#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Peers that send garbage, floods or nothing, do not read, or come in thousands: what the monitor of a program does with
# them, while its user still gets answers and the program goes on. In: the command that starts the program, which has
# an array Main.a and a counter Main.n. Out: a line for each peer.
#   hostile.py rung run main.st
import json
import socket
import sys
import threading
import time

from client import Program

SECONDS = 60  # after which an answer counts as none


class Peer:
    def __init__(self, program, small=False):
        self.socket = socket.socket()
        if small:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.settimeout(SECONDS)
        self.socket.connect((program.host, program.port))

    def send(self, data):
        try:
            self.socket.sendall(data)
        except OSError:
            pass  # it has been cut off; what it has been told is read below
        return self

    def read(self):
        """All bytes until the other end closes; None: it does not."""
        received = b""
        try:
            while data := self.socket.recv(65536):
                received += data
        except TimeoutError:
            return None
        except OSError:
            pass
        return received

    def answer(self):
        received = self.read()
        if received is None:
            return "is left alone"
        if not received:
            return "cut off"
        statuses = [part.split(b" ", 1)[0].decode() for part in received.split(b"HTTP/1.1 ")[1:]]
        body = received.rsplit(b"\r\n\r\n", 1)[-1].decode(errors="replace")
        try:
            sentence = json.loads(body)["error"]
        except (ValueError, KeyError):
            sentence = "?"
        return f"{statuses[-1]} {sentence}" + (f", after {len(statuses) - 1} answers" if len(statuses) > 1 else "")


def head(program, line, *headers):
    lines = [line, f"Host: 127.0.0.1:{program.port}", f"Authorization: Bearer {program.token}", *headers, "", ""]
    return "\r\n".join(lines).encode()


def say(what, how):
    print(f"{what}: {how}", flush=True)


def check_answer(program):
    """The user gets an answer, and the program goes on."""
    before = int(program.get("/api/values?paths=Main.n")["values"]["Main.n"])
    program.until("/api/values?paths=Main.n", lambda body: int(body["values"]["Main.n"]) > before)


def broken_requests(program):
    get = "GET /api/info HTTP/1.1"
    post = "POST /api/write HTTP/1.1"
    for what, data in [
        ("noise", bytes(range(256)) * 4),
        ("zeros", bytes(100)),
        ("TLS", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(500)),
        ("text", b"hello, is anybody there?\r\n\r\n"),
        ("HTTP/2", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"),
        ("HTTP/3.0", head(program, "GET /api/info HTTP/3.0")),
        ("no path", head(program, "GET HTTP/1.1")),
        ("another server's URL", head(program, "GET http://evil.example/api/info HTTP/1.1")),
        ("half an escape", head(program, "GET /api/info%4 HTTP/1.1")),
        ("line feeds alone", head(program, get).replace(b"\r\n", b"\n") + b"\r\n\r\n"),
        ("no Host", b"GET /api/info HTTP/1.1\r\n\r\n"),
        ("two Hosts", head(program, get, f"Host: 127.0.0.1:{program.port}")),
        ("a folded header", head(program, get, "X: a", " b")),
        ("a header without a name", head(program, get, ": a")),
        ("a zero in a header", head(program, get, "X: a\0b")),
        ("two lengths", head(program, post, "Content-Length: 2", "Content-Length: 3")),
        ("a negative length", head(program, post, "Content-Length: -1")),
        ("a huge length", head(program, post, "Content-Length: 99999999999999999999999")),
        ("2 MB announced", head(program, post, "Content-Length: 2000000")),
        ("chunks", head(program, post, "Transfer-Encoding: chunked") + b"0\r\n\r\n"),
        ("100 kB of a line", head(program, "GET /api/info?x=" + "y" * 100_000 + " HTTP/1.1")),
        ("a line without end", b"GET /" + b"y" * 100_000),
        ("20 kB of headers", head(program, get, *["X: " + "y" * 96] * 200)),
        ("deep JSON", head(program, post, "Connection: close", "Content-Length: 200000") + b"[" * 200_000),
        ("no JSON", head(program, post, "Connection: close", "Content-Length: 3") + b"\xff{}"),
    ]:
        say(what, Peer(program).send(data).answer())
    check_answer(program)


def flood(program):
    """Many requests at once, and a connection that asks without a token."""
    how = Peer(program).send(head(program, "GET /api/info HTTP/1.1") * 20_000).answer()
    say("20000 requests at once", how.split(", after")[0])
    say("requests without a token", Peer(program).send(b"GET / HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n" % program.port * 50).answer())
    check_answer(program)


def crowd(program):
    """A thousand connections that say nothing, then a thousand that send a little garbage."""
    silent = [Peer(program) for _ in range(1000)]
    check_answer(program)
    say("1000 silent connections", "the user has an answer")
    for peer in silent:
        peer.socket.close()
    noisy = []
    for _ in range(1000):
        noisy.append(Peer(program).send(b"GET /"))
        if len(noisy) % 250 == 0:
            check_answer(program)
    say("1000 halves of a request", "the user has an answer")
    for peer in noisy:
        peer.socket.close()


def streams(program):
    """More streams than there may be; those that were there go on."""
    peers = [Peer(program) for _ in range(18)]
    for peer in peers:
        peer.send(head(program, "GET /api/stream?paths=Main.n HTTP/1.1", "Connection: close"))
        peer.first = peer.socket.recv(15)
    say("18 streams", ", ".join(f"{sum(p.first.startswith(b'HTTP/1.1 ' + s) for p in peers)} times {s.decode()}" for s in (b"200", b"409")))
    for peer in peers:
        peer.socket.close()
    check_answer(program)


def patience(program):
    """Those who make the monitor wait are cut off after 10 s; the others notice nothing."""
    answers = {}

    def slow_reader():
        peer = Peer(program, small=True)
        peer.send(head(program, "GET /api/stream?paths=Main.a&rate=1000 HTTP/1.1"))
        time.sleep(30)
        answers["a stream that nobody reads"] = "is left alone" if peer.read() is None else "cut off"

    def slow_values():
        peer = Peer(program, small=True)
        peer.send(head(program, "GET /api/symbols?count=100000 HTTP/1.1") * 100)
        time.sleep(30)
        answers["replies that nobody reads"] = "is left alone" if peer.read() is None else "cut off"

    def waits(what, data):
        peer = Peer(program)
        begin = time.monotonic()
        how = peer.send(data).answer()
        answers[what] = how if 8 < time.monotonic() - begin < 40 else f"{how} after {time.monotonic() - begin:.0f} s"

    def drip():
        peer = Peer(program)
        data = head(program, "GET /api/info HTTP/1.1")
        for byte in data[:40]:
            peer.send(bytes([byte]))
            time.sleep(0.5)
        answers["a byte each half second"] = peer.answer()

    post = head(program, "POST /api/write HTTP/1.1", "Content-Length: 100")
    threads = [
        threading.Thread(target=slow_reader),
        threading.Thread(target=slow_values),
        threading.Thread(target=waits, args=("silence", b"")),
        threading.Thread(target=waits, args=("half a request", b"GET /api/info HTTP/1.1\r\nHost:")),
        threading.Thread(target=waits, args=("half a body", post + b"{")),
        threading.Thread(target=drip),
    ]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        check_answer(program)
        time.sleep(0.5)
    for what in sorted(answers):
        say(what, answers[what])


def main():
    program = Program(sys.argv[1:])
    try:
        for act in (broken_requests, flood, crowd, streams, patience):
            act(program)
        say("the program", program.get("/api/info")["state"])
    finally:
        code, _, messages = program.end()
    say("its exit code", code)
    if messages:
        print(messages)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# A stranger at the other end of `rung lsp`: broken JSON, wrong headers, unknown methods, requests before the first and
# after the last, parameters of other types, places that no file has, files of bytes, folders that contain themselves,
# buffers and files that change while requests run. Each request that is one gets exactly one answer, and the server
# goes on.
#
#   fuzz.py SEED COUNT      about COUNT messages, in sessions with a few hundred each
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import CAPABILITIES, read_text, uri  # noqa: E402
from edits import POSITIONED, path_of, sources_in  # noqa: E402

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SOURCES = ["samples/boiler", "samples/tank", "tests/programs/vendor/twincat", "tests/programs/vendor/iec10",
           "tests/programs/vendor/codesys2", "samples/milling_machine"]
SECONDS = 60  # for an answer, on a busy machine
PER_SESSION = 250

WITH_DOCUMENT = ["documentSymbol", "foldingRange", "semanticTokens/full", "semanticTokens/full/delta", "formatting",
                 "codeLens", "documentLink"]
WITH_RANGE = ["semanticTokens/range", "inlayHint", "codeAction", "rangeFormatting"]
WITH_POSITION = POSITIONED + ["prepareRename", "rename", "prepareCallHierarchy", "prepareTypeHierarchy", "onTypeFormatting"]
OTHERS = ["workspace/symbol", "callHierarchy/incomingCalls", "callHierarchy/outgoingCalls", "typeHierarchy/supertypes",
          "typeHierarchy/subtypes", "codeLens/resolve", "completionItem/resolve"]
UNKNOWN = ["", "x", "textDocument/", "rung/unknown", "$/unknown", "initialize", "exit", "textDocument/hover\u0000", "ü" * 5000]
NOTIFICATIONS = ["textDocument/didOpen", "textDocument/didChange", "textDocument/didClose", "textDocument/didSave",
                 "workspace/didChangeWorkspaceFolders", "workspace/didChangeWatchedFiles", "initialized", "$/setTrace",
                 "$/cancelRequest"]
TYPED = ["x", ";", "\n", "(*", "'", "END_IF", ":=", "VAR", "]]>", "<", "{", "\x00", "\ud800", "ü", "\U0001f600", "(" * 300,
         "IF b THEN\n" * 50, "\r", "x" * 3000]


class Server:
    def __init__(self, arguments=()):
        self.process = subprocess.Popen(["rung", "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.changed = threading.Condition()
        self.answers = {}  # by id: how many
        self.published = {}
        self.ended = False
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        stream = self.process.stdout
        while True:
            length = None
            while (line := stream.readline()) not in (b"", b"\r\n"):
                if line.startswith(b"Content-Length:"):
                    length = int(line[15:])
            message = json.loads(stream.read(length)) if line and length is not None else None
            with self.changed:
                if message is None:
                    self.ended = True
                elif "method" not in message:
                    identifier = json.dumps(message.get("id"))
                    self.answers[identifier] = self.answers.get(identifier, 0) + 1
                elif message["method"] == "textDocument/publishDiagnostics":
                    self.published[message["params"]["uri"]] = message["params"]["diagnostics"]
                self.changed.notify_all()
            if message is None:
                return

    def send(self, data):
        try:
            self.process.stdin.write(data)
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # it is said where an answer is missing

    def message(self, value):
        data = json.dumps(value).encode("utf-8", "surrogatepass")
        self.send(b"Content-Length: %d\r\n\r\n" % len(data) + data)


class Fuzzer:
    def __init__(self, seed, log):
        self.random = random.Random(seed)
        self.log = log
        self.next_id = 1
        self.server = None
        self.sent = 0

    def stop(self, why):
        print("\n".join(line[:300] for line in self.log[-12:]))
        sys.exit(why)

    # ---- values

    def anything(self, depth=0):
        kind = self.random.randrange(12)
        if kind < 2 and depth < 4:
            return [self.anything(depth + 1) for _ in range(self.random.randrange(4))]
        if kind < 4 and depth < 4:
            return {self.random.choice(["uri", "line", "range", "text", "id", "x"]): self.anything(depth + 1)
                    for _ in range(self.random.randrange(4))}
        return self.random.choice([None, True, False, 0, -1, 1, 2**31, 2**63, -2**70, 1.5, 1e308, "", "x", "file:///", "\ud800",
                                   "x" * 2000, [], {}])

    # The value with some part of it replaced by something else, removed or doubled.
    def damaged(self, value):
        if isinstance(value, dict) and value and self.random.random() < 0.8:
            key = self.random.choice(sorted(value))
            result = dict(value)
            if self.random.random() < 0.2:
                del result[key]
            else:
                result[key] = self.damaged(value[key])
            return result
        if isinstance(value, list) and value and self.random.random() < 0.8:
            at = self.random.randrange(len(value))
            return value[:at] + [self.damaged(value[at])] + value[at + self.random.randrange(2):]
        return self.anything()

    def position(self):
        if self.random.random() < 0.1:
            return {"line": self.random.choice([-1, 2**31, 2**40, 100000]), "character": self.random.choice([-5, 2**31, 7])}
        lines = self.originals[self.last_file].split("\n")
        line = self.random.randrange(min(len(lines), 200))
        if words := [match.start() for match in re.finditer(r"\w+", lines[line])]:
            return {"line": line, "character": self.random.choice(words)}
        return {"line": line, "character": self.random.randint(0, len(lines[line]))}

    def file(self):
        odd = ["gone.st", "loop/loop/loop", "bin.st", "dir.st", "pipe.st", "zero.st", "..", "/", "a\nb.st", "x" * 300]
        return self.random.choice(odd) if self.random.random() < 0.1 else self.random.choice(self.files)

    def document(self):
        file = self.file()
        if file in self.files:
            self.last_file = file
        name = uri(file)
        if self.random.random() < 0.03:
            name = self.random.choice(["untitled:1", "http://x/y.st", "file://%zz", "file:///%00", "", "file:relative.st"])
        return {"uri": name}

    def range(self):
        start = self.position()
        end = self.position() if self.random.random() < 0.2 else {**start, "character": start["character"] + self.random.randrange(4)}
        return {"start": start, "end": end}

    def params_of(self, method):
        params = {"textDocument": self.document()}
        if method == "semanticTokens/full/delta":
            params["previousResultId"] = str(self.random.randrange(5))
        if method in WITH_RANGE:
            params.update(range=self.range(), context={"diagnostics": []}, options={"tabSize": 2})
        if method in WITH_POSITION:
            params.update(position=self.position(), newName=self.random.choice(["abc", "x", "1", "IF", ""]), ch=";",
                          context={"includeDeclaration": True}, options={"tabSize": self.random.choice([2, -1, 10**9])})
        if method == "selectionRange":
            params["positions"] = [self.position() for _ in range(3)]
        return params

    # ---- messages

    def request(self):
        kind = self.random.random()
        if kind < 0.75:
            method = self.random.choice(WITH_DOCUMENT + WITH_RANGE + WITH_POSITION + ["selectionRange"])
            params = self.params_of(method)
            method = "textDocument/" + method
        elif kind < 0.85:
            method, params = "rung/diagram", {"textDocument": self.document(), "position": self.position()}
        elif kind < 0.93:
            method, params = self.random.choice(OTHERS), {"query": self.random.choice(["", "m", "x" * 500]), "item": self.item()}
        else:
            method, params = self.random.choice(UNKNOWN), self.anything()
        if self.random.random() < 0.2:
            params = self.damaged(params)
        identifier = self.next_id if self.random.random() < 0.8 else "id %d" % self.next_id
        self.next_id += 1
        self.expected.append(json.dumps(identifier))
        self.put({"jsonrpc": "2.0", "id": identifier, "method": method, "params": params})
        if self.random.random() < 0.1:
            self.put({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": identifier}})

    def item(self):
        return {"name": "x", "kind": 12, "uri": uri(self.file()), "range": self.range(), "selectionRange": self.range()}

    def notification(self):
        method = self.random.choice(NOTIFICATIONS[:4] * 5 + NOTIFICATIONS)
        document = self.document()
        document["version"] = self.random.choice([1, 2, 0, -3, 2**40])
        if method == "textDocument/didOpen":
            path = self.file()
            text = self.originals.get(path) or self.random.choice(TYPED)
            document.update(text=text, languageId="st")
        changes = []
        for _ in range(self.random.choice([1, 1, 1, 3, 0])):
            changes.append({"text": self.random.choice(TYPED), "range": self.range()})
        if self.random.random() < 0.3:  # undone
            path = path_of(document["uri"]) if document["uri"].startswith("file:///") else ""
            changes = [{"text": self.originals.get(path, "")}]
        params = {"textDocument": document, "contentChanges": changes, "id": self.random.randrange(self.next_id),
                  "changes": [{"uri": document["uri"], "type": self.random.randrange(5)}],
                  "event": {"added": [{"uri": uri(self.random.choice([".", "loop", "gone"])), "name": "x"}],
                            "removed": [{"uri": uri("loop"), "name": "x"}]}}
        if self.random.random() < 0.15:
            params = self.damaged(params)
        self.put({"jsonrpc": "2.0", "method": method, "params": params})

    # Not a message of JSON-RPC.
    def broken(self):
        whole = json.dumps({"jsonrpc": "2.0", "id": "lost", "method": "textDocument/hover", "params": self.anything()}).encode()
        body = self.random.choice([
            b"", b"null", b"[]", b"{", whole[:self.random.randrange(len(whole))], b"[" * 20000, b'{"a":' * 5000, b"\xff\xfe\x00",
            bytes(self.random.randrange(256) for _ in range(60)), b'{"method": 5, "id": 1.5}', b'{"id": [1]}', b'"\\ud800"',
            b'{"jsonrpc": "2.0", "id": true, "method": "shutdown"}', b"1e999999", b"-", b'{"result": 1, "id": 9999999}',
            b'{"a": 1, "a": 2}', b"[" + whole + b"]", b'"' + b"x" * 100000 + b'"', b"123" * 5000])
        self.log.append("body %r" % body[:200])
        self.server.send(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    # What follows is a message again: a server may wait for the bytes that a header promised.
    def broken_header(self):
        body = b'{"jsonrpc": "2.0", "method": "x"}'
        header = self.random.choice([
            b"Content-Length: -5\r\n\r\n", b"Content-Length: x\r\n\r\n", b"Content-Length: 99999999999999999999999\r\n\r\n",
            b"Content-Length: 1000000000000000\r\n\r\n", b"\r\n", b"\n\n", b"Content-Type: text\r\n\r\n", b"X: " + b"y" * 70000 + b"\r\n\r\n",
            b"X: y\r\n" * 9000 + b"\r\n", b"content-length:33\r\nContent-Type: x; charset=utf-16\r\n\r\n", b"\x00\xff\r\n\r\n",
            b"Content-Length: 10\r\n\r\n", b"Content-Length: 33\n\n", b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"])
        self.log.append("header %r" % header[:100])
        self.server.send(header + body)

    def change_on_disk(self):
        file = self.random.choice(self.files)
        text = self.originals[file]
        at = self.random.randint(0, len(text))
        kind = self.random.randrange(6)
        if kind > 3:
            with open(file, "w", encoding="utf-8", newline="") as stream:
                stream.write(text)
        elif kind == 0 and os.path.exists(file):
            os.remove(file)
        else:
            data = (text[:at] + "\n;" + text[at:]).encode("utf-8", "replace") if kind < 3 else b"\x00\x01\xff" * 50
            with open(file, "wb") as stream:
                stream.write(data)
        self.log.append("on disk " + file)
        if self.random.random() < 0.7:
            changes = [{"uri": uri(file), "type": 2}]
            self.put({"jsonrpc": "2.0", "method": "workspace/didChangeWatchedFiles", "params": {"changes": changes}})

    def put(self, message):
        self.log.append(json.dumps(message))
        self.server.message(message)

    # ---- sessions

    # Every request of now has its answer.
    def wait(self):
        identifier = "sync %d" % self.next_id
        self.next_id += 1
        self.expected.append(json.dumps(identifier))
        self.put({"jsonrpc": "2.0", "id": identifier, "method": "rung/unknown"})
        server = self.server
        with server.changed:
            if not server.changed.wait_for(lambda: server.ended or json.dumps(identifier) in server.answers, SECONDS):
                self.stop("no answer within %d s" % SECONDS)
            if server.ended:
                self.stop("the server has ended: exit code %s" % server.process.wait())
            for one in self.expected:
                if server.answers.get(one, 0) != 1:
                    self.stop("%d answers to the request %s" % (server.answers.get(one, 0), one))
        self.expected = []

    def act(self):
        self.sent += 1
        kind = self.random.random()
        if kind < 0.5:
            self.request()
        elif kind < 0.8:
            self.notification()
        elif kind < 0.88:
            self.broken()
        elif kind < 0.94:
            self.broken_header()
        elif kind < 0.97:
            self.change_on_disk()
        else:
            self.wait()

    # In a copy of a project.
    def session(self):
        self.files = sources_in(".")
        self.originals = {file: read_text(file) for file in self.files}
        self.last_file = self.files[0]
        self.make_odd_files()
        self.expected = []
        self.server = Server(["--max-errors=1000"])
        self.log.append("---- a session in " + os.getcwd())
        for _ in range(self.random.choice([0, 0, 5])):  # before it is initialized
            self.act()
        self.put({"jsonrpc": "2.0", "id": "begin", "method": "initialize", "params": self.beginning()})
        self.expected.append(json.dumps("begin"))
        self.put({"jsonrpc": "2.0", "method": "initialized", "params": {}})
        for at in range(PER_SESSION):
            if at % 40 == 0:
                self.restore()
            self.act()
        self.wait()
        self.finish()

    # What is broken says nothing any more.
    def restore(self):
        for file, text in self.originals.items():
            document = {"uri": uri(file), "languageId": "st", "version": 1, "text": text}
            self.put({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}})

    def beginning(self):
        params = {"processId": None, "rootUri": None, "capabilities": CAPABILITIES,
                  "workspaceFolders": [{"uri": uri("."), "name": "x"}]}
        return params if self.random.random() < 0.7 else self.damaged(params)

    def make_odd_files(self):
        os.symlink(".", "loop")
        os.symlink("gone", "gone.st")
        os.symlink("self.st", "self.st")
        os.symlink("/dev/zero", "zero.st")
        os.mkfifo("pipe.st")
        os.mkdir("dir.st")
        with open("bin.st", "wb") as stream:
            stream.write(bytes(self.random.randrange(256) for _ in range(3000)))

    # Sometimes as it should be, sometimes the client is just gone.
    def finish(self):
        way = self.random.randrange(3)
        if way < 2:
            self.expected.append(json.dumps("end"))
            self.put({"jsonrpc": "2.0", "id": "end", "method": "shutdown"})
            for _ in range(self.random.choice([0, 4])):
                self.request()
            self.wait()
        if way == 0:
            self.put({"jsonrpc": "2.0", "method": "exit"})
        else:
            self.server.process.stdin.close()
        try:
            code = self.server.process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            self.stop("the server does not end")
        if code != (0 if way < 2 else 1):
            self.stop("exit code %d" % code)


def main():
    seed, count = int(sys.argv[1]), int(sys.argv[2])
    fuzzer, sessions = Fuzzer(seed, []), 0
    here = os.getcwd()
    while fuzzer.sent < count:
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, "project")
            shutil.copytree(os.path.join(ROOT, SOURCES[(seed + sessions) % len(SOURCES)]), copy)
            os.chdir(copy)
            fuzzer.session()
            os.chdir(here)
        sessions += 1
    print("%d sessions, every request has one answer" % sessions)


if __name__ == "__main__":
    main()

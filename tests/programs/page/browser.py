#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium that a test drives by the DevTools protocol: it opens a page, clicks and types as a user does,
evaluates expressions and takes pictures. In: the address of a page. Used by the tests of the monitor's page."""

import base64
import json
import os
import shutil
import socket
import struct
import subprocess
import tempfile
import time
import urllib.parse
import urllib.request

PATIENCE = 30  # seconds, of everything that is waited for: a test machine may be busy


class Failure(Exception):
    pass


def until(condition, what, patience=PATIENCE):
    """Waits until the condition gives something, which it returns."""
    end = time.monotonic() + patience
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise Failure(f"not within {patience} s: {what}")
        time.sleep(0.05)


class Socket:
    """A WebSocket (RFC 6455) to the browser: whole texts, no extensions."""

    def __init__(self, url):
        parts = urllib.parse.urlparse(url)
        self.connection = socket.create_connection((parts.hostname, parts.port), PATIENCE)
        key = base64.b64encode(os.urandom(16)).decode()
        self.connection.sendall(
            f"GET {parts.path} HTTP/1.1\r\nHost: {parts.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.received = b""
        while b"\r\n\r\n" not in self.received:
            self.received += self.connection.recv(4096)
        head, self.received = self.received.split(b"\r\n\r\n", 1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise Failure(f"no WebSocket: {head!r}")

    def send(self, text):
        data = text.encode()
        size = len(data)
        head = bytes([0x81])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 65536:
            head += bytes([0x80 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", size)
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))
        self.connection.sendall(head + mask + masked)

    def take(self, count):
        while len(self.received) < count:
            more = self.connection.recv(65536)
            if not more:
                raise Failure("the browser has closed its connection")
            self.received += more
        data, self.received = self.received[:count], self.received[count:]
        return data

    def receive(self):
        text = b""
        while True:
            first, second = self.take(2)
            size = second & 127
            if size == 126:
                size = struct.unpack(">H", self.take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.take(8))[0]
            data = self.take(size)
            if first & 15 in (0, 1):
                text += data
                if first & 128:
                    return text.decode()


class Page:
    """A page in a Chromium of its own, closed at the end of `with`."""

    def __init__(self, url, width=1400, height=900, dark=False):
        self.folder = tempfile.mkdtemp(prefix="rung-browser-")
        self.log = open(os.path.join(self.folder, "log"), "wb")
        # A test has no sandbox: it may run as root in a container, and the page is Rung's own.
        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
             "--remote-debugging-port=0", f"--user-data-dir={self.folder}/profile", "about:blank"],
            stdout=self.log, stderr=self.log)
        self.number = 0
        self.errors = []
        try:
            self.connect()
            self.call("Page.enable")
            self.call("Runtime.enable")
            self.call("Log.enable")
            self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
            self.scheme("dark" if dark else "light")
            self.call("Page.navigate", url=url)
        except BaseException:
            self.close()
            raise

    def connect(self):
        file = os.path.join(self.folder, "profile", "DevToolsActivePort")
        port = until(lambda: os.path.exists(file) and open(file).readline().strip(), "Chromium starts")
        def target():
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/json", timeout=PATIENCE) as reply:
                return next((entry for entry in json.load(reply) if entry["type"] == "page"), None)
        self.socket = Socket(until(target, "Chromium has a page")["webSocketDebuggerUrl"])

    def close(self):
        self.process.terminate()
        try:
            self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.log.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def call(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.receive())
            if message.get("method") == "Runtime.exceptionThrown":
                details = message["params"]["exceptionDetails"]
                self.errors.append(details.get("exception", {}).get("description") or details["text"])
            if message.get("method") == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
                self.errors.append(message["params"]["entry"]["text"])
            if message.get("id") == self.number:
                if "error" in message:
                    raise Failure(f"{method}: {message['error']['message']}")
                return message["result"]

    def scheme(self, name):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise Failure(f"{expression}: {details.get('exception', {}).get('description', details['text'])}")
        return result["result"].get("value")

    def until(self, expression):
        """Waits until the expression is true in the page, which may not be complete yet."""
        return until(lambda: self.evaluate(f"(() => {{ try {{ return !!({expression}) }} catch {{ return false }} }})()"),
                     expression)

    def click(self, selector, root="document"):
        """Clicks in the middle of the element, as a user does: what covers it gets the click."""
        found = f"{root}.querySelector({json.dumps(selector)})"
        self.until(f"(e => e && e.getClientRects().length > 0 && !e.disabled)({found})")
        place = (f"(e => {{ e.scrollIntoView({{block: 'center', inline: 'center'}}); const r = e.getBoundingClientRect();"
                 f" return JSON.stringify([r.x + r.width / 2, r.y + r.height / 2]) }})({found})")
        seen = []

        def rests():  # what appears above an element moves it
            seen.append(self.evaluate(place))
            return len(seen) > 1 and seen[-1] == seen[-2]
        until(rests, f"{selector} stays where it is")
        box = json.loads(seen[-1])
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=box[0], y=box[1], button="left", clickCount=1)

    def type(self, text):
        self.call("Input.insertText", text=text)

    def press(self, key, **options):
        codes = {"Enter": 13, "Escape": 27, "ArrowDown": 40, "ArrowUp": 38, "ArrowRight": 39, "ArrowLeft": 37, "Tab": 9}
        parameters = {"key": key, "code": key, "windowsVirtualKeyCode": codes.get(key, ord(key[0].upper())), **options}
        text = "\r" if key == "Enter" else key if len(key) == 1 else ""
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **parameters)
        self.call("Input.dispatchKeyEvent", type="keyUp", **parameters)

    def picture(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

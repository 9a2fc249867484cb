#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A program that runs with a monitor, and its API. In: the options of `rung run`. Used by the tests of the page."""

import json
import subprocess
import urllib.error
import urllib.parse
import urllib.request

from browser import PATIENCE, Failure, until


class Program:
    """Runs until the end of `with`."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(["rung", "run", *arguments, "--monitor", "0"], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True)
        self.said = []
        for line in self.process.stderr:
            self.said.append(line)
            if line.startswith("monitor: "):
                self.url = line.split()[1]
                break
        else:
            raise Failure("no monitor: " + "".join(self.said))
        parts = urllib.parse.urlparse(self.url)
        self.base = f"http://{parts.netloc}"
        self.token = urllib.parse.parse_qs(parts.query)["token"][0]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate()

    def ask(self, path, body=None):
        request = urllib.request.Request(self.base + path, headers={"Authorization": "Bearer " + self.token},
                                         data=None if body is None else json.dumps(body).encode())
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE) as reply:
                return json.load(reply)
        except urllib.error.HTTPError as error:
            raise Failure(f"{path}: {error.read().decode()}") from error

    def value(self, path):
        return self.ask("/api/values?paths=" + urllib.parse.quote(path))["values"][path]

    def state(self):
        return self.ask("/api/info")["state"]

    def forces(self):
        return self.ask("/api/forces")["values"]

    def wait_for(self, path, value):
        until(lambda: self.value(path) == value, f"{path} is {value}")

    def wait_for_state(self, state):
        until(lambda: self.state() == state, f"the program is {state}")

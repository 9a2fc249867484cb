#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# A client of the monitor of a running program for tests: starts a program, does what the lines of a script say, and
# prints the answers. In: a script on stdin. Out: status and body of each answer, without what depends on the clock.
#
#   client.py COMMAND ...          starts `COMMAND … --monitor 0` and takes the URL from what it prints
#
#   GET PATH                       a request; prints the status and the body
#   POST PATH JSON                 the same with a body
#   whole GET PATH                 with `cycle` and `time_ms` too
#   until PATH EXPRESSION          asks until the expression of the body, as `body`, is true; prints how it looks then
#   headers JSON PATH              GET with these headers in place of the usual ones; `TOKEN` and `PORT` are replaced
#   stream N PATH                  the values of the first N events; then it closes the connection
#   rung ARGUMENTS                 `rung monitor URL ARGUMENTS`: its output and exit code
#   sh COMMAND                     URL, TOKEN, PORT and PID are in its environment
#   wait                           until the program has ended: prints its exit code and the rest of its output but the number of cycles
import http.client
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import threading
import time

SECONDS = 60


class Program:
    """A program that runs with a monitor."""

    def __init__(self, command):
        self.process = subprocess.Popen(
            [*command, "--monitor", "0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace"
        )
        timer = threading.Timer(SECONDS * 4, self.process.kill)
        timer.daemon = True
        timer.start()
        self.messages = []
        for line in self.process.stderr:
            found = re.match(r"monitor: (http://([^:/]*):(\d+)/\?token=(\w+))\n", line)
            if found:
                self.url, self.host, self.port, self.token = found[1], found[2], int(found[3]), found[4]
                return
            self.messages.append(line)
        sys.exit("the program has no monitor: " + "".join(self.messages))

    def ask(self, method, path, body=None, headers=None):
        """Returns the status and the value of the body."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=SECONDS)
        try:
            if headers is None:
                headers = {"Authorization": "Bearer " + self.token}
            connection.request(method, path, body=body, headers=headers)
            answer = connection.getresponse()
            text = answer.read().decode("utf-8")
            is_json = answer.headers["Content-Type"] == "application/json"
            return answer.status, json.loads(text) if is_json else text
        finally:
            connection.close()

    def get(self, path):
        return self.ask("GET", path)[1]

    def post(self, path, value):
        return self.ask("POST", path, json.dumps(value))

    def events(self, path):
        """The events of a stream, one after the other."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=SECONDS)
        connection.request("GET", path, headers={"Authorization": "Bearer " + self.token})
        answer = connection.getresponse()
        if answer.status != 200:
            yield json.loads(answer.read())
            return
        for line in answer:
            if line.startswith(b"data: "):
                yield json.loads(line[6:])

    def until(self, path, holds):
        """Asks until the answer is as expected."""
        end = time.monotonic() + SECONDS
        while True:
            body = self.get(path)
            if holds(body):
                return body
            if time.monotonic() > end:
                sys.exit(f"{path} did not become what was expected: {json.dumps(body)}")
            time.sleep(0.01)

    def wait(self):
        try:
            output, messages = self.process.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.process.kill()
            sys.exit("the program does not end")
        return self.process.returncode, output, messages

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.wait()


def without_clock(value):
    if isinstance(value, dict):
        return {key: without_clock(item) for key, item in value.items() if key not in ("cycle", "time_ms")}
    if isinstance(value, list):
        return [without_clock(item) for item in value]
    return value


def show(answer, whole=False):
    status, body = answer
    print(status, body.strip() if isinstance(body, str) else json.dumps(body if whole else without_clock(body)))


def run_rung(program, arguments):
    done = subprocess.run(
        ["rung", "monitor", program.url, *shlex.split(arguments)], capture_output=True, text=True, timeout=SECONDS
    )
    print(done.stdout + done.stderr.replace(program.url, "URL"), end="")
    if done.returncode != 0:
        print(f"[{done.returncode}]")


def follow(program, line):
    word, _, rest = line.partition(" ")
    if word == "GET":
        show(program.ask("GET", rest))
    elif word == "POST":
        path, _, body = rest.partition(" ")
        show(program.ask("POST", path, body))
    elif word == "whole":
        show(program.ask("GET", rest.partition(" ")[2]), True)
    elif word == "until":
        path, _, expression = rest.partition(" ")
        show((200, program.until(path, lambda body: eval(expression, {"body": body}))))
    elif word == "headers":
        text, path = re.match(r"(\{.*?\}) (.*)", rest).groups()
        headers = json.loads(text.replace("TOKEN", program.token).replace("PORT", str(program.port)))
        show(program.ask("GET", path, headers=headers))
    elif word == "stream":
        count, path = rest.split()
        for number, event in enumerate(program.events(path), 1):
            print(json.dumps(without_clock(event)))
            if number == int(count):
                break
    elif word == "rung":
        run_rung(program, rest)
    elif word == "sh":
        environment = dict(os.environ, URL=program.url, TOKEN=program.token, PORT=str(program.port), PID=str(program.process.pid))
        sys.stdout.flush()
        subprocess.run(rest, shell=True, env=environment, timeout=SECONDS)
    elif word == "wait":
        code, output, messages = program.wait()
        print(re.sub(r"^\d+ cycles of .*\n", "", output, flags=re.M) + messages, end="")
        print(f"[{code}]")
    else:
        sys.exit("unknown line: " + line)


def main():
    program = Program(sys.argv[1:])
    try:
        for line in sys.stdin:
            if line.strip():
                follow(program, line.strip())
    finally:
        program.end()


if __name__ == "__main__":
    main()

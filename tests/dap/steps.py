#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Steps through programs in every way and back, and compares: the statements that a step into each visits are those that
# coverage counts, the run ends with the trace of `rung run`, and each stop on the way back has the memory that it had on
# the way there.
#   steps.py [--stops N] [--tests] PROGRAM ...     PROGRAM: a file or folder; --tests: each {test} in the file
# Prints a line for each difference, and a count. Exit code 1: there is a difference.
import argparse
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Client  # noqa: E402

CYCLES = 3
PARTS = (["AND"], ["OR"], ["XOR"], ["+"], ["-"], ["*"], ["input"])


class Session:
    def __init__(self, program, arguments):
        self.client = Client()
        self.client.request("initialize", {"adapterID": "rung"})
        answer = self.client.request("launch", {"program": program, "args": arguments, "stopOnEntry": True})
        self.error = None if answer["success"] else answer["message"]
        self.thread = 1

    def run(self, command, arguments=None):
        answer = self.client.request(command, arguments if arguments is not None else {"threadId": self.thread, "granularity": "statement"})
        if not answer["success"]:
            return "error " + answer["message"]
        event = self.client.wait("stopped", "terminated", "end")
        if event["event"] != "stopped":
            return event["event"]
        self.thread = event["body"]["threadId"]
        return event["body"]["reason"]

    def start(self):
        return self.run("configurationDone", {})

    def state(self):
        frames = self.client.request("stackTrace", {"threadId": self.thread, "granularity": "statement"})["body"]["stackFrames"]
        memory = self.client.request("rung/memoryHash")["body"]["hash"]
        return tuple((f["name"], f.get("source", {}).get("path"), f["line"], f["column"]) for f in frames), memory


def rung(*arguments):
    return subprocess.run(["rung", *arguments], capture_output=True, text=True)


class Check:
    def __init__(self, program, stops, test=None):
        self.program = os.path.abspath(program)
        self.stops = stops
        self.test = test
        self.problems = []
        self.arguments = ["--cycles", str(CYCLES)] if test is None else ["--test", test]

    def problem(self, text):
        self.problems.append(f"{self.program}{' ' + self.test if self.test else ''}: {text}")

    # Every kind of step on the way there, and back by the same number of stops.
    def walk(self, command):
        session = Session(self.program, self.arguments)
        if session.error:
            return 0
        reason, states = session.start(), []
        while reason not in ("terminated", "end") and len(states) < self.stops:
            if reason.startswith("error"):
                self.problem(f"{command}: {reason}")
                break
            states.append(session.state())
            reason = session.run(command)
            if reason == "exception":  # of the test
                reason = session.run(command)
        ended = reason == "terminated"
        if command == "stepIn" and not ended:
            self.back(session, states + [session.state()])
        session.client.end()
        if command == "stepIn" and ended and self.test is not None:
            self.coverage(states)
        return len(states)

    # What a step into each statement visits is what coverage counts, which leaves tests out. A line that goes on with an
    # operator or a pin is a part of a statement.
    def coverage(self, states):
        lines = {frames[0][1:3] for frames, _ in states}
        texts = open(self.program, encoding="utf-8", errors="replace").read().split("\n")
        with tempfile.TemporaryDirectory() as folder:
            counts = os.path.join(folder, "counts")
            rung("test", self.program, "--filter", self.test, "--lcov", counts, "-O0")
            source = None
            for text in open(counts) if os.path.exists(counts) else []:
                kind, _, rest = text.strip().partition(":")
                if kind == "SF":
                    source = os.path.abspath(rest)
                if kind == "DA" and source == self.program:
                    line, _, count = rest.partition(",")
                    before, text = texts[int(line) - 2].strip(), texts[int(line) - 1].split()[:1]
                    goes_on = text in PARTS or before.endswith((",", "("))
                    if ((source, int(line)) in lines) != (int(count) > 0) and not goes_on:
                        self.problem(f"line {line}: coverage says {count}")

    # Back statement by statement: each stop has the state that it had on the way there.
    def back(self, session, states):
        for state in reversed(states[:-1]):
            reason = session.run("stepBack")
            if reason == "entry":  # the history begins: stepping back is over calls, so it takes fewer steps
                if session.state() != states[0]:
                    self.problem("stepBack: the history begins elsewhere")
                return None
            if reason != "step":
                return self.problem(f"stepBack: {reason}")
            if session.state()[0][-1:] != state[0][-1:]:  # stepping back is over calls
                continue
            if session.state() not in states:
                return self.problem(f"stepBack: a state that was not there: {session.state()[0][:1]}")
        return None

    # goto cycle 0 and on again: the same memory at the begin of each cycle.
    def cycles(self):
        session = Session(self.program, self.arguments)
        if session.error:
            return
        session.start()
        hashes = []
        for direction in (range(CYCLES), reversed(range(CYCLES)), range(CYCLES)):
            for cycle in direction:
                session.run("rung/gotoCycle", {"cycle": cycle})
                hashes.append((cycle, session.state()[1]))
        known = {}
        for cycle, value in hashes:
            if known.setdefault(cycle, value) != value:
                self.problem(f"cycle {cycle} has another memory when it comes again")
                break
        session.client.end()

    # The trace of a run, of the debugger, and of the debugger that goes back in between.
    def traces(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("run", "debug", "back")]
            wanted = rung("run", self.program, "--cycles", str(CYCLES), "--engine=interp", "--trace", paths[0])
            debug = ["debug", self.program, "--cycles", str(CYCLES), "--batch"]
            plain = rung(*debug, "--trace", paths[1], "-c", "catch none", "-c", "run")
            back = rung(*debug, "--trace", paths[2], "-c", "catch none", "-c", "start", "-c", "step 20", "-c", "back 5",
                        "-c", "goto 0", "-c", "goto 1", "-c", "backi 3", "-c", "continue")
            texts = [open(path).read() if os.path.exists(path) else "" for path in paths]
            if not texts[0] == texts[1] == texts[2]:
                self.problem(f"traces differ: {[len(text) for text in texts]}")
            if not wanted.returncode == plain.returncode == back.returncode:
                self.problem(f"exit codes {wanted.returncode} {plain.returncode} {back.returncode}")



def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--stops", type=int, default=60)
    parser.add_argument("--tests", action="store_true")
    parser.add_argument("programs", nargs="+")
    options = parser.parse_args()
    programs = stops = 0
    problems = []
    checks = []
    for program in options.programs:
        if not options.tests:
            checks.append(Check(program, options.stops))
            continue
        listed = rung("test", program, "--list", "--format=json")
        for test in json.loads(listed.stdout or "[]"):
            checks.append(Check(program, options.stops, test["name"]))
    for check in checks:
        visited = check.walk("stepIn")
        if not visited:
            continue
        programs += 1
        stops += visited
        for command in ("next", "stepOut", "rung/stepCycle"):
            stops += check.walk(command)
        if check.test is None:
            check.cycles()
            check.traces()
        problems += check.problems
        for problem in check.problems:
            print(problem, flush=True)
    print(f"{programs} programs, {stops} stops, {len(problems)} differences")
    sys.exit(1 if problems or not programs else 0)


if __name__ == "__main__":
    main()

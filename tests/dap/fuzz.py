#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Sends requests of the debug adapter protocol in any order and with any arguments, whole and broken: each request that
# can be read gets one response, and the process goes on.
#   fuzz.py [--seed S] [--messages N] PROGRAM
import argparse
import json
import os
import random
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Client  # noqa: E402

COMMANDS = """initialize launch configurationDone setBreakpoints setFunctionBreakpoints setExceptionBreakpoints
dataBreakpointInfo setDataBreakpoints breakpointLocations threads continue next stepIn stepOut stepBack reverseContinue
pause exceptionInfo stackTrace scopes variables setVariable setExpression evaluate completions loadedSources
rung/stepCycle rung/stepActivation rung/gotoCycle rung/lastWrite rung/memoryHash cancel restart attach source
nonsense""".split()
NAMES = """source path breakpoints line column condition hitCondition logMessage name dataId filters variablesReference
frameId threadId startFrame levels start count expression context value text cycle granularity program args cycles
stopOnEntry test endLine accessType""".split()
EXPRESSIONS = ["Main.n", "n + 1", "n / 0", "(", "", "prev(n)", "a[99]", "a[1]", "THIS^", "x.y.z", "1 = ", "n := 3",
               "force Main.n := 4", "unforce Main.n", "'text'", "T#1s * 3", "((((((((1))))))))", "ABS(-3)", "%IB0"]


def value(chance, depth=0):
    kind = chance.randrange(10 if depth < 3 else 6)
    if kind == 0:
        return None
    if kind == 1:
        return chance.choice([True, False])
    if kind in (2, 3):
        return chance.choice([0, 1, 2, 3, 7, 17, -1, 2**31, 2**53, -(2**40), 0.5])
    if kind in (4, 5):
        return chance.choice(EXPRESSIONS + ["main.st", "/", "statement", "line", "repl", "hover", "uncaught", "Main"])
    if kind in (6, 7):
        return [value(chance, depth + 1) for _ in range(chance.randrange(4))]
    return {chance.choice(NAMES): value(chance, depth + 1) for _ in range(chance.randrange(5))}


def likely(chance, program):
    """Arguments that mean something more often."""
    return {
        "source": {"path": program},
        "breakpoints": [{"line": chance.randrange(12), "condition": chance.choice(EXPRESSIONS)},
                        {"line": chance.randrange(12), "name": "Main", "dataId": "Main.n"}],
        "threadId": 1,
        "frameId": 1,
        "variablesReference": chance.randrange(6),
        "name": chance.choice(["n", "a", "[1]", "x"]),
        "value": chance.choice(["1", "TRUE", "'x'", "n + 1"]),
        "expression": chance.choice(EXPRESSIONS),
        "context": chance.choice(["repl", "watch"]),
        "text": chance.choice(["n", "a[", "Main."]),
        "column": chance.randrange(8),
        "cycle": chance.randrange(30),
        "dataId": "Main.n",
        "filters": ["faults", "assertions"],
        "line": chance.randrange(12),
    }


class Fuzz:
    def __init__(self, options):
        self.options = options
        self.chance = random.Random(options.seed)
        self.client = Client()
        self.sent = self.answered = 0
        self.history = []

    def message(self):
        chance = self.chance
        kind = chance.randrange(20)
        if kind == 0:
            self.client.send(chance.choice(["{", "[]", "7", '{"seq": 1}', '{"type": "request"}', "\x00", '{"type": 3}']))
            return
        if kind == 1:
            self.client.write(chance.choice([b"hello\r\n\r\n", b"Content-Length: x\r\n\r\n", b"\r\n\r\n",
                                             b"Content-Length: 2\r\nX: y\r\n\r\n{}"]))
            return
        command = chance.choice(COMMANDS)
        arguments = likely(chance, self.options.program) if chance.randrange(3) else value(chance)
        if command == "launch" and isinstance(arguments, dict) and "program" not in arguments:
            arguments["program"] = self.options.program
            arguments["cycles"] = 40
        self.sent += 1
        self.history.append(f"{command} {json.dumps(arguments)}")
        answer = self.client.request(command, arguments)
        if answer.get("ended"):
            sys.exit(f"seed {self.options.seed}: the adapter ended after\n" + "\n".join(self.history[-20:]))
        self.answered += 1
        self.client.events.clear()

    def run(self):
        self.client.request("initialize", {"adapterID": "rung"})
        if self.chance.randrange(4):
            self.client.request("launch", {"program": self.options.program, "cycles": 40})
        for _ in range(self.options.messages):
            self.message()
        code = self.client.end()
        return code


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--messages", type=int, default=300)
    parser.add_argument("program")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    sent = answered = 0
    for _ in range(options.seeds):
        fuzz = Fuzz(options)
        code = fuzz.run()
        if code not in (0, 3):
            sys.exit(f"seed {options.seed}: exit code {code}")
        sent += fuzz.sent
        answered += fuzz.answered
        options.seed += 1
    print(f"{sent} requests, {sent - answered} without a response")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# What the language server needs on the project of 100 files and 100 000 lines of project.py: the CPU time of each answer
# and the memory over many edits. Each edit is followed by diagnostics, as after a key; requests come in between.
#
#   editor.py [EDITS]      10 000 edits without a number
import os
import random
import re
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "lsp"))
from client import CAPABILITIES, Client, read_text, uri  # noqa: E402
from edits import position_of, sources_in  # noqa: E402

MOST_MEGABYTES = 250
# What each may cost: milliseconds of CPU, median.
LIMITS = {"start": 300, "body": 30, "declaration": 150, "hover": 10, "definition": 10, "completion": 10, "references": 100,
          "rename": 100, "symbols": 50}
LATE = {"body": 60}  # 99th percentile


def process_of(client):
    children = "/proc/%d/task/%d/children" % (client.process.pid, client.process.pid)
    for _ in range(100):
        with open(children, encoding="ascii") as stream:
            if found := stream.read().split():
                return int(found[0])
        time.sleep(0.01)
    sys.exit("no server")


# With its ended children: copies of the process that try something.
def cpu_of(pid):
    with open("/proc/%d/stat" % pid, encoding="ascii") as stream:
        fields = stream.read().rsplit(")", 1)[1].split()
    with open("/proc/%d/schedstat" % pid, encoding="ascii") as stream:
        main = int(stream.read().split()[0]) / 1e6
    others = 0.0
    for task in os.listdir("/proc/%d/task" % pid):
        if int(task) != pid:
            with open("/proc/%d/task/%s/schedstat" % (pid, task), encoding="ascii") as stream:
                others += int(stream.read().split()[0]) / 1e6
    return main + others, (int(fields[13]) + int(fields[14])) * 1000 / os.sysconf("SC_CLK_TCK")


def megabytes_of(pid):
    with open("/proc/%d/status" % pid, encoding="ascii") as stream:
        return int(re.search(r"VmRSS:\s*(\d+)", stream.read())[1]) / 1024


class Bench:
    def __init__(self, edits):
        self.random = random.Random(1)
        self.edits = edits
        self.figures = {}
        self.client = Client(["--max-errors=1000"])
        self.pid = process_of(self.client)
        self.client.initialize(["."], CAPABILITIES)
        self.files = [file for file in sources_in(".") if file.endswith(".st")]
        self.texts = {file: read_text(file) for file in self.files}
        self.client.open(self.files[0], self.texts[self.files[0]])
        self.client.settle()
        self.figures["start"] = [sum(cpu_of(self.pid))]
        for file in self.files[1:3]:
            self.client.open(file, self.texts[file])
        self.client.settle()

    def measured(self, name, action):
        before = sum(cpu_of(self.pid))
        action()
        self.figures.setdefault(name, []).append(sum(cpu_of(self.pid)) - before)

    # Types a character at a place, and takes it away with the next edit.
    def edit(self, name, file, at, text):
        for begin, end, new in ((at, at, text), (at, at + len(text), "")):
            lines = self.texts[file]
            change = {"range": {"start": position_of(lines, begin), "end": position_of(lines, end)}, "text": new}
            self.client.change(file, [change])
            self.texts[file] = lines[:begin] + new + lines[end:]
            self.measured(name, self.client.settle)

    def ask(self, name, file, at, method, more):
        params = {"textDocument": {"uri": uri(file)}, "position": position_of(self.texts[file], at), **more}
        self.measured(name, lambda: self.client.request(method, params))

    def run(self):
        memory = []
        for number in range(self.edits // 2):
            file = self.files[number % 3]
            text = self.texts[file]
            statements = [match.end() for match in re.finditer(r"^ *[a-z][\w.]* := (?=[a-z])", text, re.M)]
            is_declaration = number % 50 == 49
            at = text.index("VAR") + 3 if is_declaration else self.random.choice(statements)
            at = text.index("\n", at) if is_declaration else at
            self.edit("declaration" if is_declaration else "body", file, at, "\nzq : INT;" if is_declaration else "1 + ")
            names = [match.start() for match in re.finditer(r"(?<=:= )[a-z]\w*", text)]
            at = self.random.choice(names)
            self.ask("hover", file, at, "textDocument/hover", {})
            self.ask("definition", file, at, "textDocument/definition", {})
            if number % 5 == 0:
                self.ask("references", file, at, "textDocument/references", {"context": {"includeDeclaration": True}})
                self.ask("completion", file, at + 1, "textDocument/completion", {})
                self.measured("tokens", lambda: self.client.request(
                    "textDocument/semanticTokens/full", {"textDocument": {"uri": uri(file)}}))
            if number % 20 == 0:
                self.ask("rename", file, at, "textDocument/rename", {"newName": "n%d" % number})
                self.measured("symbols", lambda: self.client.request("workspace/symbol", {"query": "pc"}))
            if number % (self.edits // 20) == 0:
                memory.append(megabytes_of(self.pid))
        memory.append(megabytes_of(self.pid))
        self.client.finish()
        return self.report(memory)

    def report(self, memory):
        failed = []
        for name, values in self.figures.items():
            values.sort()
            median, late = values[len(values) // 2], values[min(len(values) - 1, len(values) * 99 // 100)]
            if median > LIMITS.get(name, median) or late > LATE.get(name, late):
                failed.append(name)
            limit = "limit %d" % LIMITS[name] if name in LIMITS else ""
            print("%-12s %6d times  median %7.2f ms  99%% %7.2f ms  %s" % (name, len(values), median, late, limit))
        print("memory       " + " ".join("%.0f" % value for value in memory) + " MB, limit %d" % MOST_MEGABYTES)
        if max(memory) > MOST_MEGABYTES:
            failed.append("memory")
        print("within the limits" if not failed else "beyond its limit: " + ", ".join(failed))
        return not failed


def main():
    edits = int(sys.argv[1]) if len(sys.argv) > 1 else 10000
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.path.join(HERE, "project.py"), folder], check=True)
        os.chdir(folder)
        sys.exit(0 if Bench(edits).run() else 1)


if __name__ == "__main__":
    main()

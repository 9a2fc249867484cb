#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# A session of random edits with `rung lsp`: after each pause its diagnostics are those of `rung check` on files with the
# same texts. Text is typed character by character, also from other places of the project, cut, undone; files are closed,
# opened, and changed on disk. After each pause every request is asked at random places: none is answered by an error, and
# the ranges in the answers exist.
#
#   edits.py FOLDER [--seed N] [--pauses N]      a folder with a project, of which it works on a copy
#   edits.py FOLDER --type N [--most BYTES]      N of its files, of that size at most, are typed from the first character
#                                                to the last, with pauses after some of them
#
# Prints the first difference with the edits that led to it, or one line.
import argparse
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import CAPABILITIES, Client, read_text, uri  # noqa: E402

SOURCES = (".st", ".il", ".pou", ".tcpou", ".tcdut", ".tcgvl", ".tctto", ".tcio", ".plcproj", ".xml", ".exp", ".nct", ".cam",
           "rung.project")
TYPED = ["x", ";", " ", "\n", "(", ")", "'", "IF ", "END_IF", ":=", "n.", "VAR", "END_VAR", "<", "]]>", "//", "(*", "{", "ü"]

# Requests at a position, and of a document.
POSITIONED = ["hover", "definition", "declaration", "typeDefinition", "implementation", "signatureHelp", "completion",
              "references", "documentHighlight"]
WHOLE = ["documentSymbol", "foldingRange", "semanticTokens/full", "formatting"]


def sources_in(folder):
    found = []
    for path, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(files):
            if name.lower().endswith(SOURCES):
                found.append(os.path.relpath(os.path.join(path, name), folder))
    return found


# Offsets in Python strings are code points, those of the protocol UTF-16 units.
def position_of(text, offset):
    before = text[:offset].replace("\r\n", "\n").replace("\r", "\n")
    line = before.rsplit("\n", 1)[-1]
    return {"line": before.count("\n"), "character": len(line.encode("utf-16-le")) // 2}


def path_of(name):
    return os.path.relpath(urllib.parse.unquote(name[len("file://"):]), os.getcwd())


class Session:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.client = Client(["--max-errors=1000"])
        self.client.initialize(["."], CAPABILITIES)
        self.files = sources_in(".")
        self.original = {file: read_text(file) for file in self.files}
        self.texts = dict(self.original)  # as the project has them: of buffers, else on disk
        self.log = []
        self.pauses = 0
        self.open(self.files[0])

    def open(self, file):
        self.client.open(file, self.texts[file])
        self.log.append("open " + file)

    def replace(self, file, begin, end, new):
        text = self.texts[file]
        change = {"range": {"start": position_of(text, begin), "end": position_of(text, end)}, "text": new}
        self.texts[file] = text[:begin] + new + text[end:]
        self.client.change(file, [change])
        self.log.append("replace %s %d-%d %r" % (file, begin, end, new))

    # A place that is not between CR and LF: no editor has one there.
    def place(self, text):
        at = self.random.randint(0, len(text))
        return at - 1 if text[at - 1:at + 1] == "\r\n" else at

    def edit(self):
        kind = self.random.randrange(10)
        file = self.random.choice(sorted(self.client.versions))
        text = self.texts[file]
        at = self.place(text)
        if kind < 4:  # typed, character by character
            new = self.random.choice(TYPED)
            if kind == 0:
                other = self.texts[self.random.choice(self.files)]
                begin = self.place(other)
                new = other[begin:begin + self.random.randint(1, 40)].replace("\r", "")
            for character in new:
                self.replace(file, at, at, character)
                at += len(character)
        elif kind < 6:
            end = min(len(text), at + self.random.choice([1, 1, 3, 20]))
            self.replace(file, at, end + 1 if text[end - 1:end + 1] == "\r\n" else end, "")
        elif kind < 8:
            self.texts[file] = self.original[file]
            self.client.change(file, [{"text": self.original[file]}])
            self.log.append("undo " + file)
        elif kind == 8:
            closed = [name for name in self.files if name not in self.client.versions]
            if closed:
                self.open(self.random.choice(closed))
        else:
            self.change_on_disk()

    # A whole file, as a person writes it from nothing who never makes a mistake.
    def write(self, file, copy):
        whole = self.original[file]
        if file not in self.client.versions:
            self.open(file)
        self.replace(file, 0, len(self.texts[file]), "")
        pause = self.random.randint(1, 40)
        for at, character in enumerate(whole):
            self.replace(file, at, at, character)
            pause -= 1
            if (pause > 0 and at + 1 < len(whole)) or whole[at:at + 2] == "\r\n":
                continue
            pause = self.random.randint(1, max(40, len(whole) // 30))
            self.compare(copy, "%s after character %d" % (file, at + 1))
            self.ask(file, at + 1)

    # A file that is open loses its buffer first, so that the disk counts.
    def change_on_disk(self):
        file = self.random.choice(self.files)
        if file in self.client.versions:
            if len(self.client.versions) == 1:
                return
            self.client.close(file)
        text = self.original[file]
        at = self.place(text)
        self.texts[file] = text[:at] + self.random.choice(TYPED) + text[at:]
        with open(file, "w", encoding="utf-8", newline="") as stream:
            stream.write(self.texts[file])
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(file), "type": 2}]})
        self.log.append("on disk " + file)

    # ---- comparing

    def of_server(self):
        self.client.settle()
        found = []
        for name, (_, diagnostics) in self.client.published.items():
            path = path_of(name)
            for one in diagnostics:
                start = one["range"]["start"]
                message = one["message"].split("\n")[0].replace(os.getcwd() + "/", "")
                found.append((path, start["line"], start["character"], one["code"], message))
        return sorted(set(found))

    def of_check(self, folder):
        for file, text in self.texts.items():
            with open(os.path.join(folder, file), "w", encoding="utf-8", newline="") as stream:
                stream.write(text)
        # Without arguments the command finds the project as the server does.
        is_project = any(name in ("rung.project", "beremiz.xml", "plc.xml") for name in os.listdir(folder))
        result = subprocess.run(["rung", "check", *([] if is_project else ["."]), "--format=json", "--max-errors=1000"],
                                cwd=folder, capture_output=True, text=True, check=False)
        found = []
        for one in json.loads(result.stderr)["diagnostics"]:
            path, line, column = one["path"], one.get("line", 1) - 1, one.get("column", 1) - 1
            if path in self.texts:
                rows = self.texts[path].replace("\r\n", "\n").replace("\r", "\n").split("\n")
                column = len(rows[line][:column].encode("utf-16-le")) // 2
            if path != ".":  # an opened folder without sources is not a mistake
                found.append((path, line, column, one["code"], one["message"].split("\n")[0]))
        return sorted(set(found))

    # ---- asking

    def ask(self, file, offset):
        document = {"uri": uri(file)}
        at = position_of(self.texts[file], offset)
        for method in POSITIONED:
            self.request(method, {"textDocument": document, "position": at})
        for method in WHOLE:
            self.request(method, {"textDocument": document, "options": {}})
        self.request("selectionRange", {"textDocument": document, "positions": [at]})

    def request(self, method, params):
        answer = self.client.request("textDocument/" + method, params)
        if "error" in answer:
            self.stop("%s %s: %s" % (method, params, answer["error"]))
        self.check_ranges(method, params["textDocument"]["uri"], answer["result"])

    # Each range of the file of the request, or of the one that the object names, is within its text.
    def check_ranges(self, method, name, value):
        if isinstance(value, list):
            for item in value:
                self.check_ranges(method, name, item)
        elif isinstance(value, dict) and value.keys() == {"start", "end"}:
            lines = self.lines_of(name)
            for end in (value["start"], value["end"]):
                inside = end["line"] < len(lines) and end["character"] <= len(lines[end["line"]].encode("utf-16-le")) // 2
                if lines and not inside:
                    self.stop("%s of %s gives %s" % (method, name, value))
        elif isinstance(value, dict):
            for item in value.values():
                self.check_ranges(method, value.get("uri", name), item)

    def lines_of(self, name):
        text = self.texts.get(path_of(name))
        return text.replace("\r\n", "\n").replace("\r", "\n").split("\n") if text is not None else []

    def stop(self, why):
        print("\n".join(self.log[-10:]))
        sys.exit(why)

    def compare(self, copy, when):
        self.pauses += 1
        server, check = self.of_server(), self.of_check(copy)
        if server != check:
            self.stop("%s only the server says %s, only the check says %s"
                      % (when, sorted(set(server) - set(check)), sorted(set(check) - set(server))))

    def run(self, pauses, copy):
        for pause in range(pauses):
            for _ in range(self.random.randint(1, 3)):
                self.edit()
            self.compare(copy, "after pause %d" % pause)
            for file in sorted(self.client.versions):
                self.ask(file, self.place(self.texts[file]))
        self.finish()

    def type(self, count, most, copy):
        files = [file for file in self.files if 0 < len(self.original[file]) <= most]
        for file in self.random.sample(files, min(count, len(files))):
            self.write(file, copy)
        self.finish()

    def finish(self):
        if self.client.finish() != 0:
            sys.exit("the server ends with an error")
        print("%d pauses, no difference" % self.pauses)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pauses", type=int, default=30)
    parser.add_argument("--type", type=int, default=0)
    parser.add_argument("--most", type=int, default=8000)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        for name in ("work", "copy"):
            shutil.copytree(options.folder, os.path.join(scratch, name))
        os.chdir(os.path.join(scratch, "work"))
        session, copy = Session(options.seed), os.path.join(scratch, "copy")
        if options.type:
            session.type(options.type, options.most, copy)
        else:
            session.run(options.pauses, copy)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# A client of `rung lsp` for tests: sends what the lines of a script say, and prints the answers in a short form.
# In: a script on stdin, in a folder with sources. Out: the answers, with lines and columns from 1.
#
#   folder NAME ...            the folders that the editor opens (default: the current one); before all else
#   capabilities JSON          of the client, merged into the usual ones; before all else
#   open FILE                  with its text on disk; `open FILE as FILE2`: with the text of FILE2
#   replace FILE L:C-L:C TEXT  TEXT is a JSON string; `L:C` alone inserts
#   undo FILE                  sends the text on disk
#   close FILE, save FILE, changed FILE ...
#   diagnostics                those of all files that are other ones than when they were last printed
#   sh COMMAND                 changes files, for `changed`
#   uninitialized              as the first line: without `initialize`
#   messages                   the other notifications and requests of the server so far
#   hover FILE L:C [JSON]      a request textDocument/hover, and so all others; `L:C-L:C` is its `range`
#   complete FILE L:C [LABEL ...]   the labels of the completion; or what is offered under some
#   lenses FILE                its code lenses, resolved: a line for each
#   tokens FILE                the numbers of its semantic tokens: all, then the edits of those of before
#   actions FILE L:C[-L:C] [KIND]      the titles of its code actions; of one kind
#   act FILE L:C[-L:C] TITLE   applies the code action, and prints the lines that it changes
#   calls FILE L:C, types FILE L:C    the call or type hierarchy of the name: one line for each in both directions
#   diagram FILE [L:C]         rung/diagram: the title, the elements with their ranges, `*` at that of the cursor
#   request METHOD [JSON], notify METHOD [JSON]
#   send TEXT                  a message as it is; its answer, if it has an id or the server sends one
#   bytes JSON                 the bytes of a string, without a header
import difflib
import json
import os
import re
import subprocess
import sys

SECONDS = int(os.environ.get("RUNG_CLIENT_SECONDS", "120"))
CAPABILITIES = {
    "general": {"positionEncodings": ["utf-16"]},
    "textDocument": {
        "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
        "completion": {"completionItem": {"snippetSupport": True}},
    },
}


def merged(left, right):
    if not isinstance(left, dict) or not isinstance(right, dict):
        return right
    return {**left, **{key: merged(left.get(key), value) for key, value in right.items()}}


class Client:
    def __init__(self, arguments=(), program="rung"):
        self.process = subprocess.Popen(
            ["timeout", str(SECONDS), program, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        self.next_id = 1
        self.texts = {}  # of open files
        self.versions = {}
        self.published = {}  # by URI: version, diagnostics
        self.messages = []  # other notifications and requests of the server

    # ---- messages

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send_text(self, text):
        data = text.encode("utf-8", "surrogatepass")
        self.send_bytes(b"Content-Length: %d\r\n\r\n" % len(data) + data)

    def read(self):
        length = None
        while True:
            line = self.process.stdout.readline()
            if not line:
                sys.exit("the server has ended with exit code %d" % self.process.wait())
            if line == b"\r\n":
                break
            if line.startswith(b"Content-Length:"):
                length = int(line[15:])
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            params = message["params"]
            self.published[params["uri"]] = (params.get("version"), params["diagnostics"])
        elif "method" in message:
            self.messages.append(message)
            if "id" in message:
                self.send_text(json.dumps({"jsonrpc": "2.0", "id": message["id"], "result": None}))
        return message

    def answer(self, identifier):
        while True:
            message = self.read()
            if "method" not in message and message.get("id") == identifier:
                return message

    def start(self, method, params=None):
        identifier = self.next_id
        self.next_id += 1
        self.send_text(json.dumps({"jsonrpc": "2.0", "id": identifier, "method": method, "params": params}))
        return identifier

    def request(self, method, params=None):
        return self.answer(self.start(method, params))

    def notify(self, method, params=None):
        self.send_text(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    # ---- a session

    def initialize(self, folders, capabilities):
        named = [{"uri": uri(folder), "name": folder} for folder in folders]
        params = {"processId": os.getpid(), "rootUri": None, "capabilities": capabilities, "workspaceFolders": named}
        result = self.request("initialize", params)
        self.notify("initialized", {})
        return result

    def finish(self):
        self.request("shutdown")
        self.notify("exit")
        return self.process.wait()

    def open(self, file, text):
        self.texts[file] = text
        self.versions[file] = 1
        document = {"uri": uri(file), "languageId": "st", "version": 1, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": document})

    def change(self, file, changes):
        self.versions[file] += 1
        document = {"uri": uri(file), "version": self.versions[file]}
        self.notify("textDocument/didChange", {"textDocument": document, "contentChanges": changes})

    def close(self, file):
        del self.texts[file], self.versions[file]
        self.notify("textDocument/didClose", {"textDocument": {"uri": uri(file)}})

    # Waits until the server has checked everything that was sent: then it has published a new version of a buffer.
    def settle(self):
        if not self.versions:
            sys.exit("`diagnostics` needs an open file")
        file = next(iter(self.versions))
        self.change(file, [])
        while self.published.get(uri(file), (None, []))[0] != self.versions[file]:
            self.read()
        self.request("rung/unknown")  # the other files of this check come before the answer


def uri(file):
    path = os.path.abspath(file)
    return "file://" + "".join(c if c.isalnum() or c in "/-._~" else "".join("%%%02X" % b for b in c.encode()) for c in path)


def shown_uri(text):
    return text.replace("file://" + os.getcwd() + "/", "").replace("%20", " ")


# ---- printing

def shown_position(position):
    return "%d:%d" % (position["line"] + 1, position["character"] + 1)


def shown_range(value):
    return shown_position(value["start"]) + "-" + shown_position(value["end"])


# Ranges and locations as text, all else as it is.
def shortened(value):
    if isinstance(value, list):
        return [shortened(item) for item in value]
    if isinstance(value, str):
        return re.sub(r"file:///\S*/editor-[0-9.]+/", "rung:", shown_uri(value))
    if not isinstance(value, dict):
        return value
    if value.keys() == {"line", "character"}:
        return shown_position(value)
    if value.keys() == {"start", "end"} and isinstance(value["start"], dict):
        return shown_range(value)
    if value.keys() == {"uri", "range"}:
        return shortened(value["uri"]) + ":" + shown_range(value["range"])
    return {key: shortened(item) for key, item in value.items()}


# A line's length does not depend on the folder that the test runs in.
def is_long(line):
    return len(line.replace(os.getcwd(), "$PWD")) > 110


def lines_of(value, indent="", before=""):
    flat = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    if isinstance(value, str) and "\n" in value:
        return [indent + before] + [indent + "  | " + line for line in value.split("\n")]
    if not isinstance(value, (dict, list)) or not value or not is_long(indent + before + flat):
        return [indent + before + flat]
    out = [indent + before.rstrip()] if before else []
    inner = indent + "  " if before else indent
    if isinstance(value, list):
        for item in value:
            lines = lines_of(item, inner + "  ")
            out += [inner + "- " + lines[0].lstrip()] + lines[1:]
    else:
        for key, item in value.items():
            out += lines_of(item, inner, key + ": ")
    return out


def show(value):
    print("\n".join(lines_of(shortened(value))))


def show_answer(message):
    if "error" in message:
        print("error %d: %s" % (message["error"]["code"], message["error"]["message"]))
    else:
        show(message["result"])


SEVERITIES = {1: "error", 2: "warning", 3: "info", 4: "note"}
TAGS = {1: "unnecessary", 2: "deprecated"}


def show_diagnostics(file, diagnostics):
    if not diagnostics:
        print(file + ": none")
    for diagnostic in diagnostics:
        at = shown_range(diagnostic["range"])
        print("%s:%s %s[%s]: %s" % (file, at, SEVERITIES[diagnostic["severity"]], diagnostic["code"],
                                    diagnostic["message"].replace("\n", " | ")))
        if diagnostic.get("tags"):
            print("  " + ", ".join(TAGS[tag] for tag in diagnostic["tags"]))
        for related in diagnostic.get("relatedInformation", []):
            print("  %s: %s" % (shortened(related["location"]), related["message"]))


# ---- the script

def position_of(text):
    line, column = text.split(":")
    return {"line": int(line) - 1, "character": int(column) - 1}


def range_of(text):
    begin, _, end = text.partition("-")
    return {"start": position_of(begin), "end": position_of(end or begin)}


def read_text(file):
    with open(file, encoding="utf-8", newline="") as stream:
        return stream.read()


class Script:
    def __init__(self, lines, arguments):
        self.lines = [line.rstrip("\n") for line in lines if line.strip()]
        self.client = Client(arguments)
        self.shown = {}
        self.tokens = {}  # by file: the id of the last answer, and all numbers

    def run(self):
        folders, capabilities = ["."], CAPABILITIES
        while self.lines and self.lines[0].split()[0] in ("folder", "capabilities"):
            word, _, rest = self.lines.pop(0).partition(" ")
            if word == "folder":
                folders = rest.split()
            else:
                capabilities = merged(capabilities, json.loads(rest))
        if not self.lines or self.lines[0] != "uninitialized":
            answer = self.client.initialize(folders, capabilities)
            self.legend = answer["result"]["capabilities"]["semanticTokensProvider"]["legend"]
        else:
            self.lines.pop(0)
        for line in self.lines:
            word, _, rest = line.partition(" ")
            method = getattr(self, "do_" + word, None)
            method(rest) if method else self.ask(word, rest)
        code = self.client.finish()
        if code != 0:
            print("[exit code %d]" % code)

    def do_open(self, rest):
        file, _, other = rest.partition(" as ")
        self.client.open(file, read_text(other or file))

    def do_replace(self, rest):
        file, at, text = rest.split(" ", 2)
        self.client.change(file, [{"range": range_of(at), "text": json.loads(text)}])

    def do_undo(self, rest):
        self.client.texts[rest] = read_text(rest)
        self.client.change(rest, [{"text": self.client.texts[rest]}])

    def do_close(self, rest):
        self.client.close(rest)

    def do_save(self, rest):
        self.client.notify("textDocument/didSave", {"textDocument": {"uri": uri(rest)}})

    def do_changed(self, rest):
        self.client.notify("workspace/didChangeWatchedFiles",
                           {"changes": [{"uri": uri(file), "type": 2} for file in rest.split()]})

    def do_sh(self, rest):
        subprocess.run(rest, shell=True, check=True)

    def do_diagnostics(self, _):
        self.client.settle()
        for name in sorted(self.client.published, key=shown_uri):
            diagnostics = self.client.published[name][1]
            if self.shown.get(name, []) != diagnostics:
                self.shown[name] = diagnostics
                show_diagnostics(shown_uri(name), diagnostics)

    def do_messages(self, _):
        self.client.request("rung/unknown")
        for message in self.client.messages:
            show({key: value for key, value in message.items() if key not in ("jsonrpc", "id")})
        self.client.messages.clear()

    def do_request(self, rest):
        method, _, params = rest.partition(" ")
        show_answer(self.client.request(method, json.loads(params) if params else None))

    def do_notify(self, rest):
        method, _, params = rest.partition(" ")
        self.client.notify(method, json.loads(params) if params else None)

    def do_send(self, rest):
        self.client.send_text(rest)
        self.show_errors()

    def do_bytes(self, rest):
        self.client.send_bytes(json.loads(rest).encode("latin-1"))
        self.show_errors()

    # The labels in the order in which an editor shows them, best rank first; those that are asked for with all they have.
    def do_complete(self, rest):
        file, at, *labels = rest.split(" ")
        params = {"textDocument": {"uri": uri(file)}, "position": position_of(at)}
        answer = self.client.request("textDocument/completion", params)
        items = (answer.get("result") or {"items": []})["items"]
        items.sort(key=lambda item: item["sortText"])
        if not labels:
            ranks = {}
            for item in items:
                ranks.setdefault(item["sortText"][0], []).append(item["label"].strip())
            for rank, names in ranks.items():
                print("%s  %s" % (rank, "  ".join(names)))
            if not items:
                print("nothing")
        for label in labels:
            item = next((item for item in items if item["label"].split(" ")[0] == label), None)
            if item is None:
                print(label + ": not offered")
                continue
            edit = item["textEdit"]
            print("%s  %s  %s %s" % (item["label"].strip(), item.get("detail", ""), shown_range(edit["range"]),
                                     json.dumps(edit["newText"], ensure_ascii=False)))
            resolved = self.client.request("completionItem/resolve", item)["result"]
            for line in resolved.get("documentation", {}).get("value", "").split("\n"):
                if line:
                    print("    " + line)

    def do_lenses(self, rest):
        for lens in self.client.request("textDocument/codeLens", {"textDocument": {"uri": uri(rest)}})["result"]:
            if "command" not in lens:
                lens = self.client.request("codeLens/resolve", lens)["result"]
            command = lens["command"]
            arguments = shortened(command.get("arguments", []))
            print(shown_range(lens["range"]), command["title"], command["command"], *arguments)

    def do_tokens(self, rest):
        params = {"textDocument": {"uri": uri(rest)}, "previousResultId": self.tokens.get(rest, ("0", []))[0]}
        answer = self.client.request("textDocument/semanticTokens/full/delta", params)["result"]
        if "data" in answer:
            print("all %d tokens" % (len(answer["data"]) // 5))
            self.tokens[rest] = (answer["resultId"], answer["data"])
            return
        data = list(self.tokens[rest][1])
        for edit in answer["edits"]:
            data[edit["start"]:edit["start"] + edit["deleteCount"]] = edit.get("data", [])
            print("at %(start)d: %(deleteCount)d numbers become" % edit, edit["data"])
        self.tokens[rest] = (answer["resultId"], data)
        whole = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri(rest)}})["result"]
        self.tokens[rest] = (whole["resultId"], data)
        print("as all of them" if whole["data"] == data else "not those that there are")

    def actions_at(self, file, at, context):
        params = {"textDocument": {"uri": uri(file)}, "range": range_of(at), "context": {"diagnostics": [], **context}}
        return self.client.request("textDocument/codeAction", params)["result"] or []

    def do_actions(self, rest):
        file, at, *kinds = rest.split(" ")
        found = self.actions_at(file, at, {"only": kinds} if kinds else {})
        for action in found:
            codes = [diagnostic["code"] for diagnostic in action.get("diagnostics", [])]
            print("%s: %s%s" % (action["kind"], action["title"], "".join(" [%s]" % code for code in codes)),
                  "(preferred)" if action.get("isPreferred") else "")
        if not found:
            print("nothing")

    def do_act(self, rest):
        file, at, title = rest.split(" ", 2)
        only = {"only": ["source.fixAll"]} if title == "Apply all sure fixes" else {}
        action = next((action for action in self.actions_at(file, at, only) if action["title"] == title), None)
        if action is None:
            return print("not offered: " + title)
        for change in action["edit"].get("documentChanges", []):
            print("version %s of %s" % (change["textDocument"]["version"], shown_uri(change["textDocument"]["uri"])))
        edits = action["edit"].get("changes") or {
            change["textDocument"]["uri"]: change["edits"] for change in action["edit"]["documentChanges"]}
        for name, changes in edits.items():
            self.apply(shown_uri(name), changes)

    def apply(self, file, edits):
        before = self.client.texts[file] if file in self.client.texts else read_text(file)
        text = before
        offset = lambda position: sum(len(line) for line in before.splitlines(True)[:position["line"]]) + position["character"]
        for edit in sorted(edits, key=lambda edit: offset(edit["range"]["start"]), reverse=True):
            text = text[:offset(edit["range"]["start"])] + edit["newText"] + text[offset(edit["range"]["end"]):]
        changes = difflib.unified_diff(before.splitlines(), text.splitlines(), file, file, n=0, lineterm="")
        print("\n".join(line for line in changes if not line.startswith(("---", "+++", "@@"))))
        if file in self.client.texts:
            self.client.change(file, [{"text": text}])
            self.client.texts[file] = text
        else:
            with open(file, "w", encoding="utf-8", newline="") as stream:
                stream.write(text)

    def do_diagram(self, rest):
        file, _, at = rest.partition(" ")
        params = {"textDocument": {"uri": uri(file)}}
        if at:
            params["position"] = position_of(at)
        answer = self.client.request("rung/diagram", params)
        picture = answer.get("result")
        if not picture:
            return show_answer(answer)
        size = re.match(r'<svg [^>]*viewBox="0 0 (\d+ \d+)"', picture["svg"])
        print("%s, %s, %s" % (picture["pou"], picture["title"], "a picture" if size else "no picture"))
        for element in picture["elements"]:
            where = "" if ' id="%s"' % element["id"] in picture["svg"] else ", not in the picture"
            mark = " *" if element["id"] == picture.get("cursor") else ""
            print("  %s %s%s%s" % (element["id"], shown_range(element["range"]), where, mark))

    def do_calls(self, rest):
        self.show_hierarchy(rest, "Call", {"incomingCalls": "from", "outgoingCalls": "to"})

    def do_types(self, rest):
        self.show_hierarchy(rest, "Type", {"supertypes": None, "subtypes": None})

    def show_hierarchy(self, rest, kind, directions):
        file, at = rest.split(" ")
        params = {"textDocument": {"uri": uri(file)}, "position": position_of(at)}
        items = self.client.request("textDocument/prepare%sHierarchy" % kind, params)["result"]
        if not items:
            return print("nothing")
        for direction, side in directions.items():
            answer = self.client.request("%sHierarchy/%s" % (kind.lower(), direction), {"item": items[0]})["result"]
            for found in answer:
                item = found[side] if side else found
                places = " ".join(shown_range(at) for at in found.get("fromRanges", []))
                name = ".".join([item["detail"], item["name"]] if "detail" in item else [item["name"]])
                print(direction, name, shortened({"uri": item["uri"], "range": item["selectionRange"]}), places)

    # Answers that have no id of ours, until that of a request which the server does not know.
    def show_errors(self):
        identifier = self.client.start("rung/unknown")
        while True:
            message = self.client.read()
            if "method" not in message and message.get("id") == identifier:
                return
            if "method" not in message:
                show_answer(message)

    def ask(self, word, rest):
        file, _, rest = rest.partition(" ")
        params = {"textDocument": {"uri": uri(file)}}
        match = re.match(r"(\d+:\d+)(-\d+:\d+)?( |$)", rest)
        if match:
            rest = rest[match.end():]
            params["range" if match[2] else "position"] = (
                range_of(match[1] + match[2]) if match[2] else position_of(match[1])
            )
        if rest:
            params.update(json.loads(rest))
        answer = self.client.request("textDocument/" + word, params)
        if word.startswith("semanticTokens/") and answer.get("result"):
            return self.show_tokens(self.client.texts[file].split("\n"), answer["result"]["data"])
        show_answer(answer)

    # A line of the file for each line with tokens: `text:type.modifier`.
    def show_tokens(self, lines, data):
        line = column = 0
        shown = {}
        for i in range(0, len(data), 5):
            column = data[i + 1] if data[i] else column + data[i + 1]
            line += data[i]
            units = lines[line].encode("utf-16-le")[2 * column:2 * (column + data[i + 2])]
            modifiers = [name for bit, name in enumerate(self.legend["tokenModifiers"]) if data[i + 4] >> bit & 1]
            kind = ".".join([self.legend["tokenTypes"][data[i + 3]]] + modifiers)
            shown.setdefault(line + 1, []).append(units.decode("utf-16-le") + ":" + kind)
        for number, tokens in shown.items():
            print("%d  %s" % (number, "  ".join(tokens)))


if __name__ == "__main__":
    Script(sys.stdin.readlines(), sys.argv[1:]).run()

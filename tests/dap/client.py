#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# A client of `rung dap` for tests: sends what the lines of a script say, and prints the answers in a short form.
# In: a script on stdin, in a folder with sources. Out: the answers.
#
#   launch JSON                initialize and launch; waits for `initialized`
#   break FILE LINE[:COLUMN][ JSON] ...   breakpoints of a file; with JSON their other members
#   functions NAME ...         function breakpoints
#   watch PATH ...             data breakpoints
#   exceptions FILTER ...
#   go                         configurationDone, and waits for a stop
#   continue, next, in, out, back, reverse, cycle, activation [N], goto N, lastwrite PATH     and wait for a stop
#   stack                      the frames
#   scope NAME [FRAME]         the variables of a scope
#   show EXPRESSION            evaluates, with what is inside
#   set EXPRESSION VALUE
#   request COMMAND [JSON]     any request, and the body of its response
#   send TEXT                  a message as it is; bytes JSON: bytes without a header
#   sh COMMAND                 of the shell
#   messages                   the events that came since
import json
import os
import subprocess
import sys

SECONDS = 120


class Client:
    def __init__(self, arguments=(), program="rung"):
        self.process = subprocess.Popen(
            ["timeout", str(SECONDS), program, "dap", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        self.sequence = 0
        self.events = []

    def write(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, text):
        data = text.encode()
        self.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)

    def read(self):
        length = 0
        while True:
            line = self.process.stdout.readline()
            if not line:
                return None
            line = line.strip()
            if not line:
                break
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        return json.loads(self.process.stdout.read(length))

    def request(self, command, arguments=None):
        self.sequence += 1
        sequence = self.sequence
        message = {"seq": sequence, "type": "request", "command": command}
        if arguments is not None:
            message["arguments"] = arguments
        self.send(json.dumps(message))
        while True:
            answer = self.read()
            if answer is None:
                return {"success": False, "message": "the adapter has ended", "ended": True}
            if answer["type"] == "response" and answer["request_seq"] == sequence:
                return answer
            self.events.append(answer)

    # The next event of one of these kinds; the others are kept.
    def wait(self, *names):
        for i, event in enumerate(self.events):
            if event.get("event") in names:
                return self.events.pop(i)
        while True:
            event = self.read()
            if event is None:
                return {"event": "end", "body": {}}
            if event.get("event") in names:
                return event
            self.events.append(event)

    def end(self):
        self.request("disconnect")
        self.process.stdin.close()
        return self.process.wait()


class Script:
    def __init__(self, client):
        self.client = client
        self.thread = 1

    def body(self, answer):
        if answer.get("success"):
            return answer.get("body", {})
        print("error:", answer.get("message"))
        return None

    def outputs(self):
        kept = []
        for event in self.client.events:
            if event.get("event") == "output":
                text = event["body"]["output"].replace(os.getcwd(), "$PWD")
                print("|", text.rstrip("\n").replace("\n", "\n| "))
            else:
                kept.append(event)
        self.client.events = kept

    def stopped(self):
        event = self.client.wait("stopped", "terminated", "end")
        self.outputs()
        body = event["body"]
        if event["event"] != "stopped":
            code = [e["body"]["exitCode"] for e in self.client.events if e.get("event") == "exited"]
            self.client.events = [e for e in self.client.events if e.get("event") != "exited"]
            print(event["event"], *code)
            return
        self.thread = body["threadId"]
        frames = self.client.request("stackTrace", {"threadId": self.thread, "levels": 1})["body"]["stackFrames"]
        place = self.place(frames[0]) if frames else "between activations"
        print(body["reason"] + ":", place, *([f"({body['text']})"] if body.get("text") else []))

    def place(self, frame):
        source = frame.get("source", {}).get("name", "library")
        return f"{frame['name']} {source}:{frame['line']}:{frame['column']}"

    def run(self, command, arguments=None):
        if self.body(self.client.request(command, arguments or {"threadId": self.thread})) is not None:
            self.stopped()

    def frame_id(self, number=0):
        return number + 1

    def variables(self, reference, indent="  ", **page):
        body = self.body(self.client.request("variables", {"variablesReference": reference, **page}))
        for variable in body["variables"] if body else []:
            print(f"{indent}{variable['name']}: {variable['type']} = {variable['value']}")

    def obey(self, line):
        word, _, rest = line.partition(" ")
        client = self.client
        if word == "launch":
            client.request("initialize", {"adapterID": "rung"})
            if self.body(client.request("launch", json.loads(rest) if rest else {})) is not None:
                client.wait("initialized")
            self.outputs()
        elif word == "break":
            file, _, places = rest.partition(" ")
            wishes = []
            while places:
                place, _, places = places.partition(" ")
                if place.startswith("{"):
                    value, end = json.JSONDecoder().raw_decode(place + " " + places)
                    wishes[-1].update(value)
                    places = (place + " " + places)[end:].strip()
                    continue
                number, _, column = place.partition(":")
                wishes.append({"line": int(number), **({"column": int(column)} if column else {})})
            self.breakpoints(client.request(
                "setBreakpoints", {"source": {"path": os.path.abspath(file)}, "breakpoints": wishes}))
        elif word == "functions":
            self.breakpoints(client.request(
                "setFunctionBreakpoints", {"breakpoints": [{"name": name} for name in rest.split()]}))
        elif word == "watch":
            self.breakpoints(client.request(
                "setDataBreakpoints", {"breakpoints": [{"dataId": name, "accessType": "write"} for name in rest.split()]}))
        elif word == "exceptions":
            self.body(client.request("setExceptionBreakpoints", {"filters": rest.split()}))
        elif word == "go":
            self.run("configurationDone", {})
        elif word in RUNS:
            self.run(RUNS[word])
        elif word == "activation":
            self.run("rung/stepActivation", {"threadId": int(rest or self.thread)})
        elif word == "goto":
            self.run("rung/gotoCycle", {"cycle": int(rest)})
        elif word == "lastwrite":
            self.run("rung/lastWrite", {"dataId": rest})
        elif word == "stack":
            for frame in client.request("stackTrace", {"threadId": self.thread})["body"]["stackFrames"]:
                print(" ", self.place(frame))
        elif word == "scope":
            name, _, frame = rest.partition(" ")
            scopes = client.request("scopes", {"frameId": int(frame or 0) + 1})["body"]["scopes"]
            for scope in scopes:
                if scope["name"] == name:
                    self.variables(scope["variablesReference"])
        elif word == "show":
            body = self.body(client.request("evaluate", {"expression": rest, "frameId": 1, "context": "watch"}))
            if body is not None:
                print(f"{rest} = {body['result']} ({body['type']})")
                if body["variablesReference"]:
                    self.variables(body["variablesReference"])
        elif word == "set":
            expression, _, value = rest.partition(" ")
            body = self.body(client.request("setExpression", {"expression": expression, "value": value, "frameId": 1}))
            if body is not None:
                print(f"{expression} = {body['value']}")
        elif word == "request":
            command, _, arguments = rest.partition(" ")
            body = self.body(client.request(command, json.loads(arguments) if arguments else {}))
            if body is not None:
                print(json.dumps(body).replace(os.getcwd(), "$PWD"))
        elif word == "sh":
            subprocess.run(rest, shell=True, check=True)
        elif word == "send":
            client.send(rest)
        elif word == "bytes":
            client.write(json.loads(rest).encode("latin-1"))
        elif word == "messages":
            self.outputs()
            for event in client.events:
                print(event["event"], json.dumps(event["body"]).replace(os.getcwd(), "$PWD"))
            client.events = []
        else:
            sys.exit(f"client.py: unknown line: {line}")

    def breakpoints(self, answer):
        body = self.body(answer)
        for one in body["breakpoints"] if body else []:
            where = f"{one['source']['name']}:{one['line']}:{one['column']}" if "source" in one else "-"
            print("  breakpoint", where if one["verified"] else "not bound:", one.get("message", ""))


RUNS = {
    "continue": "continue",
    "next": "next",
    "in": "stepIn",
    "out": "stepOut",
    "back": "stepBack",
    "reverse": "reverseContinue",
    "cycle": "rung/stepCycle",
}


def main():
    client = Client(sys.argv[1:])
    script = Script(client)
    for line in sys.stdin:
        line = line.strip()
        if line and not line.startswith("#"):
            print("--", line)
            sys.stdout.flush()
            script.obey(line)
    print("exit", client.end())


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Documents that are huge, deep, never closed or not a program at all, opened in `rung lsp` one after the other: every
# request is answered without an error, each in a time that a busy machine keeps too.
#
#   hostile.py           in an empty folder
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import CAPABILITIES, Client, uri  # noqa: E402
from edits import POSITIONED, WHOLE, position_of  # noqa: E402

SECONDS = 30
HEAD = "PROGRAM p\nVAR x : INT; b : BOOL; END_VAR\n"

DOCUMENTS = {
    "empty": "",
    "long sum": HEAD + "x := 1" + " + 1" * 250_000 + ";\nEND_PROGRAM",
    "allowed sum": HEAD + "x := 1" + " + x" * 900 + ";\nEND_PROGRAM",
    "parentheses": HEAD + "x := " + "(" * 10_000 + "1" + ")" * 10_000 + ";\nEND_PROGRAM",
    "open calls": HEAD + "x := " + "MIN(" * 3000,
    "statements": HEAD + "IF b THEN\n" * 5000 + "END_IF;\n" * 5000 + "END_PROGRAM",
    "members": HEAD + "x := x" + ".x" * 50_000 + ";\nEND_PROGRAM",
    "branches": HEAD + "IF b THEN\n" + "ELSIF b THEN x := x;\n" * 20_000 + "END_IF;\nEND_PROGRAM",
    "structures": "TYPE t : " + "STRUCT a : " * 3000 + "INT; " + "END_STRUCT; " * 3000 + "END_TYPE",
    "arrays": "TYPE t : " + "ARRAY[0..1] OF " * 5000 + "INT; END_TYPE",
    "comment": "PROGRAM p\n(* never closed\nEND_PROGRAM\n",
    "string": "PROGRAM p VAR s : STRING; END_VAR\ns := 'never closed",
    "word": "PROGRAM " + "a" * 1_000_000 + " END_PROGRAM",
    "pragmas": "{" * 50_000,
    "noise": "PROGRAM p \x01\x02 \u00ff\ufffe ; ; ) ( END_PROGRAM",
    "circle": "FUNCTION_BLOCK A EXTENDS B END_FUNCTION_BLOCK\nFUNCTION_BLOCK B EXTENDS A\nMETHOD m : INT\nm := SUPER^.m();\n"
              "END_METHOD\nEND_FUNCTION_BLOCK\nPROGRAM p VAR a : A; END_VAR\na.\nEND_PROGRAM",
}


def ask(client, name, method, params):
    begin = time.monotonic()
    answer = client.request("textDocument/" + method, params)
    if "error" in answer:
        sys.exit("%s: %s: %s" % (name, method, answer["error"]))
    if time.monotonic() - begin > SECONDS:
        sys.exit("%s: %s takes longer than %d s" % (name, method, SECONDS))


def main():
    client = Client(["--max-errors=1000"])
    client.initialize(["."], CAPABILITIES)
    for name, text in DOCUMENTS.items():
        client.open("hostile.st", text)
        client.settle()
        document = {"uri": uri("hostile.st")}
        for offset in (10, len(text) // 2, len(text)):
            at = position_of(text, min(offset, len(text)))
            for method in POSITIONED:
                ask(client, name, method, {"textDocument": document, "position": at})
            ask(client, name, "selectionRange", {"textDocument": document, "positions": [at]})
        for method in WHOLE:
            ask(client, name, method, {"textDocument": document, "options": {}})
        client.close("hostile.st")
    if client.finish() != 0:
        sys.exit("the server ends with an error")
    print("%d documents, every request answered" % len(DOCUMENTS))


if __name__ == "__main__":
    main()

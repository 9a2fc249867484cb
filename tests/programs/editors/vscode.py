#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What of tools/vscode can be seen without an editor: its JSON is valid and names files that exist, the grammars name
every word of the compiler's tables, every snippet is a program without errors, commands have code. Prints what is wrong.
In: nothing; `rung` is on the PATH. Run in an empty folder."""

import json
import os
import pathlib
import re
import subprocess

SOURCE = pathlib.Path(os.environ["RUNG_SOURCE"])
EXTENSION = SOURCE / "tools/vscode"


def read(path):
    return json.loads((EXTENSION / path).read_text())


def patterns(value):
    """All regular expressions of a grammar."""
    if isinstance(value, dict):
        for key, child in value.items():
            if key in ("match", "begin", "end"):
                yield child
            else:
                yield from patterns(child)
    elif isinstance(value, list):
        for child in value:
            yield from patterns(child)


def names(grammar, word):
    """Whether some expression has the word as an alternative, and takes it."""
    bare = re.compile(r"(?<![\w\\])" + re.escape(word) + r"(?![\w(])|(?<![\w\\])" + re.escape(word) + r"(?=\()")
    return any(bare.search(pattern) for pattern in patterns(grammar))


def rows(path, macro):
    return re.findall(rf'^{macro}\(\w*,? ?"([^"]+)"', (SOURCE / path).read_text(), re.M)


def check_words():
    text = read("syntaxes/iecst.tmLanguage.json")
    tokens = "frontend/parse/tokens.def"
    words = [word for macro in ("RUNG_WORD", "RUNG_TYPE_WORD", "RUNG_SOFT_WORD") for word in rows(tokens, macro)]
    words += re.findall(r'\{"(\w+)", IlKind::', (SOURCE / "frontend/parse/il.cpp").read_text())
    elements = re.search(r"kElementWords\[\] = \{([^}]*)\}", (SOURCE / "frontend/syntax/diagram.h").read_text()).group(1)
    words += re.findall(r'"(\w+)"', elements)
    if len(words) < 180:
        print(f"only {len(words)} words were found in the tables")
    for word in words:
        if not names(text, word):
            print(f"iecst.tmLanguage.json does not name {word}")
    ladder = read("syntaxes/nct.tmLanguage.json")
    instructions = rows("frontend/import/nct/instructions.def", "NCT_INSTRUCTION")
    for word in instructions:
        if not names(ladder, word) and word not in ("+F", "-F", "*F", "/F"):
            print(f"nct.tmLanguage.json does not name {word}")
    keys = set(re.findall(r"^\| `(\w+)` \|", (SOURCE / "docs/cam.md").read_text().split("## Other forms")[0], re.M))
    for word in sorted(keys):
        if not names(read("syntaxes/cam.tmLanguage.json"), word):
            print(f"cam.tmLanguage.json does not name {word}")
    return len(words) + len(instructions) + len(keys)


def check_files():
    package = read("package.json")
    for kind in ("languages", "grammars", "snippets"):
        for entry in package["contributes"][kind]:
            for key in ("path", "configuration"):
                if key in entry:
                    read(entry[key])
    for path in EXTENSION.glob("syntaxes/*.json"):
        scopes = [grammar["scopeName"] for grammar in package["contributes"]["grammars"]]
        if read(path)["scopeName"] not in scopes:
            print(f"package.json does not name {path.name}")
    media = [package["icon"], "README.md", "CHANGELOG.md"]
    for step in package["contributes"]["walkthroughs"][0]["steps"]:
        media += step["media"].get("image", step["media"].get("markdown", "")).split()
    for path in media:
        if not (EXTENSION / path).is_file():
            print(f"{path} is missing")
    code = "".join(path.read_text() for path in EXTENSION.glob("src/*.ts"))
    for command in package["contributes"]["commands"]:
        if f"'{command['command']}'" not in code:
            print(f"no code has the command {command['command']}")
    if list(package["dependencies"]) != ["vscode-languageclient"]:
        print("the only package at run time is vscode-languageclient")
    if '"resolved"' in (EXTENSION / "package-lock.json").read_text():
        print("package-lock.json names a registry")


def expanded(body):
    """The text that an editor inserts when the user accepts every default."""
    text = "\n".join(body)
    text = re.sub(r"\$\{\d+\|([^,|]*)[^}]*\|\}", r"\1", text)
    while re.search(r"\$\{\d+:[^${}]*\}", text):
        text = re.sub(r"\$\{\d+:([^${}]*)\}", r"\1", text)
    return re.sub(r"\$\d+", "", text)


def wrapped(name, text):
    """A file that holds the snippet: statements in a program, methods in a block."""
    if re.match(r"(METHOD|PROPERTY)\b", text):
        return f"FUNCTION_BLOCK Holder\nVAR done : BOOL; END_VAR\ndone := TRUE;\n{text}\nEND_FUNCTION_BLOCK\n"
    if name == "C++ body":
        return f"PROGRAM Holder\n{text}\nEND_PROGRAM\n"
    if re.match(r"(///|PROGRAM|FUNCTION|INTERFACE|TYPE|VAR_GLOBAL|\{test\})", text):
        return text + "\n"
    return f"PROGRAM Holder\nVAR condition, done : BOOL; count : INT; END_VAR\n{text}\nEND_PROGRAM\n"


def wrapped_ladder(name, text):
    return text + "\n" if name == "Program" else f"PROGRAM holder\nMODULE MAIN\n{text}\nEND_MODULE\n"


def report(name, result):
    if result.returncode != 0:
        print(f"{name}: {result.stdout}{result.stderr}")


def check_snippets():
    count = 0
    kinds = [("iecst", "st", wrapped), ("nct", "nct", wrapped_ladder)]
    for language, extension, wrap in kinds:
        for name, snippet in read(f"snippets/{language}.json").items():
            path = pathlib.Path(f"snippet.{extension}")
            path.write_text(wrap(name, expanded(snippet["body"])))
            report(f"{name}: {path.read_text()}", run("check", str(path)))
            path.unlink()
            count += 1
    snippets = read("snippets/cam.json")
    pathlib.Path("snippet.cam").write_text("\n".join(expanded(one["body"]) for one in snippets.values()) + "\n")
    report("cam", run("check", "snippet.cam"))
    pathlib.Path("snippet.cam").unlink()
    projects = read("snippets/rung-project.json")
    pathlib.Path("rung.project").write_text("\n".join(expanded(one["body"]) for one in projects.values()) + "\n")
    pathlib.Path("main.st").write_text("PROGRAM Main\nEND_PROGRAM\n")
    report("rung.project", run("check"))
    return count + len(snippets) + len(projects)


def run(*arguments):
    return subprocess.run(["rung", *arguments, "-Wno-all"], capture_output=True, text=True)


def main():
    check_files()
    words = check_words()
    snippets = check_snippets()
    print(f"{'more than 260' if words > 260 else words} words, {'at least 30' if snippets >= 30 else snippets} snippets")


main()

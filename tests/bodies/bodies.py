#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the tests notice a missing body of the libraries. Each function, block and method of stdlib/ loses its body in turn:
one in ST becomes empty, one in C++ returns 0 at once. The tests that name it, then all, are run with the interpreter.
  tests/bodies/bodies.py [-j N] [--sample] [FOLDER|FILE|NAME...]   prints each body that nothing notices; exits 0 if none
--sample: the bodies in sample.txt. BUILD names the build folder (build).
The libraries are text inside of the program rung, so a copy of it is edited in place and nothing is built again. A body in
C++ is code for x86-64; elsewhere these bodies are skipped. {operator} functions have no body: the compiler knows them."""
import concurrent.futures
import os
import pathlib
import platform
import queue
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = ROOT / os.environ.get("BUILD", "build") / "bin"
HIDDEN = re.compile(r"//[^\n]*|\(\*.*?\*\)|'(?:\$.|[^'$\n])*'|\"(?:\$.|[^\"$\n])*\"", re.S)
POU = re.compile(r"\b(FUNCTION_BLOCK|FUNCTION|METHOD)\s+(?:(?:PUBLIC|PRIVATE|PROTECTED|INTERNAL|FINAL|ABSTRACT|OVERRIDE)\s+)*"
                 r"(\w+)(.*?)\bEND_\1\b", re.S)
MEMBER = re.compile(r"\{[^{}]*\}\s*\bMETHOD\b|\bMETHOD\b|\bPROPERTY\b|\bACTION\b")
RETURN_0 = bytes.fromhex("31c0660fefc0c3")  # xor eax, eax; pxor xmm0, xmm0; ret
FEW = 40  # so many files that name a body are tried before all others


class Body:
    def __init__(self, file, text, name, place, code, blank=None, symbol=None):
        self.file, self.text, self.name, self.place = file, text, name, place
        self.words = set(re.findall(r"\w+", code.lower()))  # of its declarations and body
        self.blank = blank    # in ST: where it begins and ends in the file
        self.symbol = symbol  # in C++: its function, or those that begin with this and `__`


def hidden(text):
    """The text without comments and strings, at the same places."""
    return HIDDEN.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def pragmas_before(text, at):
    before = re.search(r"(?:\{[^{}]*\}\s*)*$", text[:at])
    return before[0]


def bodies_in(file):
    text = file.read_text()
    code = hidden(text)
    library = file.relative_to(ROOT / "stdlib").parts[-2]
    found = []

    def add(match, offset, owner):
        kind, name, rest = match.groups()
        pragmas = pragmas_before(code, offset + match.start())
        begin = offset + match.start(3)
        end = begin + len(rest)
        member = MEMBER.search(code, begin, end) if kind == "FUNCTION_BLOCK" else None
        own_end = member.start() if member else end
        place = f"{file.relative_to(ROOT)}:{code.count(chr(10), 0, offset + match.start()) + 1}"
        shown = f"{owner}.{name}" if owner else name
        if "{operator" in pragmas or "ABSTRACT" in match[0][: match.start(2) - match.start()]:
            pass
        elif "{native" in pragmas:
            found.append(Body(file, text, shown, place, "", symbol=f"rung_{library}_{shown.replace('.', '_')}"))
        else:
            sections = [section.end() for section in re.finditer(r"\bEND_VAR\b", code[begin:own_end])]
            if sections:
                start = begin + sections[-1]
            else:  # FUNCTION name : type [;]
                start = begin + re.match(r"[^\n;]*", code[begin:own_end]).end()
            if code[start:own_end].strip():
                found.append(Body(file, text, shown, place, code[begin:own_end], blank=(start, own_end)))
        if member:
            for inner in POU.finditer(code[member.start():end]):
                add(inner, member.start(), shown)

    for match in POU.finditer(code):
        add(match, 0, "")
    return found


def symbols():
    """Native function -> where its code is in the program."""
    sections = {}
    for line in subprocess.run(["readelf", "-SW", BIN / "rung"], capture_output=True, text=True).stdout.splitlines():
        match = re.match(r"\s*\[\s*\d+\]\s+(\.text)\s+\S+\s+(\w+)\s+(\w+)\s+(\w+)", line)
        if match:
            sections[match[1]] = [int(match[i], 16) for i in (2, 3, 4)]
    address, offset, size = sections[".text"]
    found = {}
    for line in subprocess.run(["nm", BIN / "rung"], capture_output=True, text=True).stdout.splitlines():
        fields = line.split()
        if len(fields) == 3 and fields[2].startswith("rung_") and address <= int(fields[0], 16) < address + size:
            found[fields[2]] = int(fields[0], 16) - address + offset
    return found


class Program:
    """A copy of rung beside one of the runner, which finds it there."""

    def __init__(self, folder, original):
        (folder / "bin").mkdir(parents=True)
        for name in ("rung", "rung_test_runner"):
            shutil.copy(BIN / name, folder / "bin" / name)
        self.folder, self.original = folder, original

    def edit(self, changes):
        with open(self.folder / "bin/rung", "r+b") as file:
            for at, data in changes:
                file.seek(at)
                file.write(data)

    def failures(self, files):
        runner = [self.folder / "bin/rung_test_runner", "--ways=--engine=interp", "-j", "1"]
        result = subprocess.run(runner + files, cwd=ROOT, capture_output=True, text=True, errors="replace")
        failed = {line for line in result.stdout.splitlines() if line.startswith("FAILED ")}
        return failed or ({"no result"} if result.returncode != 0 else set())

    def notices(self, changes, choices):
        """Whether, among one of the choices of tests, one fails that passes otherwise."""
        for files in choices:
            self.edit(changes)
            failed = self.failures(files)
            self.edit([(at, self.original[at:at + len(data)]) for at, data in changes])
            if failed and failed - self.failures(files):
                return True
        return False


def changes_for(body, original, addresses):
    if body.symbol is not None:
        names = [name for name in addresses if name == body.symbol or name.startswith(body.symbol + "__")]
        return [(addresses[name], RETURN_0) for name in names]
    text = body.text.encode()
    base = original.find(text)
    begin, end = (len(body.text[:place].encode()) for place in body.blank)
    if base < 0 or original.find(text, base + 1) >= 0:
        sys.exit(f"{body.file}: not in the program; build it first")
    return [(base + begin, re.sub(rb"[^\n]", b" ", text[begin:end]))]


def test_files():
    kept = {}
    for folder in ("conformance", "programs"):
        for file in sorted((ROOT / "tests" / folder).rglob("*")):
            if file.suffix in (".st", ".test", ".xml") and file.is_file():
                kept[str(file.relative_to(ROOT))] = set(re.findall(r"\w+", file.read_text(errors="replace").lower()))
    return kept


def users_of(bodies):
    """Name -> the names of bodies of the libraries that use it."""
    users = {body.name.lower(): set() for body in bodies}
    for body in bodies:
        for word in body.words & users.keys():
            users[word].add(body.name.lower())
    return users


def main():
    arguments = sys.argv[1:]
    jobs = os.cpu_count()
    if "-j" in arguments:
        at = arguments.index("-j")
        jobs = int(arguments[at + 1])
        del arguments[at:at + 2]
    everything = [body for file in sorted((ROOT / "stdlib").rglob("*.st")) for body in bodies_in(file)]
    if "--sample" in arguments:
        arguments = (pathlib.Path(__file__).parent / "sample.txt").read_text().split()
    wanted = [argument.rstrip("/") for argument in arguments]

    def is_wanted(body):
        path = str(body.file.relative_to(ROOT))
        return not wanted or any(body.name == word or path == word or path.startswith(word + "/") for word in wanted)

    bodies = [body for body in everything if is_wanted(body)]
    unknown = [word for word in wanted if not any(
        body.name == word or str(body.file.relative_to(ROOT)).startswith(word) for body in everything)]
    if unknown:
        print("no such body:", " ".join(unknown))
        return 1
    original = (BIN / "rung").read_bytes()
    on_x86 = platform.machine() == "x86_64"
    addresses = symbols() if on_x86 else {}
    files, users = test_files(), users_of(everything)

    def choices_for(body):
        names, more = set(), {body.name.split(".")[-1].lower()}
        while more:
            names |= more
            more = set().union(*(users.get(name, set()) for name in more)) - names
        direct = [file for file, words in files.items() if words & {body.name.split(".")[-1].lower()}]
        through = [file for file, words in files.items() if words & names and file not in direct]
        parts = [[file for file in part if file.startswith(folder)][:FEW]
                 for folder in ("tests/conformance", "tests/programs") for part in (direct, through)]
        return [part for part in parts[:2] if part] + [["tests/conformance"]] + [part for part in parts[2:] if part]

    programs = queue.Queue()
    skipped = [body for body in bodies if body.symbol is not None and not on_x86]
    missing = [body for body in bodies if body.symbol is not None and on_x86 and not changes_for(body, original, addresses)]
    for body in missing:
        print(f"{body.place}: {body.symbol} is not in the program")
    tasks = [body for body in bodies if body not in skipped and body not in missing]

    def is_noticed(body):
        program = programs.get()
        try:
            return program.notices(changes_for(body, original, addresses), choices_for(body))
        finally:
            programs.put(program)

    failed = len(missing)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for number in range(jobs):
            programs.put(Program(pathlib.Path(folder) / str(number), original))
        for body, noticed in zip(tasks, pool.map(is_noticed, tasks)):
            if not noticed:
                print(f"{body.place}: nothing notices when the body of {body.name} is missing", flush=True)
                failed += 1
    print(f"{len(tasks)} bodies left out, {failed} of them not noticed" + (f", {len(skipped)} skipped" if skipped else ""))
    return failed != 0


sys.exit(main())

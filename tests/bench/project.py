#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Writes a project of 100 files and 100 000 lines for the benchmarks of checking and editing. Half of its files are
# generated (generate.cpp). The other half is code that people wrote: samples, conformance programs and library blocks
# of this repository, whose declared names get a suffix for each copy. Equal seeds give equal bytes while that code is
# the same.
#   tests/bench/project.py DIR [--files N] [--lines N] [--seed N]      CXX names the C++ compiler (g++)
# Then: rung check --time-phases DIR
import argparse
import os
import random
import re
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WRITTEN = ["samples", "tests/conformance", "stdlib/util", "stdlib/tc2_math", "stdlib/tc2_utilities"]

# Their programs belong to a project, or declare names that a library has for its pins and enumerators too.
LEFT_OUT = ["samples/boiler/tests", "samples/milling_machine", "tests/conformance/machines",
            "tests/conformance/manuals/tm_tp_7_drives", "tests/conformance/manuals/tm_tp_9_hsio"]

# A file with one of these depends on more than the standard dialect and the libraries: on options, on files beside it,
# on the tasks or the process image of its own project, on C++, or on what all files declare.
BOUND = re.compile(r"//\s*(args|with|expect|restart|exit)\b|\bCONFIGURATION\b|\bAT\s*%|%[IQM]|\{external|\{native|\{init"
                   r"|\bVAR_CONFIG\b|\bVAR_ACCESS\b|\bNAMESPACE\b|\bUSING\b|\bEXTENDS\b|\bIMPLEMENTS\b|#if|\{\s*IF\b", re.I)

POU = re.compile(r"^[ \t]*(?:\{[^}\n]*\}[ \t]*)*(?:FUNCTION_BLOCK|FUNCTION|PROGRAM|CLASS|INTERFACE)[ \t]+"
                 r"(?:(?:FINAL|ABSTRACT|PUBLIC|INTERNAL)[ \t]+)*(\w+)", re.I | re.M)
TYPES = re.compile(r"^[ \t]*TYPE\b(.*?)\bEND_TYPE\b", re.I | re.M | re.S)
GLOBALS = re.compile(r"^[ \t]*VAR_GLOBAL\b(.*?)\bEND_VAR\b", re.I | re.M | re.S)
TYPE_NAME = re.compile(r"(?:^|;)\s*(?:\{[^}]*\}\s*)*(\w+)\s*(?:EXTENDS\s+\w+\s*)?:(?!=)")
ENUMERATORS = re.compile(r"\(([^();:]*(?::=[^();:]*)*)\)")
VARIABLES = re.compile(r"(?:^|;)\s*(?:CONSTANT|RETAIN|PERSISTENT|NON_RETAIN)?\s*((?:\w+\s*,\s*)*\w+)\s*:(?!=)", re.I)
SKIPPED = re.compile(r"//[^\n]*|\(\*.*?\*\)|/\*.*?\*/|'(?:\$.|[^'$])*'|\"(?:\$.|[^\"$])*\"", re.S)
WORD = re.compile(r"(//[^\n]*|\(\*.*?\*\)|/\*.*?\*/|'(?:\$.|[^'$])*'|\"(?:\$.|[^\"$])*\")|([A-Za-z_]\w*)", re.S)


def declared_names(source):
    """The names that a source declares for its whole project, in small letters."""
    code = SKIPPED.sub(" ", source)
    names = set(POU.findall(code))
    for section in TYPES.findall(code):
        flat = re.sub(r"\bSTRUCT\b.*?\bEND_STRUCT\b|\bUNION\b.*?\bEND_UNION\b", ";", section, flags=re.I | re.S)
        names.update(TYPE_NAME.findall(flat))
        for enumerators in ENUMERATORS.findall(flat):
            names.update(re.findall(r"(?:^|,)\s*([A-Za-z_]\w*)", enumerators))
    for section in GLOBALS.findall(code):
        for row in VARIABLES.findall(section):
            names.update(re.findall(r"\w+", row))
    return {name.lower() for name in names}


def renamed(source, suffix):
    names = declared_names(source)

    def rename(match):
        word = match.group(2)
        return match.group(0) if word is None or word.lower() not in names else word + suffix

    return WORD.sub(rename, source)


def written_sources():
    """The files of the repository that can be copied into any project."""
    sources = []
    for folder in WRITTEN:
        for path in sorted((ROOT / folder).rglob("*.st")):
            if any(path.is_relative_to(ROOT / left_out) for left_out in LEFT_OUT):
                continue
            source = path.read_text(encoding="utf-8")
            if not BOUND.search(source) and source.count("\n") >= 20:
                sources.append((path.relative_to(ROOT), source))
    return sources


def written_files(count, lines, rng):
    """`count` files of about `lines` lines, each filled with renamed copies until it is full."""
    sources, order, files, copies, done = written_sources(), [], [], 0, 0
    while len(files) < count:
        parts = []
        while done < lines * (len(files) + 1):
            order = order or rng.sample(sources, len(sources))
            path, source = order.pop()
            copies += 1
            parts.append(f"// {path.as_posix()}\n" + renamed(source, f"_c{copies}").rstrip("\n") + "\n\n")
            done += parts[-1].count("\n")
        files.append("".join(parts))
    return files


def generated_files(count, lines):
    """`count` files of about `lines` lines, cut from one generated source between two declarations."""
    with tempfile.TemporaryDirectory() as folder:
        generate = Path(folder) / "generate"
        subprocess.run([os.environ.get("CXX", "g++"), "-std=c++17", "-O1", ROOT / "tests/bench/generate.cpp",
                        "-o", generate], check=True)
        source = subprocess.run([generate, str(count * lines)], check=True, capture_output=True, text=True).stdout
    declarations = re.split(r"(?<=END_FUNCTION\n\n)|(?<=END_FUNCTION_BLOCK\n\n)|(?<=END_PROGRAM\n\n)", source)
    per_file, files, done = source.count("\n") / count, [""], 0
    for declaration in declarations:
        if done >= per_file * len(files) and len(files) < count:
            files.append("")
        files[-1] += declaration
        done += declaration.count("\n")
    return files


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--files", type=int, default=100)
    parser.add_argument("--lines", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()

    per_file, half = options.lines // options.files, options.files // 2
    options.folder.mkdir(parents=True, exist_ok=True)
    files = {"rung.project": "[project]\nname = bench\n"}
    for n, text in enumerate(generated_files(options.files - half, per_file)):
        files[f"station_{n:02}.st"] = text
    for n, text in enumerate(written_files(half, per_file, random.Random(options.seed))):
        files[f"written_{n:02}.st"] = text
    for name, text in files.items():
        (options.folder / name).write_text(text, encoding="utf-8")
    print(f"{len(files) - 1} files, {sum(text.count(chr(10)) for text in files.values())} lines")


if __name__ == "__main__":
    main()

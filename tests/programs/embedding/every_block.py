#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints a program that calls the blocks and functions of the libraries. In: the folder stdlib. Called by no_allocation.test.
Left out is what needs a variable or an address of the caller, and what only some dialects, tests or hosts have."""
import pathlib
import re
import sys

COMMENT = re.compile(r"//[^\n]*|\(\*.*?\*\)|'(?:\$.|[^'$\n])*'", re.S)
POU = re.compile(r"((?:\{[^{}]*\}\s*)*)\b(FUNCTION_BLOCK|FUNCTION)\s+(?:FINAL\s+)?(\w+)(?:\s*:\s*([\w\[\]()]+))?(.*?)\bEND_\2\b", re.S)
SECTION = re.compile(r"\b(VAR_\w+|VAR)\b(.*?)\bEND_VAR\b", re.S)
PIN = re.compile(r"([\w,\s]+?)\s*:\s*([^:;]+?)\s*(?::=[^;]*)?;")
MEMBER = re.compile(r"\b(?:METHOD|PROPERTY|ACTION)\b.*", re.S)
PRAGMA = re.compile(r"\{[^{}]*\}")
GENERIC = {"ANY": "INT", "ANY_ELEMENTARY": "INT", "ANY_MAGNITUDE": "DINT", "ANY_NUM": "REAL", "ANY_INT": "INT", "ANY_REAL": "LREAL",
           "ANY_BIT": "WORD", "ANY_STRING": "STRING", "ANY_SIGNED": "INT", "ANY_UNSIGNED": "UINT", "ANY_CHAR": "CHAR"}
VALUES = {"BOOL": "TRUE", "STRING": "'16#2A'", "WSTRING": '"16#2A"', "USTRING": "U#'16#2A'", "CHAR": "CHAR#'a'", "WCHAR": 'WCHAR#"a"',
          "UCHAR": "UCHAR#'a'", "REAL": "0.5", "LREAL": "0.5", "TIME": "T#15ms", "LTIME": "LTIME#15ms", "DATE": "D#2024-02-29",
          "LDATE": "LDATE#2024-02-29", "TIME_OF_DAY": "TOD#12:00:00", "LTIME_OF_DAY": "LTOD#12:00:00", "TOD": "TOD#12:00:00",
          "DATE_AND_TIME": "DT#2024-02-29-12:00:00", "LDATE_AND_TIME": "LDT#2024-02-29-12:00:00", "DT": "DT#2024-02-29-12:00:00"}
VALUES.update({number: "5" for number in "SINT INT DINT LINT USINT UINT UDINT ULINT BYTE WORD DWORD LWORD".split()})
LEFT_OUT = {"TEST_ADVANCE", "TASK_TIME", "TASK_LTIME", "TIME", "LTIME"}


def type_of(written):
    written = GENERIC.get(written, written)
    return written if re.sub(r"[\[(].*", "", written) in VALUES else None


def value_of(kind):
    return VALUES[re.sub(r"[\[(].*", "", kind)]


def main():
    declared, calls = [], []
    for file in sorted(pathlib.Path(sys.argv[1]).rglob("*.st")):
        library = file.relative_to(sys.argv[1]).parts[-2]
        if library.startswith("__") or library in ("iecsfc",):
            continue
        for pragmas, kind, name, result, rest in POU.findall(COMMENT.sub(lambda match: "''" if match[0][0] == "'" else "", file.read_text())):
            sections = SECTION.findall(PRAGMA.sub("", MEMBER.sub("", rest)))
            pins = [(names, type_of(kind_of_pin)) for section, text in sections if section == "VAR_INPUT"
                    for names, kind_of_pin in PIN.findall(text)]
            if any(section == "VAR_IN_OUT" for section, _ in sections) or name in LEFT_OUT:
                continue
            if re.search(r"\{(bytes|test|operator)", pragmas) or "{std" in pragmas and "codesys" not in pragmas:
                continue
            number = len(calls)
            if kind == "FUNCTION_BLOCK":
                declared.append(f"  i{number} : {library}.{name};")
                given = [f"{pin.strip()} := v_{t.split('[')[0].split('(')[0]}" for names, t in pins if t for pin in names.split(",")]
                calls.append(f"i{number}({', '.join(given)});")
                continue
            types = [t for names, t in pins for _ in names.split(",")]
            if None in types or (result and not type_of(result)):
                continue
            given = ", ".join("v_" + t.split("[")[0].split("(")[0] for t in types)
            if result:
                declared.append(f"  r{number} : {type_of(result)};")
                calls.append(f"r{number} := {library}.{name}({given});")
            elif not any(section == "VAR_OUTPUT" for section, _ in sections):
                calls.append(f"{library}.{name}({given});")
    print("PROGRAM Main\nVAR")
    print("\n".join(f"  v_{kind} : {kind} := {value};" for kind, value in VALUES.items()))
    print("\n".join(declared))
    print("END_VAR")
    print("\n".join(calls))
    print("END_PROGRAM")


main()

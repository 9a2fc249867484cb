#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Programs with and without evidence of a row, for evidence.py. Prints what differs; called by tools/house/checks/evidence.sh."""
import pathlib
import re
import sys
import tempfile

from evidence import Table
from flow import Program

COIL = """// features: 76/9
FUNCTION_BLOCK Coils
VAR_INPUT a : BOOL; END_VAR
VAR_OUTPUT q, r : BOOL; END_VAR
{{network LD}}
rail 1; contact 2 (a) := 1;
coil 3 (q) {} := 2;
coil 4 (r) := 2;
{{end_network}}
END_FUNCTION_BLOCK
{{test}}
PROGRAM coils
VAR c : Coils; END_VAR
c(a := TRUE); ASSERT({});
END_PROGRAM
"""
TIMER = """// covers: tm-tp-library:TON
{{test}}
PROGRAM timers
VAR t : TON; late, other : BOOL; n : INT; done : BOOL; END_VAR
t(IN := TRUE, PT := T#10ms);  // TON
{}
END_PROGRAM
"""
SESSION = """# covers: tm-tp-language:Watchdog
$ cat > main.st <<'END'
> PROGRAM Main
> VAR n, m : INT; END_VAR
> n := n + 1;
> END_PROGRAM
> CONFIGURATION c
> RESOURCE r ON PLC
> TASK slow(INTERVAL := T#20ms, WATCHDOG := T#40ms);
> PROGRAM p WITH slow : Main;
> END_RESOURCE
> END_CONFIGURATION
> END
$ rung run . --cycles 1 --watch {}
{} = 1
"""
PROGRAMS = [  # name, text, what it lacks
    ("coil.st", COIL.format("FALLING", "c.q"), None),
    ("another_coil_asserted.st", COIL.format("FALLING", "c.r"), "no assertion depends on it"),
    ("rising_coil.st", COIL.format("RISING", "c.q"), "it does not occur"),
    ("output.st", TIMER.format("late := t.Q; IF n > 1 THEN ASSERT(late); END_IF"), None),
    ("condition.st", TIMER.format("IF t.Q THEN n := n + 1; END_IF\nASSERT_EQ(5, n);"), None),
    ("case.st", TIMER.format("CASE n OF 0: ASSERT(NOT late); 1: ASSERT(t.Q); END_CASE"), None),
    ("nothing_asserted.st", TIMER.format("late := t.Q;"), "no assertion depends on it"),
    ("another_value.st", TIMER.format("late := t.Q; other := n > 1; ASSERT(other);"), "no assertion depends on it"),
    ("only_in_a_comment.st", TIMER.format("ASSERT(t.Q);").replace("t : TON", "t : TP"), "it does not occur"),
    ("in_a_function.st", "// covers: tm-tp-library:SQRT\nFUNCTION Root : REAL\nVAR_INPUT x : REAL; END_VAR\nRoot := SQRT(x);\n"
     "END_FUNCTION\n{test}\nPROGRAM p\nASSERT_NEAR(2.0, Root(4.0), 0.1);\nEND_PROGRAM\n", None),
    ("function_not_called.st", "// covers: tm-tp-library:SQRT\nFUNCTION Root : REAL\nVAR_INPUT x : REAL; END_VAR\nRoot := SQRT(x);\n"
     "END_FUNCTION\n{test}\nPROGRAM p\nVAR y : REAL; END_VAR\nASSERT_NEAR(2.0, y, 2.0);\nEND_PROGRAM\n", "no assertion depends on it"),
    ("refused.st", "// covers: tm-tp-language:CONSTANT\nPROGRAM p\nVAR CONSTANT k : INT := 1; END_VAR\nk := 2;\nEND_PROGRAM\n"
     "// expect: refused.st:4:1: error[E0702]: `k` is a constant and cannot be written\n", None),
    ("another_line_refused.st", "// covers: tm-tp-language:CONSTANT\nPROGRAM p\nVAR CONSTANT k : INT := 1; END_VAR\nVAR n : BOOL; END_VAR\n"
     "n := 2.5;\nEND_PROGRAM\n// expect: another_line_refused.st:5:6: error[E0501]: text\n", "no assertion depends on it"),
    ("il.st", "// covers: tm-tp-language:IL:XOR\nFUNCTION f : BOOL\nVAR_INPUT a, b : BOOL; END_VAR\nLD a\nXOR b\nST f\nEND_FUNCTION\n"
     "{test}\nPROGRAM p\nASSERT(f(TRUE, FALSE));\nEND_PROGRAM\n", None),
    ("session.test", SESSION.format("p.n", "p.n"), None),
]


def main():
    table, failed = Table(), 0
    with tempfile.TemporaryDirectory() as folder:
        for name, text, wanted in PROGRAMS:
            file = pathlib.Path(folder) / name
            file.write_text(text)
            program = Program(file)
            for row in program.rows["features"] + program.rows["covers"]:
                lack = program.lacks(re.compile(table.entry(row)[0], re.I | re.M), False)
                if lack != wanted:
                    print(f"evidence_test.py: {name}: `{row}` lacks {lack!r}, not {wanted!r}")
                    failed = 1
    return failed


if __name__ == "__main__":
    sys.exit(main())

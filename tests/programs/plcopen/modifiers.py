#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every modifier at every element and pin of networks, without and with EN: it works, or it is E1021.

usage: modifiers.py works.st fails.st

Writes a test for each cell of the table in docs/networks.md that works, with values that this script computes, and a
network for each other cell. The last line of its output counts both.
"""
import sys

# x and en in each cycle; the first cycle is not judged, so that F_TRIG has seen a value
X = [0, 1, 1, 0, 1, 0, 0, 1, 1, 0]
EN = [1, 1, 1, 1, 0, 0, 1, 1, 0, 1]
LOGIC = ['', 'NOT', 'RISING', 'FALLING', 'NOT RISING', 'NOT FALLING']
STORAGE = ['SET', 'RESET', 'NOT SET', 'RISING RESET']

PREAMBLE = '''TYPE Pt : STRUCT x, y : BOOL; END_STRUCT END_TYPE
FUNCTION_BLOCK Copy
VAR_INPUT a : BOOL; END_VAR
VAR_OUTPUT o : BOOL; END_VAR
o := a;
END_FUNCTION_BLOCK
FUNCTION Same : BOOL
VAR_INPUT a : BOOL; END_VAR
VAR_OUTPUT also : BOOL; END_VAR
Same := a; also := a;
END_FUNCTION
FUNCTION_BLOCK Holder
VAR_IN_OUT v : BOOL; END_VAR
;
END_FUNCTION_BLOCK
'''
works, fails = [PREAMBLE], [PREAMBLE]
cells = 0


def edges(values, kind):
    """R_TRIG or F_TRIG of the values"""
    out, before = [], 0 if kind == 'RISING' else None
    for v in values:
        out.append(int(before is not None and (v and not before if kind == 'RISING' else before and not v)))
        before = v
    return out


def pin(values, modifiers):
    """the edge, then NOT"""
    for word in ('RISING', 'FALLING'):
        if word in modifiers.split():
            values = edges(values, word)
    return [1 - v for v in values] if 'NOT' in modifiers.split() else values


def variable(values, modifiers):
    """of a contact or an input: NOT, then the edge"""
    words = modifiers.split()
    values = [1 - v for v in values] if 'NOT' in words else values
    return edges(values, words[-1]) if words and words[-1] in ('RISING', 'FALLING') else values


def stored(values, modifiers, runs=None, start=0):
    """the variable that is assigned, set or reset by the values, in the cycles in which the box runs"""
    q, out = start, []
    for cycle, v in enumerate(values):
        if runs is None or runs[cycle]:
            q = 1 if 'SET' in modifiers.split() and v else 0 if 'RESET' in modifiers.split() and v else q if 'SET' in modifiers else v
        out.append(q)
    return out


def held(values, runs):
    out, last = [], 0
    for v, run in zip(values, runs):
        last = v if run else last
        out.append(last)
    return out


def cell(name, body, wanted, declarations='', language='CFC', start=0):
    global cells
    cells += 1
    title = '%s_%d' % (name, cells)
    works.append('FUNCTION_BLOCK C%d\nVAR_INPUT x, en : BOOL; END_VAR\nVAR_OUTPUT q : BOOL := %s; END_VAR\nVAR t : BOOL := TRUE; %s END_VAR\n{network %s}\n%s\n{end_network}\nEND_FUNCTION_BLOCK\n'
                 % (cells, 'TRUE' if start else 'FALSE', declarations, language, body))
    lines = ''.join('c(x := %s, en := %s);%s\n' % (bool(x), bool(e), '' if n == 0 else " ASSERT_EQ(%s, c.q, '%d');" % (str(bool(w)).upper(), n)) for n, (x, e, w) in enumerate(zip(X, EN, wanted)))
    works.append('{test}\nPROGRAM %s\nVAR c : C%d; END_VAR\n%sEND_PROGRAM\n' % (title, cells, lines.replace('True', 'TRUE').replace('False', 'FALSE')))


errors = 0


def wrong(body, declarations='', language='CFC'):
    global errors
    errors += 1
    fails.append('FUNCTION_BLOCK W%d\nVAR_INPUT x, en : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nVAR t : BOOL := TRUE; v : BOOL; p : Pt; %s END_VAR\n{network %s}\n%s\n{end_network}\nEND_FUNCTION_BLOCK\n' % (errors, declarations, language, body))


def start_of(m):
    return 1 if 'RESET' in m.split() else 0


# ---- elements
for m in LOGIC:
    cell('contact', 'rail 1; contact 2 (x) %s := 1; coil 3 (q) := 2;' % m, variable(X, m), language='LD')
    cell('contact_in_row', 'rail 1; contact 4 (en) := 1; contact 2 (x) %s := 4; coil 3 (q) := 2;' % m, [a & b for a, b in zip(variable(X, m), EN)], language='LD')
    cell('input', 'input 1 %s (x); output 2 (q) := 1;' % m, variable(X, m), language='FBD')
    cell('input_read_twice', 'input 1 %s (x); box 3 AND [IN1 := 1, IN2 := 1, OUT =>]; output 2 (q) := 3(OUT);' % m, variable(X, m), language='FBD')
    cell('connector', 'input 1 (x); connector 2 K %s := 1; continuation 3 K; output 4 (q) := 3;' % m, pin(X, m), language='FBD')
    cell('jump', 'input 1 (FALSE); input 2 (TRUE); input 3 (x); output 4 (q) := 1 ORDER 1; jump 5 over %s := 3 ORDER 2; output 6 (q) := 2 ORDER 3; label 7 over ORDER 4;' % m, [1 - v for v in pin(X, m)])
    cell('return', 'input 1 (FALSE); input 2 (TRUE); input 3 (x); output 4 (q) := 1 ORDER 1; return 5 %s := 3 ORDER 2; output 6 (q) := 2 ORDER 3;' % m, [1 - v for v in pin(X, m)])
    cell('inout_read', 'input 1 (x); inout 2 (v) := 1 [OUT %s =>]; output 3 (q) := 2;' % m, pin(X, m), 'v : BOOL;', 'FBD')
for m in LOGIC + STORAGE:
    wanted = stored(pin(X, m), m, start=start_of(m))
    cell('output', 'input 1 (x); output 2 (q) %s := 1;' % m, wanted, language='FBD', start=start_of(m))
    cell('coil', 'rail 1; contact 2 (x) := 1; coil 3 (q) %s := 2;' % m, wanted, language='LD', start=start_of(m))
    cell('inout_written', 'input 1 (x); inout 2 (q) %s := 1; output 3 (v) := 2;' % m, wanted, 'v : BOOL;', 'FBD', start_of(m))

# ---- pins of boxes, without and with EN
BOXES = [('instance', 'Copy (b)', 'a', 'o', 'b : Copy;'), ('function', 'Same', 'a', 'Same', ''), ('output', 'Same', 'a', 'also', ''), ('move', 'MOVE', 'IN', 'OUT', ''), ('not_not', 'NOT', 'IN', 'OUT', '')]
for name, box, a, o, d in BOXES:
    raw = [1 - v for v in X] if name == 'not_not' else X
    flip = lambda values: [1 - v for v in values] if name == 'not_not' else values
    for with_en in (False, True):
        runs = EN if with_en else [1] * len(X)
        en = 'EN := 2, ' if with_en else ''
        eno = 'ENO =>, ' if with_en else ''
        value = held(raw, runs)
        for m in LOGIC:
            of_input = held(flip(pin(X, m)), runs)
            cell('%s_in' % name, 'input 1 (x); input 2 (en); box 3 %s [%s%s %s := 1, %s =>]; output 4 (q) := 3(%s);' % (box, en, a, m, o, o), stored(of_input, '', runs), d, 'FBD')
        for m in LOGIC + STORAGE:
            s = start_of(m)
            body = 'input 1 (x); input 2 (en); box 3 %s [%s%s := 1, %s%s %s =>]; output 4 (q) := 3(%s);' % (box, en, a, eno, o, m, o)
            cell('%s_out' % name, body, stored(pin(value, m), m, runs, s), d, 'FBD', s)
            cell('%s_out_twice' % name, body + ' output 5 (r) := 3(%s);' % o, stored(pin(value, m), m, runs, s), d + ' r : BOOL;', 'FBD', s)
            if with_en:
                cell('%s_eno' % name, 'input 1 (x); input 2 (en); box 3 %s [%s%s := 1, ENO %s =>, %s =>]; output 4 (q) := 3(ENO); output 5 (r) := 3(%s);' % (box, en, a, m, o, o), stored(pin(EN, m), m, None, s), d + ' r : BOOL;', 'FBD', s)
        if with_en:
            for m in LOGIC:
                on = pin(EN, m)
                cell('%s_en' % name, 'input 1 (x); input 2 (en); box 3 %s [EN %s := 2, %s := 1, %s =>]; output 4 (q) := 3(%s);' % (box, m, a, o, o), stored(held(raw, on), '', on), d, 'FBD')
        # another box reads the pin: it sees the value of the last call
        for m in LOGIC:
            cell('%s_read' % name, 'input 1 (x); input 2 (en); box 3 %s [%s%s := 1, %s%s %s =>]; box 5 OR [IN1 := 3(%s), IN2 := 3(%s), OUT =>]; output 4 (q) := 5(OUT);' % (box, en, a, eno, o, m, o, o), pin(value, m), d, 'FBD')

# ---- statements and structures
for m in LOGIC:
    cell('execute_en', 'input 1 (x); execute 2 [EN %s := 1, ENO =>] {network ST} ; {end_network}; output 3 (q) := 2(ENO);' % m, pin(X, m), language='FBD')
    cell('compose_in', 'input 1 (x); input 2 (t); compose 3 Pt [x %s := 1, y := 2]; select 4 Pt [in := 3, x =>, y =>]; output 5 (q) := 4(x) ORDER 1;' % m, pin(X, m))
for m in LOGIC + STORAGE:
    s = start_of(m)
    cell('execute_eno', 'input 1 (x); execute 2 [EN := 1, ENO %s =>] {network ST} ; {end_network}; output 3 (q) := 2(ENO);' % m, stored(pin(X, m), m, None, s), language='FBD', start=s)
    cell('select_out', 'input 1 (x); output 6 (p.x) := 1 ORDER 1; input 3 (p); select 4 Pt [in := 3, x %s =>, y =>] ORDER 2; output 5 (q) := 4(x) ORDER 3;' % m, stored(pin(X, m), m, None, s), 'p : Pt;', start=s)

# ---- no effect
for m in ('NOT', 'RISING', 'FALLING', 'SET', 'RESET'):
    wrong('rail 1 %s; contact 2 (x) := 1; coil 3 (q) := 2;' % m, language='LD')
    wrong('rail 1; contact 2 (x) := 1; coil 3 (q) := 2; right_rail 4 %s := 3;' % m, language='LD')
    wrong('label 1 here %s;' % m)
    wrong("comment 1 %s 'text';" % m)
    wrong('input 1 (x); connector 2 K := 1; continuation 3 K %s; output 4 (q) := 3;' % m)
    wrong('input 1 (x); box 2 MOVE %s [IN := 1, OUT =>]; output 3 (q) := 2(OUT);' % m)
    wrong('input 1 (x); box 2 Copy (b) %s [a := 1, o =>]; output 3 (q) := 2(o);' % m, 'b : Copy;')
    wrong('execute 1 %s [EN := 2] {network ST} ; {end_network}; input 2 (x);' % m)
    wrong('input 1 (x); compose 2 Pt %s [x := 1, y := 1]; output 3 (p) := 2;' % m)
    wrong('input 1 (x); compose 2 Pt [x := 1, y := 1, OUT %s =>]; output 3 (p) := 2;' % m)
    wrong('input 1 (p); select 2 Pt %s [in := 1, x =>]; output 3 (q) := 2(x);' % m)
    wrong('inout 1 (v) %s; output 2 (q) := 1;' % m)
    wrong('inout 1 (v); box 2 Holder (h) [v %s := 1 =>];' % m, 'h : Holder;')
    wrong('jump 1 here %s; label 2 here;' % m)
    wrong('return 1 %s;' % m)
for m in ('SET', 'RESET'):
    wrong('rail 1; contact 2 (x) %s := 1; coil 3 (q) := 2;' % m, language='LD')
    wrong('input 1 (x) %s; output 2 (q) := 1;' % m)
    wrong('input 1 (x); connector 2 K %s := 1; continuation 3 K; output 4 (q) := 3;' % m)
    wrong('input 1 (x); jump 2 here %s := 1; label 3 here;' % m)
    wrong('input 1 (x); return 2 %s := 1;' % m)
    wrong('input 1 (x); box 2 Copy (b) [a %s := 1, o =>]; output 3 (q) := 2(o);' % m, 'b : Copy;')
    wrong('input 1 (x); box 2 MOVE [EN %s := 1, IN := 1, OUT =>]; output 3 (q) := 2(OUT);' % m)
    wrong('input 1 (x); execute 2 [EN %s := 1] {network ST} ; {end_network};' % m)
    wrong('input 1 (x); compose 2 Pt [x %s := 1, y := 1]; output 3 (p) := 2;' % m)
    wrong('input 1 (p); select 2 Pt [in %s := 1, x =>]; output 3 (q) := 2(x);' % m)
    # nothing stores what leaves the pin
    wrong('input 1 (x); box 2 Copy (b) [a := 1, o %s =>]; box 3 NOT [IN := 2(o), OUT =>]; output 4 (q) := 3(OUT);' % m, 'b : Copy;')

open(sys.argv[1], 'w').write(''.join(works))
open(sys.argv[2], 'w').write(''.join(fails))
print('%d cells work, %d are errors' % (cells, errors))

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Names of every kind after a conversion.  names.py [STEP]

Each keyword of the other dialects and languages, and each name of a library, is tried as the name of a variable, member,
item, POU, pin and step, and each keyword as the name of everything else that a program declares. What Rung takes in ST is
converted to ST and to PLCopen XML and must give the same trace. STEP: each STEPth name only. Prints the conversions that
differ, then how many programs were compared.
"""
import glob, os, re, subprocess, sys, tempfile

# Keywords that a file may use as names because it declares a variable of that name; with --split another file declares it.
NAMES_OF_THEIR_FILE = {'BY', 'TO', 'CONTINUE', 'CONFIGURATION', 'RESOURCE', 'CHAR', 'WCHAR', 'REF_TO', 'LTIME', 'LDATE', 'LTOD', 'LDT'}
FORMS = {'st': ['--to', 'st'], 'split': ['--to', 'st', '--split'], 'xml': ['--to', 'xml']}
USES = {
    'variable': 'PROGRAM Main\nVAR {0} : INT := 3; n : INT; END_VAR\nn := {0} + 1;\nEND_PROGRAM\n',
    'member': 'TYPE T_t : STRUCT {0} : INT := 3; other_m : INT := 4; END_STRUCT END_TYPE\nPROGRAM Main\nVAR t_v : T_t; n : INT; END_VAR\nn := t_v.{0} * 10 + t_v.other_m;\nEND_PROGRAM\n',
    'item': "TYPE E_t : (first_i, {0}, last_i) := {0}; END_TYPE\nPROGRAM Main\nVAR e_v : E_t; n : INT; END_VAR\nIF e_v = E_t#{0} THEN n := 1; END_IF\nEND_PROGRAM\n",
    'block': 'FUNCTION_BLOCK {0}\nVAR_OUTPUT y_o : INT; END_VAR\ny_o := y_o + 1;\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : {0}; n : INT; END_VAR\nb_v(); n := b_v.y_o;\nEND_PROGRAM\n',
    'pin': 'FUNCTION_BLOCK B_b\nVAR_INPUT {0} : INT; END_VAR\nVAR_OUTPUT y_o : INT; END_VAR\ny_o := {0};\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : B_b; n : INT; END_VAR\n{{network FBD}}\ninput 1 (7);\nbox 2 B_b (b_v) [{0} := 1, y_o =>];\noutput 3 (n) := 2(y_o);\n{{end_network}}\nEND_PROGRAM\n',
    'step': 'PROGRAM Main\nVAR n : INT; END_VAR\nINITIAL_STEP {0}: END_STEP\nSTEP b_s: END_STEP\nTRANSITION FROM {0} TO b_s := TRUE; END_TRANSITION\nTRANSITION FROM b_s TO {0} := TRUE; END_TRANSITION\nEND_PROGRAM\n',
}
KEYWORD_USES = {
    'located': 'PROGRAM Main\nVAR {0} AT %MW2 : INT := 3; n : INT; END_VAR\nn := {0} + 1;\nEND_PROGRAM\n',
    'global': 'VAR_GLOBAL\n{0} : INT := 3;\nEND_VAR\nPROGRAM Main\nVAR n : INT; END_VAR\n{0} := {0} + 1; n := {0};\nEND_PROGRAM\n',
    'external': 'VAR_GLOBAL\n{0} : INT := 3;\nEND_VAR\nPROGRAM Main\nVAR_EXTERNAL\n{0} : INT;\nEND_VAR\nVAR n : INT; END_VAR\n{0} := {0} + 1; n := {0};\nEND_PROGRAM\n',
    'function': 'FUNCTION {0} : INT\nVAR_INPUT i : INT; END_VAR\n{0} := i + 1;\nEND_FUNCTION\nPROGRAM Main\nVAR n : INT; END_VAR\nn := {0}(n) + {0}(i := 2);\nEND_PROGRAM\n',
    'argument': 'FUNCTION F_f : INT\nVAR_INPUT {0} : INT; END_VAR\nVAR_OUTPUT o : INT; END_VAR\nF_f := {0} + 1; o := {0};\nEND_FUNCTION\nPROGRAM Main\nVAR n, m : INT; END_VAR\nn := F_f({0} := n, o => m);\nEND_PROGRAM\n',
    'output': 'FUNCTION F_f : INT\nVAR_INPUT i : INT; END_VAR\nVAR_OUTPUT {0} : INT; END_VAR\n{0} := i + 2;\nEND_FUNCTION\nPROGRAM Main\nVAR n, m : INT; END_VAR\nn := F_f(n, {0} => m);\nEND_PROGRAM\n',
    'structure': 'TYPE {0} : STRUCT a : INT := 3; END_STRUCT END_TYPE\nPROGRAM Main\nVAR s_v : {0}; n : INT; END_VAR\nn := s_v.a;\nEND_PROGRAM\n',
    'initialiser': 'TYPE T_t : STRUCT {0} : INT := 3; b_m : INT; END_STRUCT END_TYPE\nPROGRAM Main\nVAR t_v : T_t := ({0} := 4, b_m := 5); n : INT; END_VAR\nn := t_v.{0} + t_v.b_m;\nEND_PROGRAM\n',
    'enumeration': 'TYPE {0} : (one_i, two_i) := two_i; END_TYPE\nPROGRAM Main\nVAR e_v : {0}; n : INT; END_VAR\nIF e_v = {0}.two_i THEN n := 1; END_IF\nEND_PROGRAM\n',
    'base': 'FUNCTION_BLOCK {0}\nVAR_OUTPUT y_o : INT; END_VAR\ny_o := y_o + 1;\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK D_d EXTENDS {0}\nSUPER^();\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : D_d; n : INT; END_VAR\nb_v(); n := b_v.y_o;\nEND_PROGRAM\n',
    'derived': 'FUNCTION_BLOCK B_b\nVAR_OUTPUT y_o : INT; END_VAR\ny_o := y_o + 1;\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK {0} EXTENDS B_b\nSUPER^();\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : {0}; n : INT; END_VAR\nb_v(); n := b_v.y_o;\nEND_PROGRAM\n',
    'interface': 'INTERFACE {0}\nMETHOD Get_m : INT\nEND_METHOD\nEND_INTERFACE\nFUNCTION_BLOCK B_b IMPLEMENTS {0}\nMETHOD Get_m : INT\nGet_m := 7;\nEND_METHOD\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : B_b; i_v : {0}; n : INT; END_VAR\ni_v := b_v; n := i_v.Get_m();\nEND_PROGRAM\n',
    'method': 'FUNCTION_BLOCK B_b\nMETHOD {0} : INT\nVAR_INPUT i : INT; END_VAR\n{0} := i + 7;\nEND_METHOD\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : B_b; n : INT; END_VAR\nn := b_v.{0}(n);\nEND_PROGRAM\n',
    'property': 'FUNCTION_BLOCK B_b\nVAR v_v : INT; END_VAR\nPROPERTY {0} : INT\nGET\n{0} := v_v + 1;\nEND_GET\nSET\nv_v := {0};\nEND_SET\nEND_PROPERTY\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : B_b; n : INT; END_VAR\nb_v.{0} := 4; n := b_v.{0};\nEND_PROGRAM\n',
    'action': 'PROGRAM Main\nVAR n : INT; END_VAR\nACTION {0}:\nn := n + 1;\nEND_ACTION\n{0}();\nEND_PROGRAM\n',
    'associated': 'PROGRAM Main\nVAR n : INT; END_VAR\nINITIAL_STEP a_s:\n{0}(N);\nEND_STEP\nSTEP b_s: END_STEP\nTRANSITION FROM a_s TO b_s := n > 1; END_TRANSITION\nTRANSITION FROM b_s TO a_s := TRUE; END_TRANSITION\nACTION {0}:\nn := n + 1;\nEND_ACTION\nEND_PROGRAM\n',
    'transition': 'PROGRAM Main\nVAR n : INT; END_VAR\nINITIAL_STEP a_s: END_STEP\nSTEP b_s: END_STEP\nTRANSITION {0} FROM a_s TO b_s := TRUE; END_TRANSITION\nTRANSITION FROM b_s TO a_s := TRUE; END_TRANSITION\nEND_PROGRAM\n',
    'second step': 'PROGRAM Main\nVAR n : INT; END_VAR\nINITIAL_STEP a_s: END_STEP\nSTEP {0}: END_STEP\nTRANSITION FROM a_s TO {0} := TRUE; END_TRANSITION\nTRANSITION FROM {0} TO a_s := {0}.x; END_TRANSITION\nEND_PROGRAM\n',
    'program': 'PROGRAM {0}\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\nCONFIGURATION C_c\nRESOURCE R_r ON PLC\nTASK T_t(INTERVAL := T#10ms, PRIORITY := 1);\nPROGRAM P_p WITH T_t : {0};\nEND_RESOURCE\nEND_CONFIGURATION\n',
    'instance': 'PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\nCONFIGURATION C_c\nRESOURCE R_r ON PLC\nTASK T_t(INTERVAL := T#10ms, PRIORITY := 1);\nPROGRAM {0} WITH T_t : Main;\nEND_RESOURCE\nEND_CONFIGURATION\n',
    'task': 'PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\nCONFIGURATION C_c\nRESOURCE R_r ON PLC\nTASK {0}(INTERVAL := T#10ms, PRIORITY := 1);\nPROGRAM P_p WITH {0} : Main;\nEND_RESOURCE\nEND_CONFIGURATION\n',
    'wired': 'PROGRAM Main\nVAR {0} : BOOL := TRUE; n : BOOL; END_VAR\n{{network LD}}\nrail 1;\ncontact 2 ({0}) := 1;\ncoil 3 (n) := 2;\n{{end_network}}\nEND_PROGRAM\n',
    'il': 'PROGRAM Main\nVAR {0} : INT := 3; n : INT; END_VAR\nLD {0}\nADD 1\nST {0}\nST n\nEND_PROGRAM\n',
}


def rung(*args):
    return subprocess.run(['rung', *args], capture_output=True, text=True, errors='replace', timeout=60)


def trace(path):
    run = rung('run', path, '--cycles', '3', '--trace', '-', '-Wno-all')
    rows = [r for r in run.stdout.splitlines() if re.match(r'cycle,|\d+,', r)]
    columns = sorted(zip(*(r.split(',') for r in rows))) if run.returncode == 0 else None
    return columns, next((l for l in run.stderr.splitlines() if 'error' in l), '')


def main():
    step = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    source = os.environ.get('RUNG_SOURCE', '.')
    keywords = set(re.findall(r'"([A-Za-z_]+)"', open(os.path.join(source, 'frontend/parse/tokens.def')).read()))
    words = set(keywords)
    for library in glob.glob(os.path.join(source, 'stdlib/*/*.st')):
        words |= set(re.findall(r'^\s*(?:FUNCTION|FUNCTION_BLOCK|TYPE) (\w+)', open(library, encoding='utf-8').read(), re.M))
    words |= {'Null', 'Local', 'x', 'EN', 'ENO', 'n1', 'SFCInit', 'ref', 'any', 'self', 'int', 'class', 'namespace', 'template', 'xml', 'pou'}
    words = sorted(w for w in words if re.fullmatch(r'[A-Za-z]\w*', w))[::step]
    compared = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for word in words:
            for use, text in {**USES, **(KEYWORD_USES if word in keywords else {})}.items():
                path = os.path.join(folder, 'p.st')
                open(path, 'w').write(text.format(word))
                before, _ = trace(path)
                if before is None:
                    continue
                compared += 1
                for form in FORMS:
                    if form == 'split' and use == 'global' and word in NAMES_OF_THEIR_FILE:
                        continue
                    out = os.path.join(folder, '%d_%s' % (compared, form))
                    made = rung('convert', path, *FORMS[form], '-o', out)
                    after, error = trace(out) if made.returncode == 0 else (None, made.stderr.strip().split('\n')[0])
                    if after != before:
                        wrong += 1
                        print('%s as %s: %s: %s' % (word, use, form, error.replace(folder + '/', '') or 'another trace'), flush=True)
    print('%d programs compared, %d conversions differ' % (compared, wrong))
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())

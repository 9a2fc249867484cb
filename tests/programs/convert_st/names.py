#!/usr/bin/env python3
"""Names of every kind after a conversion.  names.py [STEP]

Each keyword of the other dialects and languages, and each name of a library, is tried as the name of a variable, member,
item and POU. What Rung takes in ST is converted to ST and to PLCopen XML and must give the same trace. STEP: each STEPth
name only. Prints the conversions that differ, then how many programs were compared.
"""
import glob, os, re, subprocess, sys, tempfile

FORMS = {'st': ['--to', 'st'], 'split': ['--to', 'st', '--split'], 'xml': ['--to', 'xml']}
USES = {
    'variable': 'PROGRAM Main\nVAR {0} : INT := 3; n : INT; END_VAR\nn := {0} + 1;\nEND_PROGRAM\n',
    'member': 'TYPE T_t : STRUCT {0} : INT := 3; other_m : INT := 4; END_STRUCT END_TYPE\nPROGRAM Main\nVAR t_v : T_t; n : INT; END_VAR\nn := t_v.{0} * 10 + t_v.other_m;\nEND_PROGRAM\n',
    'item': "TYPE E_t : (first_i, {0}, last_i) := {0}; END_TYPE\nPROGRAM Main\nVAR e_v : E_t; n : INT; END_VAR\nIF e_v = E_t#{0} THEN n := 1; END_IF\nEND_PROGRAM\n",
    'block': 'FUNCTION_BLOCK {0}\nVAR_OUTPUT y_o : INT; END_VAR\ny_o := y_o + 1;\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : {0}; n : INT; END_VAR\nb_v(); n := b_v.y_o;\nEND_PROGRAM\n',
    'pin': 'FUNCTION_BLOCK B_b\nVAR_INPUT {0} : INT; END_VAR\nVAR_OUTPUT y_o : INT; END_VAR\ny_o := {0};\nEND_FUNCTION_BLOCK\nPROGRAM Main\nVAR b_v : B_b; n : INT; END_VAR\n{{network FBD}}\ninput 1 (7);\nbox 2 B_b (b_v) [{0} := 1, y_o =>];\noutput 3 (n) := 2(y_o);\n{{end_network}}\nEND_PROGRAM\n',
    'step': 'PROGRAM Main\nVAR n : INT; END_VAR\nINITIAL_STEP {0}: END_STEP\nSTEP b_s: END_STEP\nTRANSITION FROM {0} TO b_s := TRUE; END_TRANSITION\nTRANSITION FROM b_s TO {0} := TRUE; END_TRANSITION\nEND_PROGRAM\n',
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
    words = set(re.findall(r'"([A-Za-z_]+)"', open(os.path.join(source, 'frontend/parse/tokens.def')).read()))
    for library in glob.glob(os.path.join(source, 'stdlib/*/*.st')):
        words |= set(re.findall(r'^\s*(?:FUNCTION|FUNCTION_BLOCK|TYPE) (\w+)', open(library, encoding='utf-8').read(), re.M))
    words |= {'Null', 'Local', 'x', 'EN', 'ENO', 'n1', 'SFCInit', 'ref', 'any', 'self', 'int', 'class', 'namespace', 'template', 'xml', 'pou'}
    words = sorted(w for w in words if re.fullmatch(r'[A-Za-z]\w*', w))[::step]
    compared = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for word in words:
            for use, text in USES.items():
                path = os.path.join(folder, 'p.st')
                open(path, 'w').write(text.format(word))
                before, _ = trace(path)
                if before is None:
                    continue
                compared += 1
                for form in FORMS:
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

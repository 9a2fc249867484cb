#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do converted tests pass?  tests_pass.py [--forms st,split,xml] FILE...

Each conformance program is converted to ST, to ST with a file for each POU, and to PLCopen XML; the same tests must pass
as before. `// args:` of a file are used. Prints what differs, then how many files were compared.
"""
import os, re, subprocess, sys, tempfile

FORMS = {'st': ['--to', 'st'], 'split': ['--to', 'st', '--split'], 'xml': ['--to', 'xml']}


def rung(*args):
    return subprocess.run(['rung', *args], capture_output=True, text=True, errors='replace', timeout=120)


def results(path, args):
    """The results of the tests by name, or the first error."""
    run = rung('test', path, *args)
    found = sorted(re.findall(r'^(pass|FAIL|skip) (\w+)', run.stdout, re.M))
    return found, next((l for l in run.stderr.splitlines() if 'error' in l), '')


def main():
    args, forms = sys.argv[1:], list(FORMS)
    if args[:1] == ['--forms']:
        forms, args = args[1].split(','), args[2:]
    compared = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for path in args:
            text = open(path, encoding='utf-8', errors='replace').read()
            options = [o for line in re.findall(r'^// args: (.*)', text, re.M) for o in line.split()]
            if re.search(r'^// expect: .*: error\[', text, re.M):
                continue
            before, error = results(path, options)
            if not before or error:
                continue
            compared += 1
            for form in forms:
                out = os.path.join(folder, '%d_%s' % (compared, form))
                made = rung('convert', path, *FORMS[form], '-o', out, *[o for o in options if o.startswith('--std')])
                after, error = results(out, options) if made.returncode == 0 else ([], next((l for l in made.stderr.splitlines() if 'error' in l), made.stderr[:100]))
                if after != before:
                    wrong += 1
                    print('%s: %s: %s' % (path, form, error.replace(folder + '/', '') or [r for r in after if r not in before][:3] or 'other tests'), flush=True)
    print('%d files compared, %d conversions differ' % (compared, wrong))
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())

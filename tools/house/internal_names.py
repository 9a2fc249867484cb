#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does an expected output show a name of generated code?  internal_names.py

Generated code joins names with `__` (CAA__PVOID, Ring__4, Main__Start) and begins hidden ones with it. In: expectations of
golden and conformance programs, outputs of tests, pictures and generated pages. Each name with `__` in them must be one
that the test's own input has, or a word of the language. Not the text form of the IR, which shows these names on purpose.
Prints those that are neither; exit code 1 if there are any. Called by tools/house/checks.
"""
import glob, os, re, sys

NAME = re.compile(r'(?<![\w$])\w*__\w+')
# Words of CODESYS and of Rung's libraries, and macros of C++ in messages of compilers.
WORDS = {'__try', '__catch', '__finally', '__endtry', '__new', '__delete', '__system', '__xword', '__uxint', '__xint',
         '__compare_and_swap', '__xadd', '__position', '__pouname', '__varinfo', '__isvalidref', '__queryinterface',
         '__querypointer', '__currenttask', '__attribute__', '__atomic_compare_exchange_8'}
ELSEWHERE = {'tests/golden/cli/lowering.test', 'docs/errors/W0116.md', 'docs/errors/E0116.md'}


def halves(path, text):
    """What the test gives to Rung, and what it expects."""
    lines = text.split('\n')
    if path.endswith('.test'):
        given = [l for l in lines if l[:2] in ('$ ', '> ', '# ')]
        return given, [l for l in lines if l[:2] not in ('$ ', '> ', '# ')]
    if path.endswith('.st'):
        return [l for l in lines if not l.startswith('// expect')], [l for l in lines if l.startswith('// expect')]
    return [], lines


def main():
    os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
    paths = [p for pattern in ('tests/golden/diagnostics/**/*.st', 'tests/conformance/**/*.st', 'tests/**/*.test',
                               'tests/**/*.svg', 'samples/**/*.svg', 'docs/library/*.md', 'docs/errors/*.md')
             for p in glob.glob(pattern, recursive=True) if os.path.isfile(p)]
    found = 0
    for path in sorted(set(paths) - ELSEWHERE):
        text = open(path, encoding='utf-8', errors='replace').read()
        if '__' not in text:
            continue
        given, expected = halves(path, text)
        known = WORDS | {w.lower() for w in NAME.findall('\n'.join(given))}
        for word in sorted({w for w in NAME.findall('\n'.join(expected)) if w.lower() not in known}):
            print('%s: shows `%s`, a name of generated code' % (path, word))
            found += 1
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())

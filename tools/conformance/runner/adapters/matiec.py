#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adapter for matiec. --iec2c=PATH, --include=DIR (its lib folder), --flags="-l -p", --cc="gcc -O1 -fgnu89-inline"; see conformance.py for
what an adapter does. iec2c writes C; the program that runs the cycles is written here, beside that C: it gives each
located variable memory of its own, sets the time, and prints the variables that VARIABLES.csv describes."""
import argparse
import csv
import glob
import os
import re
import shlex
import subprocess
import sys
import tempfile

parser = argparse.ArgumentParser()
parser.add_argument('--iec2c', default='iec2c')
parser.add_argument('--include', default='/usr/share/matiec/lib')
parser.add_argument('--flags', default='')
parser.add_argument('--cc', default='gcc -O1 -fgnu89-inline')
parser.add_argument('operation', choices=['check', 'run', 'restart'])
parser.add_argument('source')
parser.add_argument('rest', nargs='*')  # of run: CYCLES INTERVAL_MS WATCH [INPUTS]
options = parser.parse_args()

INTEGERS = ['SINT', 'INT', 'DINT', 'LINT', 'USINT', 'UINT', 'UDINT', 'ULINT', 'BYTE', 'WORD', 'DWORD', 'LWORD']
MAIN = r'''
#include <stdio.h>
#include "iec_std_lib.h"
#include "accessor.h"
#include "POUS.h"
TIME __CURRENT_TIME;
BOOL __DEBUG;
%(located)s
void config_init__(void);
void config_run__(unsigned long tick);
extern unsigned long long common_ticktime__;
%(declarations)s
static void set(int cycle) { (void)cycle; %(inputs)s }
int main(void) {
  unsigned long tick = 0;
  config_init__();
  printf("cycle%(header)s\n");
  for (int cycle = 0; cycle < %(cycles)s; ++cycle) {
    const unsigned long long end = (cycle + 1) * %(interval)sULL * 1000000ULL;
    set(cycle);
    do {
      const unsigned long long now = common_ticktime__ * tick;
      __CURRENT_TIME.tv_sec = now / 1000000000ULL;
      __CURRENT_TIME.tv_nsec = now %% 1000000000ULL;
      config_run__(tick++);
    } while (common_ticktime__ != 0 && common_ticktime__ * tick < end);
    printf("%%d", cycle);
%(rows)s
    printf("\n");
    fflush(stdout);
  }
  return 0;
}
'''


def compile_to_c(target):
    """Messages go to stderr; iec2c prints the names of its files to stdout."""
    command = [options.iec2c] + shlex.split(options.flags) + ['-I', options.include, '-T', target, options.source]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    sys.stderr.write(done.stderr.decode('utf-8', 'replace'))
    if done.returncode != 0:
        is_own_error = done.returncode < 0 or b'Internal compiler error' in done.stderr
        sys.exit(70 if is_own_error else 1)


def variables(target):
    """By path in upper case: class, path in C, type; and the types of the programs."""
    found, programs = {}, {}
    with open(os.path.join(target, 'VARIABLES.csv'), encoding='utf-8') as file:
        for row in csv.reader(file, delimiter=';'):
            if len(row) >= 6:
                found[row[2]] = (row[1], row[3], row[4])
            elif len(row) == 4:
                programs[row[1]] = row[2]
    return found, programs


def lvalue(entry, programs, declarations):
    """The C lvalue of a variable: C.R.P.x is R__P.x.value, C.g and C.R.g are reached by their functions."""
    kind, path, type_name = entry
    program = next((p for p in programs if path.startswith(p + '.')), None)
    if program is None:
        name = path.split('.')[-1]
        declarations.add('extern %s* __GET_GLOBAL_%s(void);' % (type_name, name))
        return '(*__GET_GLOBAL_%s())' % name
    instance = '__'.join(program.split('.')[1:])
    declarations.add('extern %s %s;' % (programs[program], instance))
    steps = path[len(program) + 1:]
    pointer = kind in ('EXT', 'MEM', 'IN_OUT', 'LOC')
    return ('(*%s.%s.value)' if pointer else '%s.%s.value') % (instance, steps)


def located(target):
    """Memory for each located variable. The file may contain more than its lines of __LOCATED_VAR."""
    with open(os.path.join(target, 'LOCATED_VARIABLES.h'), encoding='utf-8') as file:
        found = re.findall(r'__LOCATED_VAR\((\w+),(\w+),', file.read())
    return '\n'.join('%s conformance%s; %s *%s = &conformance%s;' % (t, name, t, name, name) for t, name in found)


def printing(place, type_name):
    if type_name == 'BOOL':
        return 'printf(",%%s", %s ? "TRUE" : "FALSE");' % place
    if type_name in INTEGERS:
        unsigned = type_name[0] == 'U' or type_name in INTEGERS[8:]
        return ('printf(",%%llu", (unsigned long long)%s);' if unsigned else 'printf(",%%lld", (long long)%s);') % place
    if type_name in ('REAL', 'LREAL'):
        return 'printf(",%%.17g", (double)%s);' % place
    if type_name == 'TIME':
        return 'printf(",T#%%lldms", (long long)%s.tv_sec * 1000 + %s.tv_nsec / 1000000);' % (place, place)
    if type_name == 'STRING':
        return 'printf(",\'%%.*s\'", (int)%s.len, %s.body);' % (place, place)
    return 'printf(",%%lld", (long long)%s);' % place


def find(path, found):
    path = path.upper()
    return next((found[key] for key in found if key == path or key.endswith('.' + path)), None)


def inputs(path, found, programs, declarations):
    """The rows of a CSV as C."""
    with open(path, encoding='utf-8') as file:
        rows = list(csv.reader(file))
    code = ''
    for row in rows[1:]:
        for name, value in zip(rows[0][1:], row[1:]):
            entry = find(name, found)
            if entry is None:
                sys.exit(3)
            if value:
                place = lvalue(entry, programs, declarations)
                code += 'if (cycle == %s) %s = %s;\n' % (row[0], place, {'TRUE': '1', 'FALSE': '0'}.get(value, value))
    return code


def run():
    cycles, interval, watch = options.rest[:3]
    with open(watch, encoding='utf-8') as file:
        paths = file.read().split('\n')[:-1]
    with tempfile.TemporaryDirectory(dir='.') as target:
        compile_to_c(target)
        found, programs = variables(target)
        declarations, rows = set(), []
        for path in paths:
            entry = find(path, found)
            if entry is None:
                sys.stderr.write('VARIABLES.csv has no %s\n' % path)
                sys.exit(3)
            rows.append('    ' + printing(lvalue(entry, programs, declarations), entry[2]))
        given = inputs(options.rest[3], found, programs, declarations) if len(options.rest) > 3 else ''
        with open(os.path.join(target, 'conformance_main.c'), 'w', encoding='utf-8') as file:
            file.write(MAIN % {'located': located(target), 'declarations': '\n'.join(sorted(declarations)), 'inputs': given, 'cycles': cycles,
                               'interval': interval, 'rows': '\n'.join(rows),
                               'header': ''.join(',' + re.sub(r'[\\"%]', '', path) for path in paths)})
        sources = [p for p in glob.glob(os.path.join(target, '*.c')) if os.path.basename(p) != 'POUS.c']
        program = os.path.join(target, 'program')
        done = subprocess.run(shlex.split(options.cc) + ['-w', '-I', os.path.join(options.include, 'C'), '-I', target] +
                              sources + ['-o', program, '-lm'], stdout=sys.stderr)
        if done.returncode != 0:
            sys.exit(1)  # accepted by iec2c, refused by the C compiler: the user has no program
        code = subprocess.run([program]).returncode
        sys.exit(0 if code == 0 else 70)


if options.operation == 'restart':
    sys.exit(3)  # retained variables are the business of the runtime system, not of iec2c
elif options.operation == 'check':
    with tempfile.TemporaryDirectory(dir='.') as folder:
        compile_to_c(folder)
else:
    run()

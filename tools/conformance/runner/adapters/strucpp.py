#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adapter for STruC++. --strucpp="node PATH/cli.js", --flags="...", --cxx-flags="-O0"; see conformance.py for what an adapter
does. --build makes a program with a command line; it is asked to run one cycle at a time and to print each variable."""
import argparse
import csv
import re
import shlex
import subprocess
import sys
import tempfile

parser = argparse.ArgumentParser()
parser.add_argument('--strucpp', default='strucpp')
parser.add_argument('--flags', default='')
parser.add_argument('--cxx-flags', default='-O0')
parser.add_argument('operation', choices=['check', 'run', 'restart'])
parser.add_argument('source')
parser.add_argument('rest', nargs='*')  # of run: CYCLES INTERVAL_MS WATCH [INPUTS]
options = parser.parse_args()


def compile_in(folder, *more):
    command = shlex.split(options.strucpp) + [options.source, '-o', folder + '/program.cpp'] + shlex.split(options.flags)
    done = subprocess.run(command + list(more), stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    sys.stderr.write(done.stdout.decode('utf-8', 'replace'))
    if done.returncode != 0:
        sys.exit(1 if done.returncode > 0 else 70)


def plain(value):
    """A value as the trace shows it: bit strings come as 16#2A."""
    based = re.fullmatch(r'(2|8|16)#([0-9A-Fa-f_]+)', value)
    return str(int(based.group(2), int(based.group(1)))) if based else value


def run():
    cycles, _, watch = options.rest[:3]
    with open(watch, encoding='utf-8') as file:
        paths = file.read().split('\n')[:-1]
    inputs = {}
    if len(options.rest) > 3:
        with open(options.rest[3], encoding='utf-8') as file:
            rows = list(csv.reader(file))
        for row in rows[1:]:
            inputs[row[0]] = [(name, value) for name, value in zip(rows[0][1:], row[1:]) if value]
    with tempfile.TemporaryDirectory(dir='.') as folder:
        compile_in(folder, '--build', '--cxx-flags', options.cxx_flags)
        commands = []
        for cycle in range(int(cycles)):
            commands += ['set %s %s' % (name.upper(), value) for name, value in inputs.get(str(cycle), [])]
            commands += ['run 1'] + ['get %s' % path.upper() for path in paths]
        done = subprocess.run([folder + '/program'], input='\n'.join(commands + ['quit', '']).encode(),
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    said = done.stdout.decode('utf-8', 'replace')
    if done.returncode != 0:
        sys.stderr.write(said[-500:])
        sys.exit(70)
    print('cycle,' + ','.join(paths))
    parts = re.split(r'Executed 1 cycle\(s\)\. Total: \d+', said)[1:]
    for cycle, part in enumerate(parts):
        values = dict(re.findall(r'^\s*(\S+) : \S+ = (.*?)\s*$', part, re.M))
        if any(path.upper() not in values for path in paths):
            sys.stderr.write('its command line has no %s\n' % ', '.join(p for p in paths if p.upper() not in values))
            sys.exit(3)
        csv.writer(sys.stdout, lineterminator='\n').writerow([cycle] + [plain(values[path.upper()]) for path in paths])


if options.operation == 'restart':
    sys.exit(3)  # retained variables are the business of the runtime system
if options.operation == 'check':
    with tempfile.TemporaryDirectory(dir='.') as target:
        compile_in(target)
else:
    run()

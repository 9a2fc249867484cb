#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adapter for Rung. --rung=PATH, --std=iec2|iec3|codesys (default: iec2 or iec3, by the edition of the case),
--engine=interp|native; see conformance.py for what an adapter does."""
import argparse
import json
import os
import subprocess
import sys

parser = argparse.ArgumentParser()
parser.add_argument('--rung', default='rung')
parser.add_argument('--std')
parser.add_argument('--engine', default='interp')
parser.add_argument('operation', choices=['check', 'run', 'restart', 'serve'])
parser.add_argument('source', nargs='?')
parser.add_argument('rest', nargs='*')  # of run: CYCLES INTERVAL_MS WATCH [INPUTS], of restart: … INPUTS FIRST
options = parser.parse_args()


def answer(request):
    """Exit code, trace and messages for a request in the form that conformance.py sends."""
    def rung(*words):
        done = subprocess.run([options.rung] + list(words), cwd=request['folder'], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        return (done.returncode,) + tuple(text.decode('utf-8', 'replace') for text in (done.stdout, done.stderr))

    std = '--std=' + (options.std or ('iec2' if request['edition'] == 2 else 'iec3'))
    if request['operation'] == 'check':
        return rung('check', std, request['source'])
    words = ['run', request['source'], std, '--engine=' + options.engine, '--interval', 'T#%dms' % request['interval_ms'],
             '--watch', ','.join(request['watch']), '--trace', '-']
    inputs = ['--inputs', request['inputs']] if request['inputs'] else []
    if request['operation'] == 'restart':
        words += ['--retain', 'state']  # in the empty folder of this case
        code, _, messages = rung(*words, *inputs, '--cycles', str(request['first']))
        if code != 0:
            return code, '', messages
        inputs = []
    code, trace, messages = rung(*words, *inputs, '--cycles', str(request['cycles']))
    return 70 if code == 3 else code, trace, messages  # 3 is a fault of the program, which no case expects


def from_arguments():
    request = {'operation': options.operation, 'edition': int(os.environ.get('CONFORMANCE_EDITION', '3')), 'folder': '.',
               'source': options.source}
    if options.operation != 'check':
        cycles, interval, watch, inputs, first = (options.rest + ['-', '0'])[:5]
        with open(watch, encoding='utf-8') as file:
            paths = file.read().split('\n')[:-1]
        request.update(cycles=int(cycles), interval_ms=int(interval), watch=paths, inputs=None if inputs == '-' else inputs,
                       first=int(first))
    return request


if options.operation == 'serve':
    print(json.dumps({'protocol': 1}), flush=True)
    for line in sys.stdin:
        code, trace, messages = answer(json.loads(line))
        print(json.dumps({'exit': code, 'trace': trace, 'messages': messages}), flush=True)
else:
    code, trace, messages = answer(from_arguments())
    sys.stdout.write(trace)
    sys.stderr.write(messages)
    sys.exit(code)

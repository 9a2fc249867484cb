#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adapter for Rung. --rung=PATH, --std=iec2|iec3|codesys, --engine=interp|native; see conformance.py for what an adapter does."""
import argparse
import subprocess
import sys

parser = argparse.ArgumentParser()
parser.add_argument('--rung', default='rung')
parser.add_argument('--std', default='iec3')
parser.add_argument('--engine', default='interp')
parser.add_argument('operation', choices=['check', 'run', 'restart'])
parser.add_argument('source')
parser.add_argument('rest', nargs='*')  # of run: CYCLES INTERVAL_MS WATCH [INPUTS], of restart: … INPUTS FIRST
options = parser.parse_args()

if options.operation == 'check':
    sys.exit(subprocess.call([options.rung, 'check', '--std=' + options.std, options.source]))
cycles, interval, watch = options.rest[:3]
with open(watch, encoding='utf-8') as file:
    paths = ','.join(file.read().split('\n')[:-1])
command = [options.rung, 'run', options.source, '--std=' + options.std, '--engine=' + options.engine,
           '--interval', 'T#%sms' % interval, '--watch', paths, '--trace', '-']
inputs = ['--inputs', options.rest[3]] if len(options.rest) > 3 and options.rest[3] != '-' else []
if options.operation == 'restart':
    command += ['--retain', 'state']  # in the empty folder of this case
    code = subprocess.call(command + inputs + ['--cycles', options.rest[4]], stdout=subprocess.DEVNULL)
    if code != 0:
        sys.exit(code)
    inputs = []
code = subprocess.call(command + inputs + ['--cycles', cycles])
sys.exit(70 if code == 3 else code)  # 3 is a fault of the program, which no case expects

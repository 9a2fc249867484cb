#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does a converted project behave like the project?  traces.py [--cycles N] FILE|FOLDER...

Each project is run as it is and after `rung convert` to ST, to ST with a file for each POU, and to PLCopen XML; a CSV of the
project with a header `cycle,...` gives its inputs. The traces of all variables must be equal, whatever the order of the columns.
Prints what differs, then how many projects were compared. Used by tests/programs/convert_st, and by hand on public projects.
"""
import csv, os, re, subprocess, sys, tempfile

FORMS = {'st': ['--to', 'st'], 'split': ['--to', 'st', '--split'], 'xml': ['--to', 'xml']}

# The instances of edges in a ladder have numbers, which a file may give anew.
HIDDEN = re.compile(r'\.[RF]_TRIG_\d+\.')


def rung(*args):
    return subprocess.run(['rung', *args], capture_output=True, text=True, timeout=120)


def columns(project, cycles, inputs, trace):
    """The trace by the names of its columns, and how the run ended."""
    end = rung('run', project, '--cycles', str(cycles), '--trace', trace, *inputs)
    if end.returncode not in (0, 3):
        return None, end.stderr
    with open(trace, newline='') as file:
        found = {column[0].upper(): column[1:] for column in zip(*csv.reader(file))}
    return {name: values for name, values in found.items() if not HIDDEN.search(name)}, end.returncode


def inputs_of(project):
    if not os.path.isdir(project):
        return []
    for name in sorted(os.listdir(project)):
        path = os.path.join(project, name)
        if name.endswith('.csv') and open(path).readline().startswith('cycle,'):
            return ['--inputs', path]
    return []


def compare(project, cycles, folder):
    """Problems of a project, a line each; None: it does not run as it is."""
    inputs = inputs_of(project)
    before, end = columns(project, cycles, inputs, os.path.join(folder, 'before.csv'))
    if before is None:
        return None
    problems = []
    for form, options in FORMS.items():
        converted = os.path.join(folder, form)
        made = rung('convert', project, *options, '-o', converted)
        if made.returncode != 0:
            problems.append('%s: not converted: %s' % (form, next((l for l in made.stderr.splitlines() if 'error' in l), '')))
            continue
        after, end_after = columns(converted, cycles, inputs, os.path.join(folder, form + '.csv'))
        if after is None:
            problems.append('%s: does not run: %s' % (form, next((l for l in end_after.splitlines() if 'error' in l), end_after)))
            continue
        if end != end_after:
            problems.append('%s: exit code %s, not %s' % (form, end_after, end))
        for name in sorted(before.keys() | after.keys()):
            if before.get(name) != after.get(name):
                problems.append('%s: %s differs' % (form, name))
                break
    return problems


def main():
    args = sys.argv[1:]
    cycles = 60
    if args[:1] == ['--cycles']:
        cycles = int(args[1])
        args = args[2:]
    compared = bad = left_out = 0
    for project in args:
        with tempfile.TemporaryDirectory() as folder:
            problems = compare(project, cycles, folder)
        if problems is None:
            left_out += 1
            continue
        compared += 1
        bad += bool(problems)
        for problem in problems:
            print('%s: %s' % (project, problem))
    print('%d projects compared, %d differ%s' % (compared, bad, ', %d do not run' % left_out if left_out else ''))
    sys.exit(1 if bad else 0)


main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts a compiler of IEC 61131-3 through an exported conformance suite; docs/conformance.md.

  conformance.py run [--adapter "COMMAND"] [--name NAME] [--profile P]... [--case GLOB]... [--feature ID]...
                     [-j N] [--timeout S] [--json F] [--html F] [--junit F] [--baseline F] [--suite DIR]
  conformance.py compare RESULTS.json... [--html F]
  conformance.py baseline RESULTS.json -o BASELINE.json

An adapter is a command that is called in an empty folder as
  COMMAND check SOURCE                                     accept or reject one source
  COMMAND run SOURCE CYCLES INTERVAL_MS WATCH [INPUTS]     run a source for a number of cycles, print a trace
  COMMAND restart SOURCE CYCLES INTERVAL_MS WATCH INPUTS FIRST
                                    run FIRST cycles with the inputs, start warm, and run CYCLES without inputs, of which
                                    the trace is; INPUTS is - when there are none
It exits with 0: accepted, or run; 1: rejected, with messages on stderr, best as `file:line: text`; 3: this adapter cannot
try such a source. Anything else, or a signal, is a crash. WATCH is a file with one path a line; the trace goes to stdout
as CSV: header `cycle,PATH,...`, one row after each cycle, further columns are ignored.

Exit codes: 0 all cases are supported, or with --baseline none is worse; 1 some are not; 2 usage.
Needs nothing but Python 3.7.
"""
import argparse
import concurrent.futures
import csv
import fnmatch
import html
import io
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.sax.saxutils as saxutils

VERDICTS = ['supported', 'wrong', 'rejected', 'crashed', 'untried']
WORST = {'supported': 0, 'untried': 1, 'rejected': 2, 'wrong': 3, 'crashed': 4}


# ---- values of a trace

def same(expected, actual):
    """Whether two cells show the same value: numbers compare as numbers, words without regard to case."""
    expected, actual = expected.strip(), actual.strip()
    if expected == actual or expected == '':
        return True
    words = {'TRUE': '1', 'FALSE': '0'}
    left, right = words.get(expected.upper(), expected), words.get(actual.upper(), actual)
    try:
        return float(left) == float(right)
    except ValueError:
        return left.upper() == right.upper() and not expected.startswith(("'", '"'))


def rows_of(text):
    """The rows of a trace by cycle, and its header in upper case."""
    lines = [row for row in csv.reader(io.StringIO(text)) if row]
    if not lines:
        return [], {}
    header = [cell.strip().upper() for cell in lines[0]]
    if 'CYCLE' not in header:
        return header, {}
    at = header.index('CYCLE')
    return header, {row[at].strip(): row for row in lines[1:] if len(row) == len(header)}


def compare_traces(expected, actual):
    """None, or the first difference."""
    expected_header, expected_rows = rows_of(expected)
    header, rows = rows_of(actual)
    if not header:
        return 'no trace'
    for name in expected_header:
        if name not in header:
            return 'the trace has no column %s' % name
    for cycle, row in expected_rows.items():
        if cycle not in rows:
            return 'the trace has no row for cycle %s' % cycle
        for name, value in zip(expected_header, row):
            got = rows[cycle][header.index(name)]
            if name != 'CYCLE' and not same(value, got):
                return 'cycle %s: %s is %s, due is %s' % (cycle, name.lower(), got, value)
    return None


# ---- one case

class Adapter:
    def __init__(self, command, timeout):
        # The adapter runs in another folder: what names a file here must name it there.
        self.command = [os.path.abspath(word) if os.sep in word and os.path.exists(word) else word
                        for word in shlex.split(command)]
        self.timeout = timeout

    def call(self, arguments, folder):
        """Exit code (None: ran too long), stdout, stderr. A new session, so that all it started ends with it."""
        process = subprocess.Popen(self.command + arguments, cwd=folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        try:
            out, err = process.communicate(timeout=self.timeout)
            code = process.returncode
        except subprocess.TimeoutExpired:
            code = None
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass
        if code is None:
            out, err = process.communicate()
        return code, out.decode('utf-8', 'replace'), err.decode('utf-8', 'replace')


def short(text, most=600):
    text = text.strip()
    return text if len(text) <= most else text[:most] + ' ...'


def verdict_of(code, err):
    """The verdict for an exit code other than 0."""
    if code is None:
        return 'crashed', 'ran too long'
    if code == 1:
        return 'rejected', short(err)
    if code == 3:
        return 'untried', short(err)
    return 'crashed', ('signal %d' % -code if code < 0 else 'exit code %d' % code) + (': ' + short(err) if err.strip() else '')


def failed_checks(case, difference):
    """A check that failed, in the words of the source."""
    found = re.match(r'cycle \d+: (\S+) is 2', difference)
    names = [path.lower() for path in case.get('watch', [])]
    if found and found.group(1) in names and case.get('checks'):
        return '%s: `%s` does not hold' % (found.group(1).split('.')[-1], case['checks'][names.index(found.group(1))])
    return difference


def run_case(suite, adapter, case, folder):
    source = os.path.join(suite, case['source'])
    watch = os.path.join(folder, 'watch.txt')
    with open(watch, 'w', encoding='utf-8') as file:
        file.write(''.join(path + '\n' for path in case['watch']))
    arguments = ['run', source, str(case['cycles']), str(case['interval_ms']), watch]
    if 'inputs' in case:
        arguments.append(os.path.join(suite, case['inputs']))
    if 'restart_after' in case:
        arguments = ['restart'] + arguments[1:] + ([] if 'inputs' in case else ['-']) + [str(case['restart_after'])]
    code, out, err = adapter.call(arguments, folder)
    if code != 0:
        return verdict_of(code, err)
    with open(os.path.join(suite, case['trace']), encoding='utf-8') as file:
        difference = compare_traces(file.read(), out)
    return ('supported', '') if difference is None else ('wrong', failed_checks(case, difference))


def reject_case(suite, adapter, case, folder):
    """An error is due, and the same source without it is accepted: who rejects everything supports nothing."""
    code, _, err = adapter.call(['check', os.path.join(suite, case['control'])], folder)
    if code != 0:
        verdict, detail = verdict_of(code, err)
        return verdict, 'without the error: ' + detail
    code, _, err = adapter.call(['check', os.path.join(suite, case['source'])], folder)
    if code == 0:
        return 'wrong', 'the error of line %d is not noticed: %s' % (case['line'], case['rule'])
    if code != 1:
        return verdict_of(code, err)
    at_line = re.search(r'(?<![\d])%d(?![\d])' % case['line'], err)
    return 'supported', '' if at_line else 'the message does not name line %d' % case['line']


def try_case(suite, adapter, case):
    folder = tempfile.mkdtemp(prefix='conformance.')
    begin = time.time()
    try:
        verdict, detail = (run_case if case['kind'] == 'run' else reject_case)(suite, adapter, case, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return {'id': case['id'], 'verdict': verdict, 'detail': detail, 'seconds': round(time.time() - begin, 3)}


# ---- rows of features

def rows_by_feature(manifest, results):
    """For each row: its cases' verdicts and the row's own, which is the worst of them."""
    by_id = {result['id']: result for result in results}
    rows = []
    for feature in manifest['features']:
        mine = [by_id[case['id']] for case in manifest['cases'] if feature['id'] in case['features'] and case['id'] in by_id]
        if not mine:
            continue
        counts = {verdict: sum(one['verdict'] == verdict for one in mine) for verdict in VERDICTS}
        rows.append({'id': feature['id'], 'name': feature['name'], 'table': feature['table'], 'counts': counts,
                     'verdict': max((one['verdict'] for one in mine), key=WORST.get)})
    return rows


def text_table(rows, quiet):
    lines = []
    table = None
    for row in rows:
        if quiet and row['verdict'] == 'supported':
            continue
        if row['table'] != table:
            table = row['table']
            lines.append(table)
        counts = row['counts']
        others = ', '.join('%d %s' % (counts[v], v) for v in VERDICTS[1:] if counts[v])
        lines.append('  %-9s %-9s %3d of %3d  %s%s' % (row['id'], row['verdict'], counts['supported'], sum(counts.values()),
                                                   row['name'], '  (%s)' % others if others else ''))
    return '\n'.join(lines)


def summary(rows, results):
    def count(things):
        return ', '.join('%d %s' % (n, v) for v in VERDICTS for n in [sum(t['verdict'] == v for t in things)] if n or v in VERDICTS[:4])
    return 'cases: %s\nrows: %s' % (count(results), count(rows))


# ---- reports

STYLE = """body{font:14px sans-serif;margin:2em}table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:2px 8px;
text-align:left;vertical-align:top}.supported{background:#d8f0d8}.wrong{background:#f8d0d0}.rejected{background:#f8ecc8}
.crashed{background:#e0c0e8}.untried{background:#eee}h2{font-size:1.1em;margin-top:1.5em}"""


def html_page(title, body):
    return '<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>%s</title><style>%s</style>\n<h1>%s</h1>\n%s</html>\n' % (
        html.escape(title), STYLE, html.escape(title), body)


def html_rows(names, tables):
    """tables: for each implementation its rows, and notes for rows that are not supported."""
    order, known = [], {}
    for rows, _ in tables:
        for row in rows:
            if row['id'] not in known:
                order.append(row['id'])
                known[row['id']] = row
    body, table = '', None
    for feature in order:
        if known[feature]['table'] != table:
            body += '</table>\n' if table is not None else ''
            table = known[feature]['table']
            body += '<h2>%s</h2>\n<table><tr><th>row</th><th>feature</th>%s</tr>\n' % (
                html.escape(table), ''.join('<th>%s</th>' % html.escape(name) for name in names))
        cells = ''
        for rows, notes in tables:
            row = next((row for row in rows if row['id'] == feature), None)
            if row is None:
                cells += '<td></td>'
                continue
            title = html.escape('\n'.join(notes.get(feature, [])[:8]), quote=True)
            cells += '<td class="%s" title="%s">%s, %d of %d</td>' % (
                row['verdict'], title, row['verdict'], row['counts']['supported'], sum(row['counts'].values()))
        body += '<tr><td>%s</td><td>%s</td>%s</tr>\n' % (html.escape(feature), html.escape(known[feature]['name']), cells)
    return body + ('</table>\n' if table is not None else '')


def notes_of(report):
    notes = {}
    for result in report['results']:
        if result['verdict'] != 'supported':
            for feature in result['features']:
                notes.setdefault(feature, []).append('%s: %s: %s' % (result['id'], result['verdict'], result['detail']))
    return notes


def html_report(report):
    counts = '<p>%s</p>\n' % html.escape(summary(report['rows'], report['results'])).replace('\n', '<br>')
    cases = ''.join('<tr class="%s"><td>%s</td><td>%s</td><td>%s</td></tr>\n' % (
        r['verdict'], html.escape(r['id']), r['verdict'], html.escape(r['detail']).replace('\n', '<br>'))
        for r in report['results'] if r['verdict'] != 'supported')
    return html_page('Conformance of ' + report['name'],
                     counts + html_rows([report['name']], [(report['rows'], notes_of(report))]) +
                     '<h2>Cases that are not supported</h2>\n<table>' + cases + '</table>\n')


def junit(report):
    def quote(text):
        return saxutils.quoteattr(re.sub('[\x00-\x08\x0b\x0c\x0e-\x1f]', '?', text))
    failed = sum(r['verdict'] in ('wrong', 'rejected') for r in report['results'])
    crashed = sum(r['verdict'] == 'crashed' for r in report['results'])
    skipped = sum(r['verdict'] == 'untried' for r in report['results'])
    out = '<?xml version="1.0" encoding="UTF-8"?>\n<testsuite name=%s tests="%d" failures="%d" errors="%d" skipped="%d">\n' % (
        quote(report['name']), len(report['results']), failed, crashed, skipped)
    for r in report['results']:
        element = {'supported': '', 'wrong': 'failure', 'rejected': 'failure', 'crashed': 'error', 'untried': 'skipped'}[r['verdict']]
        inside = '<%s message=%s/>' % (element, quote(r['verdict'] + ': ' + r['detail'])) if element else ''
        out += '<testcase classname=%s name=%s time="%s">%s</testcase>\n' % (
            quote(r['id'].split('/')[0]), quote(r['id']), r['seconds'], inside)
    return out + '</testsuite>\n'


def side_by_side(reports):
    width = max(len(report['name']) for report in reports + [{'name': 'supported'}])
    known, order = {}, []
    for report in reports:
        for row in report['rows']:
            if row['id'] not in known:
                order.append(row['id'])
            known.setdefault(row['id'], {})[report['name']] = row
    lines = ['%-9s ' % 'row' + ' '.join('%-*s' % (width, report['name']) for report in reports) + ' feature']
    for feature in order:
        rows = known[feature]
        if len(rows) == len(reports) and all(row['verdict'] == 'supported' for row in rows.values()):
            continue
        words = [rows[report['name']]['verdict'] if report['name'] in rows else '-' for report in reports]
        name = next(iter(rows.values()))['name']
        lines.append('%-9s ' % feature + ' '.join('%-*s' % (width, word) for word in words) + ' ' + name)
    for verdict in VERDICTS:
        lines.append('%-9s ' % verdict + ' '.join(
            '%-*d' % (width, sum(row['verdict'] == verdict for row in report['rows'])) for report in reports).rstrip())
    return '\n'.join(lines)


# ---- commands

def write(path, text):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)


def stop(message):
    """Usage or I/O."""
    sys.stderr.write('conformance.py: %s\n' % message)
    sys.exit(2)


def read_json(path):
    try:
        with open(path, encoding='utf-8') as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        stop('%s: %s' % (path, error))


def regressions(baseline, results):
    """Cases that are worse than they were, in words."""
    before = baseline['cases']
    return ['%s: was %s, is %s: %s' % (r['id'], before[r['id']], r['verdict'], r['detail']) for r in results
            if r['id'] in before and WORST[r['verdict']] > WORST[before[r['id']]]]


def command_run(options):
    manifest = read_json(os.path.join(options.suite, 'manifest.json'))
    cases = [case for case in manifest['cases']
             if (not options.profile or case['profile'] in options.profile)
             and (not options.case or any(fnmatch.fnmatch(case['id'], glob) for glob in options.case))
             and (not options.feature or set(options.feature) & set(case['features']))]
    if not cases:
        stop('no case matches')
    adapter = Adapter(options.adapter, options.timeout)
    if shutil.which(adapter.command[0]) is None:
        stop('cannot start %s: No such file or directory' % adapter.command[0])
    suite = os.path.abspath(options.suite)
    results = []
    with concurrent.futures.ThreadPoolExecutor(max_workers=options.jobs) as pool:
        for case, result in zip(cases, pool.map(lambda one: try_case(suite, adapter, one), cases)):
            results.append(dict(result, features=case['features']))
            if sys.stderr.isatty():
                sys.stderr.write('\r%d of %d' % (len(results), len(cases)))
    if sys.stderr.isatty():
        sys.stderr.write('\r')
    rows = rows_by_feature(manifest, results)
    report = {'name': options.name or os.path.basename(shlex.split(options.adapter)[0]), 'adapter': options.adapter,
              'rows': rows, 'results': results}
    if options.json:
        write(options.json, json.dumps(report, indent=1) + '\n')
    if options.html:
        write(options.html, html_report(report))
    if options.junit:
        write(options.junit, junit(report))
    if options.baseline:
        worse = regressions(read_json(options.baseline), results)
        print('\n'.join(worse) if worse else 'nothing is worse than the baseline')
        return 1 if worse else 0
    table = text_table(rows, options.quiet)
    if table:
        print(table)
    if options.verbose:
        for r in results:
            if r['verdict'] != 'supported':
                print('%s: %s: %s' % (r['id'], r['verdict'], r['detail'].replace('\n', '\n    ')))
    print(summary(rows, results))
    return 0 if all(r['verdict'] in ('supported', 'untried') for r in results) else 1


def command_compare(options):
    reports = [read_json(path) for path in options.results]
    print(side_by_side(reports))
    if options.html:
        write(options.html, html_page('Conformance, side by side',
                                      html_rows([r['name'] for r in reports], [(r['rows'], notes_of(r)) for r in reports])))
    return 0


def command_baseline(options):
    report = read_json(options.results)
    write(options.output, json.dumps({'name': report['name'], 'cases': {r['id']: r['verdict'] for r in report['results']}},
                                     indent=1, sort_keys=True) + '\n')
    return 0


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0],
                                     epilog='\n'.join(__doc__.split('\n')[1:]),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest='command')
    run = commands.add_parser('run', help='run the suite with one adapter')
    run.add_argument('--adapter', required=True, help='the command of the adapter, with its options')
    run.add_argument('--suite', default=here, help='the exported folder; default: that of this program')
    run.add_argument('--name', help='of the compiler, in reports')
    run.add_argument('--profile', action='append', help='only cases of this profile')
    run.add_argument('--case', action='append', help='only cases whose id matches')
    run.add_argument('--feature', action='append', help='only cases that prove this row')
    run.add_argument('-j', dest='jobs', type=int, default=os.cpu_count() or 1, help='cases at a time')
    run.add_argument('--timeout', type=float, default=30, help='seconds for one call of the adapter')
    run.add_argument('--json')
    run.add_argument('--html')
    run.add_argument('--junit')
    run.add_argument('--baseline', help='report only what is worse than in this file')
    run.add_argument('-q', dest='quiet', action='store_true', help='no rows that are supported')
    run.add_argument('-v', dest='verbose', action='store_true', help='also each case that is not supported')
    compare = commands.add_parser('compare', help='several results side by side')
    compare.add_argument('results', nargs='+')
    compare.add_argument('--html')
    baseline = commands.add_parser('baseline', help='make a baseline from results')
    baseline.add_argument('results')
    baseline.add_argument('-o', dest='output', required=True)
    options = parser.parse_args()
    if options.command is None:
        parser.print_help()
        return 2
    return {'run': command_run, 'compare': command_compare, 'baseline': command_baseline}[options.command](options)


if __name__ == '__main__':
    sys.exit(main())

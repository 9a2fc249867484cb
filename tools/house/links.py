#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Dead links of Markdown files: links.py

Each relative link points to an existing file, its anchor to a heading of that file (as code hosts and tools/site make
anchors), and each back-quoted path of a project file in README, CONTRIBUTING and docs/ exists. Prints those that do not;
exit code 1 if there are any. Called by tools/house/checks/links.sh.
"""
import functools, os, re, subprocess, sys

LINK = re.compile(r'\]\(([^) ]+)\)')
PATH = re.compile(r'`((?:frontend|sema|ir|codegen|stdlib|cam|tools|tests|samples|cmake)/[A-Za-z0-9_./-]+\.[a-z]+)`')


def lines_without_code(text):
    """(number, line) outside of fenced blocks."""
    fenced = False
    for number, line in enumerate(text.split('\n'), 1):
        if line.lstrip().startswith('```'):
            fenced = not fenced
        elif not fenced:
            yield number, line


@functools.cache
def anchors(path):
    seen, found = {}, set()
    for _, line in lines_without_code(open(path, encoding='utf-8').read()):
        heading = re.match(r'#{1,6} +(.*)', line)
        if not heading:
            continue
        text = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', heading[1]).strip().lower()
        slug = re.sub(r'[^\w\- ]', '', text.replace('`', '')).replace(' ', '-')
        count = seen.get(slug, 0)
        seen[slug] = count + 1
        found.add(f'{slug}-{count}' if count else slug)
    return found


def problems(path):
    text = open(path, encoding='utf-8').read()
    for number, line in enumerate(text.split('\n'), 1):
        for target in LINK.findall(line):
            if re.match(r'(https?|mailto)(:|$)', target):
                continue
            file, _, anchor = target.partition('#')
            file = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            if not os.path.exists(file):
                yield f'{path}:{number}: dead link to {file}'
            elif anchor and file.endswith('.md') and anchor not in anchors(file):
                yield f'{path}:{number}: {file} has no heading for #{anchor}'
        if re.match(r'docs/|README|CONTRIBUTING', path):
            for file in PATH.findall(line):
                if not os.path.exists(file):
                    yield f'{path}:{number}: there is no {file}'


def main():
    os.chdir(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..'))
    files = subprocess.run(['tools/house/tracked', '.md'], capture_output=True, text=True, check=True).stdout.split('\n')
    found = [problem for path in files if path for problem in problems(path)]
    print('\n'.join(found), end='\n' if found else '')
    sys.exit(1 if found else 0)


main()

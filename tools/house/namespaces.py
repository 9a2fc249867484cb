#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Namespaces are named as folders: namespaces.py

Each C++ file of the compiler, the tools and the host opens the namespace of its folder: rung::<folder>, or what the table
says. Besides it a file may open rung::diag for its messages, and another one to declare classes that it only names.
Prints files that open something else; exit code 1 if there are any. Called by tools/house/checks/namespaces.sh.
"""
import re
import sys

from sources import read, tracked

# Folders of which the namespace has another name, the longest path first. A keyword of C++ cannot be a name (export,
# import), nor can what a function of rung is called (render).
NAMES = {
    'cam': ['rung::cam'],
    'codegen': ['rung::codegen'],
    'frontend/export': ['rung::exporter', 'rung::xml'],
    'frontend/format': ['rung::format'],
    'frontend/import': ['rung::importer', 'rung::xml'],
    'frontend/import/cam': ['rung::importer::cams'],
    'frontend/parse': ['rung::text'],
    'frontend/render': ['rung::picture'],
    'frontend/schedule': ['rung::diagram', 'rung::text', 'rung'],
    'frontend/source': ['rung'],
    'frontend/syntax': ['rung'],
    'ir': ['rung::ir'],
    'ir/interpreter': ['rung::ir::interpreter'],
    'ir/lower': ['rung::ir'],
    'ir/passes': ['rung::ir'],
    'sema': ['rung::sema'],
    'sema/types': ['rung::types'],
    'stdlib/motion': ['rung::motion'],
    'stdlib/motion/fieldbus': ['rung::fieldbus'],
    'stdlib/motion/profile': ['rung::motion::planning', 'rung::motion'],
    'stdlib/nct/control': ['rung::nct'],
    'stdlib/runtime/host': ['rung::host'],
    'tools/native_table': ['rung::natives'],
    'tools/rung': ['rung::tool'],
    'tools/rung/static_loading.cpp': ['rung::driver'],  # in place of a function of the driver
}
IN_PARENT = {'frontend/import': 'rung::importer'}  # a folder of this one adds its own name
CHECKED = re.compile(r'(cam|codegen|frontend|ir|sema|tools|stdlib/motion|stdlib/nct/control|stdlib/runtime/host)/')
NAMESPACE = re.compile(r'^namespace (rung[\w:]*) \{\n(.*?)^\}', re.S | re.M)
FORWARD = re.compile(r'\s*((//.*|(class|struct|union|enum)\b[^{}]*;|template <[^<>]*>|namespace \w+ \{|\}.*)?\n\s*)*', re.S)


def names_of(folder):
    at = folder
    while at:
        if at in NAMES:
            if at != folder and at in IN_PARENT:
                return [IN_PARENT[at] + folder[len(at):].replace('/', '::')]
            return NAMES[at]
        at = at.rpartition('/')[0]
    return ['rung::' + folder.rpartition('/')[2]]


def main():
    bad = 0
    for path in tracked('.cpp', '.h'):
        if not CHECKED.match(path):
            continue
        wanted = NAMES.get(path) or names_of(path.rpartition('/')[0])
        for name, body in NAMESPACE.findall(read(path)):
            opens = any(name == w or name.startswith(w + '::') for w in wanted) and name != 'rung' or name in wanted
            if opens or name == 'rung::diag' or FORWARD.fullmatch(body):
                continue
            print(f'{path}: opens {name}; its folder has {" or ".join(wanted)}')
            bad = 1
    sys.exit(bad)


main()

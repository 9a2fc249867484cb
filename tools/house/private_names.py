# SPDX-License-Identifier: Apache-2.0
"""Looks for names in unnamed namespaces, and of static functions, that a unity build confuses: tools/quickstart.sh
compiles the files of one CMake target together. Two files of a target declare the same name, functions with parameters
for which the same numbers fit; or one declares a name that a header in an enclosing namespace has, and hides it from the
unnamed namespaces of all files.
Called by checks/private_names.sh."""
import collections
import functools
import os
import re
import sys

from sources import ROOT, code_only, read, tracked

TEMPLATE = re.compile(r"template <(?:[^<>]|<[^<>]*>)*> ?(?:requires .*?\) )?")
TYPE = re.compile(r"(?:struct|class|enum class|enum|union) (\w+)")
FUNCTION = re.compile(r"(?:[\w:<>,*&\[\]]+ )+?[*&]*(\w+)\((.*)\)")
VARIABLE = re.compile(r"(?:(?:constexpr|const|static|inline|thread_local|[\w:<>,*&]+) )+[*&]*([A-Za-z_]\w*)(?:\[[^\]]*\])* ?(?:=|\{|$)")
NAMESPACE = re.compile(r"(?:inline )?namespace ?([\w:]*)")
LINKAGE = re.compile(r"extern")
DEFAULT = re.compile(r" = [^,]*")
NUMBER = re.compile(r"\b(?:const )?(?:bool|u?int\d*(?:_t)?|size_t|unsigned|double|float)\b")  # a literal fits all of them
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)

HOST = ("stdlib/runtime/host/", "stdlib/nct/control/")  # one target
WHOLE = ("frontend/import", "frontend/source", "codegen", "sema")  # targets with the folders below them
INCLUDE_FOLDERS = ("", "stdlib/runtime/include", "stdlib/runtime")

# `scope` are the namespaces around it, "" is an unnamed one; `parameters` is None for types and variables.
Declaration = collections.namedtuple("Declaration", "scope name parameters")


def target_of(path):
    """The folder whose sources are compiled into one target."""
    if path.startswith("sema/types/"):
        return "sema/types"
    for folder in WHOLE:
        if path.startswith(folder + "/"):
            return folder
    return os.path.dirname(path)


@functools.cache
def declarations(path):
    """What stands directly in a namespace of the file."""
    source = code_only(read(path))
    found, scope = [], []
    begin, depth = 0, 0  # depth counts the braces of a body; namespaces are in `scope`
    for mark in re.finditer(r"[{};]", source):
        if mark.group() == "}":
            if depth > 0:
                depth -= 1
            elif scope:
                scope.pop()
            begin = mark.end()
            continue
        if depth == 0:
            head = " ".join(source[begin:mark.start()].split())
            begin = mark.end()
            opened = NAMESPACE.fullmatch(head)
            if mark.group() == "{" and (opened or LINKAGE.fullmatch(head)):
                scope.append(opened.group(1).split("::") if opened else [])
                continue
            around = tuple(name for names in scope for name in names)
            if re.match(r"(?:template <.*> ?)?static ", head) and "" not in around:
                around += ("",)  # private, too
            found += [Declaration(around, name, parameters) for name, parameters in declared(head, mark.group())]
        depth += mark.group() == "{"
    return found


def declared(head, end):
    """(name, parameters) of a declaration that `end` follows."""
    head = TEMPLATE.sub("", re.sub(r"\[\[\w+\]\] ?", "", head)).strip()
    before_value = head.split("=")[0]
    if NAMESPACE.match(head):
        return
    if match := TYPE.match(head):
        if "(" not in before_value and end == "{":
            yield match.group(1), None
    elif match := re.match(r"using (\w+) =", head):
        yield match.group(1), None
    elif match := FUNCTION.match(DEFAULT.sub("", head)):
        yield match.group(1), re.sub(r" ?\w+(?= ?(?:,|$))", "", match.group(2))
    elif match := VARIABLE.match(head):
        yield match.group(1), None
        for further in re.finditer(r", (\w+) = ", head):
            yield further.group(1), None


@functools.cache
def included(path):
    """The project's headers that a file includes itself."""
    folders = (os.path.dirname(path), *INCLUDE_FOLDERS)
    candidates = ([os.path.join(folder, header) for folder in folders] for header in INCLUDE.findall(read(path)))
    return [next(c for c in some if is_file(c)) for some in candidates if any(map(is_file, some))]


@functools.cache
def is_file(path):
    return os.path.isfile(os.path.join(ROOT, path))


def headers_of(paths):
    """All headers that these files include, directly or not."""
    seen, pending = set(), list(paths)
    while pending:
        for header in included(pending.pop()):
            if header not in seen:
                seen.add(header)
                pending.append(header)
    return seen


def repeated(files):
    """Names that unnamed namespaces of two of these files declare."""
    places = collections.defaultdict(set)
    for path in files:
        for declaration in declarations(path):
            if "" in declaration.scope:
                parameters = declaration.parameters and NUMBER.sub("number", declaration.parameters)
                places[declaration.scope, declaration.name].add((path, parameters))
    for (_, name), found in sorted(places.items()):
        kinds = {parameters for _, parameters in found}
        clash = None in kinds and len({path for path, _ in found}) > 1
        if clash or any(len({path for path, p in found if p == parameters}) > 1 for parameters in kinds):
            yield f"`{name}` is declared in the unnamed namespaces of {', '.join(sorted({path for path, _ in found}))}"


def hiding(files):
    """Names in unnamed namespaces of these files that hide one of a header that any of them includes."""
    public = collections.defaultdict(list)
    for header in headers_of(files):
        for declaration in declarations(header):
            if "" not in declaration.scope:
                public[declaration.name].append((header, declaration))
    for path in files:
        for private in declarations(path):
            if "" not in private.scope:
                continue
            around = private.scope[:private.scope.index("")]
            for header, other in public[private.name]:
                if other.scope == around[:len(other.scope)]:
                    yield f"{path}: `{private.name}` in its unnamed namespace hides that of {header}"


def main():
    targets = collections.defaultdict(list)
    for path in tracked(".cpp"):
        if path.startswith(HOST):
            targets["host"].append(path)
        elif not path.startswith(("tests/", "stdlib/")):  # programs of their own, and a library that is linked file by file
            targets[target_of(path)].append(path)
    found = [line for _, files in sorted(targets.items()) for line in (*repeated(files), *sorted(set(hiding(files))))]
    print(*found, sep="\n", end="\n" if found else "")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: Apache-2.0
"""Looks for names that two files of one CMake target declare in unnamed namespaces: a unity build, which
tools/quickstart.sh makes, compiles such files together. Functions may share a name when their parameters differ.
Called by checks/private_names.sh."""
import collections
import re
import sys

from sources import code_only, read, tracked

TEMPLATE = re.compile(r"template <(?:[^<>]|<[^<>]*>)*> ?(?:requires .*?\) )?")
TYPE = re.compile(r"(?:struct|class|enum class|enum|union) (\w+)")
FUNCTION = re.compile(r"(?:[\w:<>,*&\[\]]+ )+?[*&]*(\w+)\((.*)\)")
VARIABLE = re.compile(r"(?:(?:constexpr|const|static|inline|thread_local|[\w:<>,*&]+) )+[*&]*([A-Za-z_]\w*)(?:\[[^\]]*\])* ?(?:=|\{|$)")

HOST = ("stdlib/runtime/host/", "stdlib/nct/control/")  # one target


def target_of(path):
    """The folder whose sources are compiled into one target."""
    parts = path.split("/")
    if parts[0] == "frontend":
        return "/".join(parts[:2])
    if parts[0] == "sema":
        return "sema/types" if parts[1] == "types" else "sema"
    if parts[0] == "ir":
        return "/".join(parts[:2]) if parts[1] in ("lower", "interpreter") else "ir"
    return "/".join(parts[:-1])


def private_declarations(source):
    """(name, parameters) of what stands directly in an unnamed namespace; parameters is None of types and variables."""
    source = code_only(source)
    for opening in re.finditer(r"\bnamespace\s*\{", source):
        at, depth, begin = opening.end(), 0, opening.end()
        while at < len(source) and not (depth == 0 and source[at] == "}"):
            if source[at] == "{" or source[at] == ";":
                if depth == 0:
                    yield from declaration(" ".join(source[begin:at].split()))
                    begin = at + 1
                depth += source[at] == "{"
            elif source[at] == "}":
                depth -= 1
                begin = at + 1
            at += 1


def declaration(head):
    head = TEMPLATE.sub("", re.sub(r"\[\[\w+\]\] ?", "", head)).strip()
    before_value = head.split("=")[0]
    if head.startswith("namespace "):
        return
    if match := TYPE.match(head):
        if "(" not in before_value:
            yield match.group(1), None
    elif match := re.match(r"using (\w+) =", head):
        yield match.group(1), None
    elif match := FUNCTION.match(before_value):
        yield match.group(1), re.sub(r" ?\w+(?= ?(?:,|$))", "", match.group(2))
    elif match := VARIABLE.match(head):
        yield match.group(1), None
        for further in re.finditer(r", (\w+) = ", head):
            yield further.group(1), None


def main():
    names = collections.defaultdict(set)
    for path in tracked(".cpp"):
        if path.startswith(("tests/", "stdlib/")) and not path.startswith(HOST):
            continue  # programs of their own, and a library of which products link single files
        for name, parameters in private_declarations(read(path)):
            names[target_of(path), name].add((path, parameters))
    bad = 0
    for (_, name), places in sorted(names.items()):
        kinds = collections.Counter(parameters for _, parameters in places)
        clash = None in kinds and len({path for path, _ in places}) > 1
        clash = clash or any(len({path for path, p in places if p == parameters}) > 1 for parameters in kinds)
        if clash:
            print(f"`{name}` is declared in the unnamed namespaces of {', '.join(sorted({path for path, _ in places}))}")
            bad = 1
    return bad


if __name__ == "__main__":
    sys.exit(main())

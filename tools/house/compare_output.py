#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Compares what two versions of `rung` make of every program of the suite: C++, IR, tree, traces, pictures, ST and XML.
#   tools/house/compare_output.py OLD_RUNG NEW_RUNG [--old-root DIR] [--substitutions FILE] [-j N]
# OLD_RUNG compiles the sources below --old-root (a checkout of its version; default: this one), so that each version
# reads its own test programs. FILE has lines `regular expression<TAB>replacement`; each is listed with how often it
# acted on what the old version gives (it is applied to both, so that a pattern can also hide what does not count). Diagnostics are not compared: their wording is tested by golden files.
import argparse
import collections
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
FOLDERS = ("tests/conformance", "tests/golden/tree", "tests/golden/cpp", "tests/golden/svg", "tests/programs", "samples")
ENDINGS = (".st", ".xml", ".TcPOU", ".tsproj", ".plcproj", ".EXP", ".exp")
KINDS = ("cpp", "ir", "tree", "st", "xml", "svg", "trace")


def projects(root):
    """Single files, and folders with a rung.project or a sample of several files."""
    for folder in FOLDERS:
        for path, folders, files in os.walk(os.path.join(root, folder)):
            folders.sort()
            relative = os.path.relpath(path, root)
            if "rung.project" in files:
                yield relative
            for file in sorted(files):
                if file.endswith(ENDINGS):
                    yield os.path.join(relative, file)


def options_of(root, project):
    """--std of the test's `// options:` or `// run:` line."""
    path = os.path.join(root, project)
    if not os.path.isfile(path):
        return []
    with open(path, encoding="utf-8", errors="replace") as file:
        return re.findall(r"--(?:std|checks|native-width)=\S+", file.read(2000))[:3]


def command(rung, root, project, kind, out):
    options = options_of(root, project)
    if kind in ("cpp", "ir", "tree"):
        return [rung, "emit", project, *(["-o", out] if kind == "cpp" else []), f"--emit={kind}", *options]
    if kind in ("st", "xml"):
        return [rung, "convert", project, "--to", kind, "-o", out, *options]
    if kind == "svg":
        return [rung, "graph", project, "-o", out, *options]
    return [rung, "run", project, "--cycles", "20", "--engine=interp", "--trace", os.path.join(out, "trace.csv"), *options]


def output_of(rung, root, project, kind, times):
    """Path in the output -> content; the exit code of a run counts as content."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        os.mkdir(out)
        try:
            done = subprocess.run(command(rung, root, project, kind, out), cwd=root, timeout=times,
                                  text=True, errors="replace",
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return {"timeout": ""}
        files = {"exit code": str(done.returncode), "stdout": done.stdout}
        paths = [out] if os.path.isfile(out) else [os.path.join(path, name) for path, _, names in os.walk(out)
                                                   for name in names]
        for path in paths:
            with open(path, encoding="utf-8", errors="replace") as file:
                files[os.path.relpath(path, out)] = file.read()
        return files


class Substitutions:
    def __init__(self, path):
        self.rules = []
        self.counts = collections.Counter()
        if path:
            for line in open(path, encoding="utf-8"):
                if line.strip() and not line.startswith("#"):
                    pattern, replacement = line.rstrip("\n").split("\t")
                    self.rules.append((re.compile(pattern, re.M), pattern, replacement))

    def apply(self, content, count=True):
        for regex, pattern, replacement in self.rules:
            content, times = regex.subn(replacement, content)
            self.counts[f"{pattern}  ->  {replacement}"] += times if count else 0
        return content


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--old-root", default=ROOT)
    parser.add_argument("--substitutions")
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--show", type=int, default=5, help="how many differences are shown of each kind")
    parser.add_argument("-j", type=int, default=os.cpu_count())
    options = parser.parse_args()
    old, new = os.path.realpath(options.old), os.path.realpath(options.new)
    old_root = os.path.realpath(options.old_root)
    substitutions = Substitutions(options.substitutions)
    # The old version reads its own libraries, which are built into it; both read the programs of this checkout.
    jobs = [(project, kind) for project in projects(ROOT) for kind in options.kinds.split(",")]

    def compare(job):
        project, kind = job
        return job, output_of(old, old_root, project, kind, 60), output_of(new, ROOT, project, kind, 60)

    compared, with_content, different = collections.Counter(), collections.Counter(), collections.defaultdict(list)
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        for (project, kind), before, after in pool.map(compare, jobs):
            compared[kind] += 1
            with_content[kind] += len(after) > 2 or bool(after.get("stdout"))
            before = {path: substitutions.apply(content) for path, content in before.items()}
            after = {path: substitutions.apply(content, count=False) for path, content in after.items()}
            for path in sorted(before.keys() | after.keys()):
                if before.get(path) != after.get(path):
                    different[kind].append((project, path, before.get(path), after.get(path)))

    for kind in options.kinds.split(","):
        print(f"{kind:6} {compared[kind]:5} programs, {with_content[kind]:5} with output, {len(different[kind])} files differ")
        for project, path, before, after in different[kind][:options.show]:
            print(f"  {project}: {path}")
            old_lines, new_lines = (before or "").split("\n"), (after or "").split("\n")
            for a, b in zip(old_lines, new_lines):
                if a != b:
                    print(f"    - {a[:150]}\n    + {b[:150]}")
                    break
    for rule, count in substitutions.counts.items():
        print(f"substituted {count:6} times: {rule}")
    return 1 if any(different.values()) else 0


if __name__ == "__main__":
    sys.exit(main())

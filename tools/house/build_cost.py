#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# What a build of Rung costs: CPU seconds of a clean build of the `rung` target, its dearest units, the headers that cost
# most, and how many units rebuild after a change of each of the most included headers.
#   tools/house/build_cost.py [--unity] [--target NAME]     takes a few minutes; builds in a folder of its own
# Not one of the checks of tools/precommit.sh.
import argparse
import collections
import os
import re
import resource
import subprocess
import tempfile

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))


def run(*command, **options):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, **options).stdout


def cpu_of(*command):
    """CPU seconds of a command and all its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(*command)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def unit_times(folder):
    """(seconds, unit) of each compilation that ninja logged, dearest first."""
    times = {}
    for line in open(os.path.join(folder, ".ninja_log")):
        fields = line.rstrip("\n").split("\t")
        if len(fields) == 5 and fields[3].endswith(".o"):
            times[fields[3]] = (int(fields[1]) - int(fields[0])) / 1000
    return sorted(((seconds, unit) for unit, seconds in times.items()), reverse=True)


def dependencies(folder):
    """The project's headers that each unit reads."""
    units, unit = {}, None
    for line in run("ninja", "-C", folder, "-t", "deps").splitlines():
        if not line.startswith(" "):
            unit = line.split(":")[0]
            units[unit] = []
        elif line.strip():
            path = os.path.realpath(os.path.join(folder, line.strip()))
            if path.startswith(ROOT + os.sep) and not path.startswith(folder + os.sep):
                units[unit].append(os.path.relpath(path, ROOT))
    return units


def preprocessed_lines(headers):
    """How many lines each header brings when it is included alone, without the precompiled header."""
    include = [f"-I{ROOT}", f"-I{ROOT}/stdlib/runtime/include", f"-I{ROOT}/tools/native_table"]
    lines = {}
    for header in headers:
        command = ["g++", "-std=c++20", "-E", "-x", "c++", *include, os.path.join(ROOT, header)]
        done = subprocess.run(command, text=True, capture_output=True)
        lines[header] = sum(1 for line in done.stdout.splitlines() if line and line[0] != "#")
    return lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--unity", action="store_true", help="as tools/quickstart.sh builds")
    parser.add_argument("--target", default="rung")
    options = parser.parse_args()

    with tempfile.TemporaryDirectory() as folder:
        folder = os.path.realpath(folder)
        configure = ["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
        run(*configure, f"-DCMAKE_UNITY_BUILD={'ON' if options.unity else 'OFF'}")
        seconds = cpu_of("cmake", "--build", folder, "--target", options.target)
        times = unit_times(folder)
        print(f"clean build of {options.target}{', unity' if options.unity else ''}: {seconds:.0f} CPU seconds, "
              f"{len(times)} units")
        print("\ndearest units (seconds of wall time)")
        for spent, unit in times[:10]:
            print(f"  {spent:5.1f}  {re.sub(r'CMakeFiles/[^/]*/', '', unit)}")
        if options.unity:
            return

        units = dependencies(folder)
        users = collections.Counter(header for headers in units.values() for header in set(headers)
                                    if header.endswith((".h", ".def")))
        print("\ndearest headers (lines they bring, times units that read them)")
        lines = preprocessed_lines([header for header, _ in users.most_common(80) if header.endswith(".h")])
        dearest = sorted(((count * users[header], header) for header, count in lines.items()), reverse=True)
        for _, header in dearest[:10]:
            print(f"  {lines[header]:6} x {users[header]:3}  {header}")
        print("\nunits that rebuild after a change of")
        for header, count in users.most_common(20):
            print(f"  {count:4}  {header}")
        lists = {header: count for header, count in users.items() if header.endswith(("diagnostics.def", "rules.def"))}
        print("\nunits that rebuild after a change of one message")
        for header, count in sorted(lists.items(), key=lambda item: -item[1]):
            print(f"  {count:4}  {header}")


if __name__ == "__main__":
    main()

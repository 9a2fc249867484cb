#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""load.py SECONDS: the CPU time that the page needs, its render process and the run with its server together, while it
watches 1 000 values that all change, at 10 updates a second. The limit is 20 % of a core."""

import os
import sys
import time

from browser import Failure, Page
from monitored import Program

VALUES, LIMIT = 1000, 20.0
TICKS = os.sysconf("SC_CLK_TCK")


def cpu_seconds(pid):
    with open(f"/proc/{pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def renderers(browser):
    """The processes below the browser that render pages."""
    parents, found = {}, []
    for name in os.listdir("/proc"):
        try:
            with open(f"/proc/{name}/stat") as stat, open(f"/proc/{name}/cmdline") as command:
                parents[int(name)] = int(stat.read().rsplit(")", 1)[1].split()[1])
                if "--type=renderer" in command.read():
                    found.append(int(name))
        except (OSError, ValueError):
            continue
    def is_below(pid):
        while pid in parents and pid != browser:
            pid = parents[pid]
        return pid == browser
    return [pid for pid in found if is_below(pid)]


def main():
    seconds = float(sys.argv[1])
    source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "counters.iecst")
    watched = ";".join(f"Counters.all[{i}]" for i in range(1, VALUES + 1))
    with Program(source, "--interval", "T#10ms") as program, Page(f"{program.url}#tab=watch&w=All;{watched}") as page:
        page.until(f"currentList().paths.length === {VALUES}")
        page.until("Number(program.values.get('Counters.all[1000]')) > 0")
        page.evaluate("window.updates = 0; views.push({onValues: () => { ++window.updates; }})")
        time.sleep(2)  # what it costs to show them first does not count
        processes = renderers(page.process.pid) + [program.process.pid]
        before, begin = sum(map(cpu_seconds, processes)), time.monotonic()
        updates = page.evaluate("window.updates")
        time.sleep(seconds)
        load = 100 * (sum(map(cpu_seconds, processes)) - before) / (time.monotonic() - begin)
        updates = page.evaluate("window.updates") - updates
        if updates < 5 * seconds:
            raise Failure(f"{updates} updates in {seconds} s")
        print(f"{VALUES} values, {updates / seconds:.1f} updates a second: {load:.1f} % of a core", file=sys.stderr)
        print("within the limit" if load < LIMIT else f"{load:.1f} %, not below {LIMIT} %")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""Which places are changed: a seeded choice from all that sites.py finds, or those of drawn.tsv, which were drawn so and
are kept, since any other change of the sources would draw others. Called by mutation.py."""
import pathlib
import random

import sites

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
PARTS = {"sema": ("sema/",), "lowering": ("ir/lower/",), "passes": ("ir/passes/",), "codegen": ("codegen/",),
         "interpreter": ("ir/interpreter/",), "runtime": ("stdlib/", "cam/table/")}
ALL = ("frontend/", "sema/", "ir/", "codegen/", "stdlib/", "cam/table/")
EACH = 40           # of each part; the rest is drawn from all
WEIGHTS = {"operator": 4, "check": 3, "constant": 2, "table": 1}


def partOf(name):
    return next((part for part, folders in PARTS.items() if name.startswith(folders)), "other")


def allSites(names):
    found = []
    for name in names:
        if name.startswith(ALL) and name.endswith((".cpp", ".h")):
            found += sites.sitesOf((ROOT / name).read_text(), name)
    return found


def inRandomOrder(found, seed):
    """All of them: kinds by their weight, places of a kind at random."""
    choice = random.Random(seed)
    left = {kind: [site for site in found if site.kind == kind] for kind in sites.KINDS}
    for some in left.values():
        choice.shuffle(some)
    while any(left.values()):
        kinds = [kind for kind in sites.KINDS if left[kind]]
        yield left[choice.choices(kinds, [WEIGHTS[kind] for kind in kinds])[0]].pop()


class Draw:
    """The places in the order in which they are taken, without those that do not compile: first those that are kept."""

    def __init__(self, found, seed, count, kept=()):
        self.count, self.kept = count, kept
        each = min(EACH, count // (len(PARTS) + 1))
        self.quotas = {part: each for part in PARTS}
        self.quotas["all"] = count - each * len(PARTS)
        self.orders = {part: list(inRandomOrder([s for s in found if part == "all" or partOf(s.file) == part],
                                                f"{seed}/{part}")) for part in self.quotas}

    def take(self, rejected, surplus=0.0):
        taken = [site for site in self.kept if key(site) not in rejected]
        seen = {key(site) for site in taken}
        left = {part: int(quota * (1 + surplus) + 0.999) for part, quota in self.quotas.items()}
        for site in taken:
            part = partOf(site.file)
            left[part if left.get(part, 0) > 0 else "all"] -= 1
        for part, order in self.orders.items():
            for site in order:
                if left[part] <= 0:
                    break
                if key(site) in rejected or key(site) in seen:
                    continue
                seen.add(key(site))
                taken.append(site)
                left[part] -= 1
        return taken


def key(site):
    return f"{site.file}:{site.begin}-{site.end} {site.kind} {sites.oneLine(site.mutated)}"


# ---- rows of equivalent.tsv and drawn.tsv

ROWS = {}


def rowsOf(name):
    """By key: file, kind, the line with the place between « and », what it becomes. Of places that read the same the second
    one has ` (2)` after its line."""
    if name not in ROWS:
        text = (ROOT / name).read_text() if (ROOT / name).exists() else ""
        ROWS[name], times = {}, {}
        for site in sites.sitesOf(text, name):
            start = text.rfind("\n", 0, site.begin) + 1
            stop = text.find("\n", site.begin)
            end = min(site.end, stop)
            line = (text[start:site.begin] + "«" + text[site.begin:end] + "»" + text[end:stop]).strip()
            mutated = sites.oneLine(site.mutated)
            times[line, mutated] = time = times.get((line, mutated), 0) + 1
            ROWS[name][key(site)] = (name, site.kind, line + (f" ({time})" if time > 1 else ""), mutated)
    return ROWS[name]


def rowOf(site):
    return rowsOf(site.file)[key(site)]


def keptSites(found):
    """Those of drawn.tsv that are still there."""
    rows = {tuple(line.split("\t")) for line in (HERE / "drawn.tsv").read_text().splitlines()[1:]}
    files = {row[0] for row in rows}
    return [site for site in found if site.file in files and rowOf(site) in rows]


def writeDrawn(chosen, kept):
    """drawn.tsv with these places: those that it has already keep their order, the others follow."""
    rows = [rowOf(site) for site in chosen]
    old = [tuple(line.split("\t")) for line in (HERE / "drawn.tsv").read_text().splitlines()[1:]] if kept else []
    rows = [row for row in old if row in rows] + [row for row in rows if row not in old]
    (HERE / "drawn.tsv").write_text("file\tkind\tline\tmutated\n" + "".join("\t".join(row) + "\n" for row in rows))

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the tests notice a mistake in Rung itself. COUNT places of the compiler and the runtime, at least 40 in each part,
are drawn by a seeded choice from all that sites.py finds (draw.py). A copy of the tree gets all of them in one build, where an
environment variable chooses the active one (mutant.h). The tests that evaluate the place are run, quickest first, until
one fails; one that needs 30 s of a processor has noticed it too.
  tests/mutation/mutation.py [--seed N] [--count N] [--folder DIR] [-j N] [--fresh | --refill] [--survivors | --list | --sample] [NUMBER...]
--folder     where the copy is built and kept for the next run (default: rung-mutation in the folder for temporary files)
--units      unit tests that are built and run as well, separated by commas, or all
--native     so many conformance programs are compiled as well (160), or these files, separated by commas
--longest    only tests that take at most so many seconds, for a first look
--survivors  only those that the last run in that folder did not notice, with the tests as they are now
--fresh      draws all instead of those of drawn.tsv, and writes them there
--refill     draws only for rows of drawn.tsv whose lines are gone, writes them there, and tests only these mutants
--list       only prints what would be drawn; NUMBER: only these mutants, with the tests that fail
--sample     builds nothing: checks sites.py on a small source, and that a draw can be repeated
Exits 0 when at least 95 % are noticed or in equivalent.tsv, whose columns are file, kind, line, mutated, reason. Run it from
a checkout; the copy has the files that git knows or could add."""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time

import sites
from draw import ALL, EACH, HERE, PARTS, ROOT, Draw, allSites, keptSites, key, partOf, rowOf, rowsOf, writeDrawn

TARGETS = ["rung", "rung_test_runner", "ir_golden"]
PROCESSOR_SECONDS = 30   # of one process
WALL_SECONDS = 400       # of one command
LENGTHS = 0.5, 2, 10     # seconds of a test: those of a class run before the longer ones
NEW = ["", False, 0.0, []]
FIRST, BATCH = 16, 40    # tests of a command: the first one small, since most mutants end there


def files():
    """What git knows or could add, below the root."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, check=True)
    return sorted(name for name in listed.stdout.decode().split("\0") if name and (ROOT / name).is_file())


# ---- the copy and its build

class Tree:
    def __init__(self, folder):
        self.folder = folder
        self.root = folder / "tree"
        self.state_file = folder / "state.json"
        self.state = {"rejected": {}, "numbers": {}}
        if self.state_file.exists():
            self.state = json.loads(self.state_file.read_text())

    def save(self):
        self.state_file.write_text(json.dumps(self.state, indent=0))

    def number(self, site):
        numbers = self.state["numbers"]
        return numbers.setdefault(key(site), len(numbers))

    def write(self, names, chosen):
        """Copies what has changed, with the places built in. Out: the keys of those that cannot be built together."""
        by_file, crossing = {}, []
        for site in chosen:
            by_file.setdefault(site.file, []).append((self.number(site), site))
        keys = {self.number(site): key(site) for site in chosen}
        for name in names:
            content = (ROOT / name).read_bytes()
            if name in by_file:
                text, crossed = sites.built(content.decode(), by_file[name], self.folder / "mutant.h")
                crossing += [keys[number] for number in crossed]
                content = text.encode()
            put(self.root / name, content, os.access(ROOT / name, os.X_OK))
        put(self.folder / "mutant.h", (HERE / "mutant.h").read_bytes())
        kept = {self.root / name for name in names}
        for folder in ("tests", "docs", "samples"):
            for file in (self.root / folder).rglob("*"):
                if file.is_file() and not file.is_symlink() and file not in kept:
                    file.unlink()
        return crossing

    def build(self, jobs, targets):
        build = self.root / "build"
        if not (build / "build.ninja").exists():
            flags = "-O1 -DNDEBUG -w"
            subprocess.run(["cmake", "-G", "Ninja", "-S", self.root, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                            f"-DCMAKE_CXX_FLAGS_RELEASE={flags}", f"-DCMAKE_C_FLAGS_RELEASE={flags}"],
                           check=True, stdout=subprocess.DEVNULL)
        result = subprocess.run(["ninja", "-C", build, "-k", "30", "-j", str(jobs), *targets], capture_output=True, text=True,
                                errors="replace")
        (self.folder / "build.log").write_text(result.stdout + result.stderr)
        return result.returncode == 0, result.stdout

    def tryHeaders(self, chosen, jobs):
        """A header that does not compile keeps every file from it: each is tried alone first. Out: what keeps it."""
        headers = sorted({site.file for site in chosen if site.file.endswith(".h")})

        def one(name):
            standard = "c++17" if name.startswith(("stdlib/", "cam/table/")) else "c++20"
            command = ["g++", f"-std={standard}", "-w", "-fsyntax-only", "-I", self.root, "-I",
                       self.root / "stdlib/runtime/include", "-x", "c++", "-"]
            result = subprocess.run(command, input=f'#include "{self.root / name}"\n', cwd=self.root, capture_output=True,
                                    text=True, errors="replace")
            return f"FAILED: {name}\n\n{result.stderr}" if result.returncode else ""

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            return self.blamed("\n".join(pool.map(one, headers)), chosen, only_errors=True)

    def blamed(self, output, chosen, only_errors=False):
        """The keys of places that keep a file from compiling: those in the lines of its errors, or of its notes, or all in
        the file. With only_errors, an error elsewhere is the fault of none."""
        places = {}
        for site in chosen:
            places.setdefault(site.file, []).append(site)
        blamed = set()
        for block in re.split(r"^FAILED: ", output, flags=re.M)[1:]:
            messages = re.findall(r"^(?:In file included from |\s+from )?(\S+?):(\d+)(?::\d+)?: +(\w*)", block, re.M)
            for words in (("error", "fatal"), None):
                hits = set()
                for path, line, word in messages:
                    name = os.path.relpath(os.path.join(self.root / "build", path), self.root)
                    if words is None or word in words:
                        hits |= {key(site) for site in places.get(name, []) if covers(site, int(line))}
                if hits or only_errors:
                    break
            if only_errors:
                blamed |= hits
                continue
            if not hits:
                for name, some in places.items():
                    if name in block.split("\n")[1] or name + ".o" in block.split("\n")[0]:
                        hits |= {key(site) for site in some}
            if not hits:
                for path, _, _ in messages:
                    name = os.path.relpath(os.path.join(self.root / "build", path), self.root)
                    hits |= {key(site) for site in places.get(name, [])}
            if not hits:
                sys.exit("the copy does not build, and no mutant is to blame:\n" + block[:4000])
            blamed |= hits
        return blamed


LINES = {}


def covers(site, line):
    if site.file not in LINES:
        LINES[site.file] = (ROOT / site.file).read_text()
    text = LINES[site.file]
    first = site.constant[0] if site.constant else site.begin
    return text.count("\n", 0, first) + 1 <= line <= text.count("\n", 0, site.end) + 1


def put(path, content, executable=False):
    if path.exists() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    if executable:
        path.chmod(0o755)


def prepare(tree, draw, names, jobs, targets):
    """Builds until all compile. Out: number -> Site of exactly the count that was asked for."""
    rejected = tree.state["rejected"]
    chosen = draw.take(rejected, surplus=0.25)
    built = set(tree.state.get("built", ()))
    if {key(site) for site in draw.take(rejected)} <= built:
        chosen = [site for site in draw.take(rejected, surplus=0.5) if key(site) in built]  # the same: nothing is built
    while True:
        crossing = tree.write([name for name in names if (ROOT / name).is_file()], chosen)
        rejected.update({name: "crosses another" for name in crossing})
        is_known = all(key(site) in built for site in chosen)
        blamed = set() if crossing or is_known else tree.tryHeaders(chosen, jobs)
        good, output = (False, "") if crossing or blamed else tree.build(jobs, targets)
        if good:
            break
        if output:
            blamed = tree.blamed(output, chosen)
        rejected.update({name: "does not compile" for name in blamed})
        tree.save()
        if not crossing:
            print(f"{len(blamed)} places do not compile; building again without them", flush=True)
        chosen = [site for site in chosen if key(site) not in rejected]
        if not {key(site) for site in draw.take(rejected)} <= {key(site) for site in chosen}:
            chosen = draw.take(rejected, surplus=0.1)
    tree.state["built"] = [key(site) for site in chosen]
    tree.save()
    return {tree.number(site): site for site in draw.take(rejected)}


# ---- the tests

class Suite:
    def __init__(self, tree, names, native, longest):
        self.tree, self.longest = tree, longest
        self.bin = tree.root / "build/bin"
        self.tests = []
        for name in names:
            kept = (name.startswith("tests/conformance/") and name.endswith((".st", ".xml", ".test"))
                    or name.startswith("tests/golden/") and name.endswith((".st", ".nct", ".test", ".ir"))
                    or name.startswith("tests/programs/") and name.endswith((".st", ".test", "/test.txt"))
                    or name.startswith("samples/library/") and name.endswith(".st")
                    or name.startswith("docs/") and name.endswith(".md"))
            if kept:
                self.tests.append(name)
        listed = tree.root / "build/unit_tests.list"
        if listed.exists():
            self.tests += [f"unit/{name}" for name in listed.read_text().split() if (self.bin / name).exists()]
        programs = [name for name in self.tests if name.startswith("tests/conformance/") and name.endswith(".st")]
        if native.isdigit():
            given = sorted(random.Random(1).sample(programs, min(int(native), len(programs))))
        else:
            given = native.split(",")
        self.native = [f"native {name}" for name in given]
        self.words, self.texts = {}, {}  # by number, what is in quotes in the line of a place; texts of tests
        self.records = {}  # test -> [stamp, passes, seconds, reached numbers]
        self.records_file = tree.folder / "tests.json"
        if self.records_file.exists():
            self.records = json.loads(self.records_file.read_text())
        self.passed = {}  # number -> test -> its stamp when it passed with the mutant
        self.passed_file = tree.folder / "passed.json"
        if self.passed_file.exists():
            self.passed = json.loads(self.passed_file.read_text())
        self.lock = threading.Lock()

    def stamp(self, test):
        name = test.removeprefix("native ")
        file = self.tree.root / name
        content = file.read_bytes() if file.exists() else b""
        for beside in ("rung", "rung_test_runner"):
            stat = (self.bin / beside).stat()
            content += f"{stat.st_mtime_ns} {stat.st_size}".encode()
        return hashlib.sha1(content).hexdigest()

    def run(self, tests, number=None, reached=None):
        """Runs tests of one way. Out: whether all passed, and the output."""
        way = "native" if tests[0].startswith("native ") else "interp"
        environment = dict(os.environ)
        for name in ("RUNG_MUTANT", "RUNG_MUTANTS_REACHED"):
            environment.pop(name, None)
        marker = f"{os.getpid()}.{threading.get_ident()}.{time.monotonic_ns()}"
        environment["RUNG_MUTATION_RUN"] = marker
        if number is not None:
            environment["RUNG_MUTANT"] = str(number)
        if reached is not None:
            environment["RUNG_MUTANTS_REACHED"] = str(reached)

        def limit():
            os.setsid()
            resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 5))
            resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
            resource.setrlimit(resource.RLIMIT_FSIZE, (256 << 20, 256 << 20))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        command = [self.bin / "rung_test_runner", f"--ways=--engine={way}", "-j", "1",
                   *[test.removeprefix("native ") for test in tests]]
        with tempfile.TemporaryFile() as out:
            process = subprocess.Popen(command, cwd=self.tree.root, env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=subprocess.STDOUT, preexec_fn=limit)
            try:
                code = process.wait(WALL_SECONDS)
            except subprocess.TimeoutExpired:
                code = None
            endRun(process, marker)
            out.seek(0)
            text = out.read(1 << 20).decode(errors="replace")
        ran = re.search(r"^(\d+) passed, (\d+) failed$", text, re.M)
        if code == 0 and ran and int(ran[1]) == 0:
            return None, text  # not a test
        return code == 0, text if code is not None else text + "\nkilled after the time limit\n"

    def record(self, jobs):
        """Runs each test without a mutant: whether it passes, and which places it evaluates."""
        self.tests = [test for test in self.tests + self.native if self.records.get(test, NEW)[2] <= self.longest]
        wanted = []
        for test in self.tests:
            stamp = self.stamp(test)
            if test not in self.records or self.records[test][0] != stamp:
                wanted.append((test, stamp))
        size = len(self.tree.state["numbers"]) + 1

        def one(task):
            test, stamp = task
            with tempfile.NamedTemporaryFile(dir=self.tree.folder) as file:
                file.write(bytes(size))
                file.flush()
                begin = time.monotonic()
                good, _ = self.run([test], reached=file.name)
                seconds = time.monotonic() - begin
                numbers = [i for i, byte in enumerate(pathlib.Path(file.name).read_bytes()) if byte]
            with self.lock:
                self.records[test] = [stamp, good, seconds, numbers]

        begin = time.monotonic()
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for done, _ in enumerate(pool.map(one, wanted), 1):
                if done % 500 == 0:
                    with self.lock:
                        self.records_file.write_text(json.dumps(self.records))
                    print(f"{done} of {len(wanted)} tests run without a mutant", flush=True)
        self.records_file.write_text(json.dumps(self.records))
        known = [test for test in self.tests if self.records[test][1] and self.records[test][2] <= self.longest]
        broken = [test for test in self.tests if self.records[test][1] is False]
        print(f"{len(known)} tests pass without a mutant, {len(broken)} do not and are left out ({time.monotonic() - begin:.0f} s)",
              flush=True)
        if broken:
            print("  left out: " + " ".join(broken[:20]), flush=True)
        self.reaching = {}
        for test in known:
            for number in self.records[test][3]:
                self.reaching.setdefault(number, []).append(test)

    def text(self, test):
        file = self.tree.root / test.removeprefix("native ")
        if test not in self.texts:
            self.texts[test] = file.read_text(errors="replace").lower() if file.is_file() else ""
        return self.texts[test]

    def batches(self, number):
        """The tests that evaluate a place: first those that name what its line names, then the kinds of which many run in one
        process, the compiled programs last."""
        words = self.words.get(number, ())

        def order(test):
            _, _, seconds, numbers = self.records[test]
            is_dense = test.startswith(("tests/conformance/", "unit/", "tests/golden/ir/")) and not test.endswith(".test")
            names_it = any(word in self.text(test) for word in words)
            length = sum(seconds > limit for limit in LENGTHS)
            by_chance = hashlib.sha1(f"{number} {test}".encode()).digest()
            return (test.startswith("native "), length, not names_it, not is_dense, by_chance)

        passed = self.passed.get(str(number), {})
        tests = [test for test in self.reaching.get(number, []) if passed.get(test) != self.records[test][0]]
        tests.sort(key=order)
        start = 0
        while start < len(tests):
            size = FIRST if start == 0 else BATCH
            batch = tests[start:start + size]
            if batch[0].startswith("native ") != batch[-1].startswith("native "):
                batch = [test for test in batch if not test.startswith("native ")]
            if batch[0].startswith("native "):
                batch = batch[:10]
            slow = next((i for i, test in enumerate(batch) if i > 0 and self.records[test][2] > 10), None)
            batch = batch[:slow]
            start += len(batch)
            yield batch

    def judge(self, number):
        """What notices the mutant: text of the failure, or None. What passed before is not run again."""
        with self.lock:
            passed = self.passed.setdefault(str(number), {})
        for batch in self.batches(number):
            good, text = self.run(batch, number)
            if good is False and self.run(batch)[0]:
                return text
            for test in batch if good is False else []:  # one fails without the mutant, by chance or beside the others
                good, text = self.run([test], number)
                if good is False and self.run([test])[0]:
                    return text
            with self.lock:
                passed.update({test: self.records[test][0] for test in batch})
        return None


def endRun(process, marker):
    """Ends what a command left behind: children in groups of their own, known by their environment."""
    word = f"RUNG_MUTATION_RUN={marker}".encode()
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            if word in (entry / "environ").read_bytes().split(b"\0"):
                os.kill(int(entry.name), signal.SIGKILL)
        except OSError:
            pass
    process.wait()


# ---- the command

def equivalents():
    rows = {}
    for line in (HERE / "equivalent.tsv").read_text().splitlines()[1:]:
        cells = line.split("\t")
        if len(cells) == 5 and cells[4]:
            rows[tuple(cells[:4])] = cells[4]
    return rows


def sample():
    """The part that needs no build."""
    source = (HERE / "sample.cpp").read_text()
    expected = [line[3:] for line in source[source.index("// Sites:"):].splitlines()[1:]]
    code = source[:source.index("// Sites:")]
    found = sites.sitesOf(code, "sample.cpp")
    actual = [f"{site.line} {site.kind}: {sites.oneLine(site.original)} -> {sites.oneLine(site.mutated)}" for site in found]
    if actual != expected:
        for line in sorted(set(expected) ^ set(actual)):
            print(("missing: " if line in expected else "surplus: ") + line)
        sys.exit("sample.cpp: its sites are not those at its end")
    text, crossing = sites.built(code, list(enumerate(found)), HERE / "mutant.h")
    if crossing:
        sys.exit(f"sample.cpp: sites {crossing} cross others")
    names = [name for name in files() if name.startswith(ALL)]
    everywhere = allSites(names)
    drawn = [[key(site) for site in Draw(everywhere, 7, 300).take({})] for _ in range(2)]
    if drawn[0] != drawn[1] or len(set(drawn[0])) != 300:
        sys.exit("a draw cannot be repeated")
    per_part = {part: sum(partOf(name) == part for name in drawn[0]) for part in PARTS}
    if min(per_part.values()) < EACH:
        sys.exit(f"too few of a part: {per_part}")
    checkBuilt(text, len(found))
    stale = [cells for cells in equivalents() if cells not in rowsOf(cells[0]).values()]
    for cells in stale:
        print("equivalent.tsv: no such place: " + " | ".join(cells))
    if stale:
        sys.exit(1)
    print(f"{len(found)} sites of the sample, 300 of the sources, each of the sample as expected when it is active")


def checkBuilt(text, count):
    """Compiles the sample, whose main prints what it computes: the original without a mutant, another result with each."""
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "sample"
        subprocess.run(["g++", "-std=c++17", "-w", "-x", "c++", "-", "-o", program], input=text, text=True, check=True)

        def run(number=None, reached=None):
            environment = {"RUNG_MUTANT": str(number)} if number is not None else {}
            if reached:
                environment["RUNG_MUTANTS_REACHED"] = str(reached)
            return subprocess.run([program], env=environment, capture_output=True, text=True, timeout=20).stdout

        marks = pathlib.Path(folder) / "reached"
        marks.write_bytes(bytes(count))
        original = run(reached=marks)
        if 0 in marks.read_bytes():
            sys.exit(f"sample.cpp: not all of its sites are reached: {list(marks.read_bytes())}")
        same = [number for number in range(count) if run(number) == original]
        if same:
            sys.exit(f"sample.cpp: sites {same} change nothing")


def main():
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"))
    parser.add_argument("--seed", default=os.environ.get("SEED", "1"))
    parser.add_argument("--count", type=int, default=int(os.environ.get("COUNT", "300")))
    parser.add_argument("--folder", default=os.path.join(tempfile.gettempdir(), "rung-mutation"))
    parser.add_argument("-j", type=int, default=os.cpu_count())
    parser.add_argument("--units", default="")
    parser.add_argument("--native", default="160")
    parser.add_argument("--longest", type=float, default=10 ** 6)
    parser.add_argument("--survivors", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--sample", action="store_true")
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("--refill", action="store_true")
    parser.add_argument("numbers", nargs="*", type=int)
    options = parser.parse_args()
    if options.sample:
        return sample()

    names = files()
    found = allSites(names)
    is_usual = (options.seed, options.count) == ("1", 300)
    kept = keptSites(found) if is_usual and not options.fresh else []
    draw = Draw(found, options.seed, options.count, kept)
    if options.list:
        for site in draw.take({}):
            print(site)
        return None
    folder = pathlib.Path(options.folder).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    tree = Tree(folder)
    targets = TARGETS + (["all"] if options.units == "all" else options.units.split(","))
    begin = time.monotonic()
    mutants = prepare(tree, draw, names, options.j, [target for target in targets if target])
    print(f"{len(found)} places; {len(mutants)} drawn with seed {options.seed}; built in {time.monotonic() - begin:.0f} s",
          flush=True)
    if options.fresh or options.refill:
        writeDrawn(mutants.values(), kept)
    suite = Suite(tree, files(), options.native, options.longest)
    suite.record(options.j)

    results_file = folder / f"results-{options.seed}.json"
    results = json.loads(results_file.read_text()) if results_file.exists() and options.survivors else {}
    known = equivalents()
    suite.words = {number: {word.lower() for word in re.findall(r'"(\w\w+)"', " ".join(rowOf(site)))}
                   for number, site in mutants.items()}
    is_equivalent = {number: rowOf(site) in known for number, site in mutants.items()}
    drawn_before = {key(site) for site in kept} if options.refill else ()
    wanted = options.numbers or [number for number in sorted(mutants) if not is_equivalent[number] and
                                 results.get(key(mutants[number])) != "noticed" and
                                 key(mutants[number]) not in drawn_before]

    def one(number):
        if number not in suite.reaching:
            return number, "not reached", ""
        text = suite.judge(number)
        return number, "survived" if text is None else "noticed", text or ""

    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        for number, result, text in pool.map(one, wanted):
            site = mutants[number]
            results[key(site)] = result
            if result != "noticed":
                print(f"{result}: {number} at line {site.line}\n  " + "\t".join(rowOf(site)), flush=True)
            elif options.refill:
                print(f"noticed: {number} {site}", flush=True)
            elif options.numbers:
                print(f"noticed: {number} {site}\n" + text[:3000], flush=True)
            results_file.write_text(json.dumps(results, indent=0))
            with suite.lock:
                suite.passed_file.write_text(json.dumps(suite.passed))
    if options.numbers or options.refill:
        return None
    seconds = time.monotonic() - begin
    print("part         drawn  noticed  equivalent  survived  not reached")
    missed = 0
    for part in [*PARTS, "other"]:
        some = [number for number, site in mutants.items() if partOf(site.file) == part]
        if not some:
            continue
        counts = {"noticed": 0, "equivalent": 0, "survived": 0, "not reached": 0}
        for number in some:
            counts["equivalent" if is_equivalent[number] else results[key(mutants[number])]] += 1
        missed += counts["survived"] + counts["not reached"]
        print(f"{part:<12} {len(some):5}  {counts['noticed']:7}  {counts['equivalent']:10}  {counts['survived']:8}  "
              f"{counts['not reached']:11}")
    rejected = tree.state["rejected"].values()
    real = len(mutants) - sum(is_equivalent.values())
    print(f"{real - missed} of {real} noticed ({100 * (real - missed) / max(real, 1):.1f} %), {sum(is_equivalent.values())} "
          f"equivalent, in {seconds:.0f} s; {sum(r == 'does not compile' for r in rejected)} places did not compile")
    return (real - missed) < 0.95 * real


if __name__ == "__main__":
    sys.exit(main())

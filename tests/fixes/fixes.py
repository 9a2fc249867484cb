#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# What the fixes of diagnostics do. In: programs with mistakes. Out: for each code how often a fix removed the diagnostic,
# left it, or made a new error.
#
#   fixes.py FILE|DIR ... [--all] [--verbose]   pages of docs/errors, and sources with `// args:` as tests have them;
#                                               --all: also the fixes that are proposals; --verbose: each that fails
#   fixes.py FILE|DIR ... --failures            prints the sure fixes that leave their diagnostic or make a new error
#   fixes.py FILE|DIR ... --cut N               takes N words and signs out of programs without errors, one at a time, and
#                                               fixes what is sure: prints for each word how often it is there again
#   fixes.py --pages DIR                        applies the fix of each page of docs/errors that has one: the result is
#                                               the fixed program of the page, or has no error; prints what differs
import collections
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

SUFFIX = {"st": ".st", "nct": ".nct", "xml": ".xml"}


def read_text(path):
    with open(path, encoding="utf-8", errors="surrogateescape", newline="") as stream:
        return stream.read()


# The programs of a page: (kind, language, options, text).
def blocks_of(page):
    found = []
    for match in re.finditer(r"^(```+)(\w+) (broken|fixed)([^\n]*)\n(.*?)^\1$", read_text(page), re.M | re.S):
        found.append((match[3], match[2], match[4].split(), match[5]))
    return found


def programs_in(path):
    if path.endswith(".md"):
        for kind, language, options, text in blocks_of(path):
            if kind == "broken" and language in SUFFIX:
                yield SUFFIX[language], options, text
    elif path.endswith((".st", ".nct", ".xml")):
        text = read_text(path)
        args = re.search(r"(?://|;|#|<!--) args: ([^\n]*)", text)
        yield os.path.splitext(path)[1], args[1].replace("-->", "").split() if args else [], text


def check(folder, name, options, more=()):
    command = ["rung", "check", name, "--format=json", "--max-errors=0", *options, *more]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    begin = run.stderr.find('{"diagnostics"')
    return json.loads(run.stderr[begin:])["diagnostics"] if begin >= 0 else None


def key_of(diagnostic):
    return diagnostic["code"] + ": " + diagnostic["message"]


def errors_in(diagnostics):
    return collections.Counter(key_of(d) for d in diagnostics if d["severity"] == "error")


def offset_of(text, line, column):
    lines = text.split("\n")
    return sum(len(one) + 1 for one in lines[:line - 1]) + column - 1


# None: the fix is not in this file alone.
def applied(text, name, fix):
    for edit in sorted(fix["edits"], key=lambda edit: (edit["line"], edit["column"]), reverse=True):
        if edit["path"] != name:
            return None
        begin = offset_of(text, edit["line"], edit["column"])
        end = offset_of(text, edit["endLine"], edit["endColumn"])
        text = text[:begin] + edit["text"] + text[end:]
    return text


class Measure:
    def __init__(self, with_proposals, verbose):
        self.with_proposals, self.verbose = with_proposals, verbose
        self.rows = collections.defaultdict(collections.Counter)

    def program(self, shown, suffix, options, text):
        with tempfile.TemporaryDirectory() as folder:
            name = "program" + suffix
            path = os.path.join(folder, name)

            def write(content):
                with open(path, "w", encoding="utf-8", errors="surrogateescape", newline="") as stream:
                    stream.write(content)

            write(text)
            before = check(folder, name, options)
            for diagnostic in before or []:
                row = self.rows[diagnostic["code"]]
                row["diagnostics"] += 1
                fixes = [fix for fix in diagnostic.get("fixes", []) if fix["preferred"] or self.with_proposals]
                if fixes:
                    row["with a fix"] += 1
                for fix in fixes:
                    changed = applied(text, name, fix)
                    if changed is None:
                        continue
                    write(changed)
                    self.compare(shown, before, check(folder, name, options) or [], diagnostic, fix, row)

    def compare(self, shown, before, after, diagnostic, fix, row):
        kind = "sure" if fix["preferred"] else "proposal"
        key = key_of(diagnostic)
        count = lambda found: sum(1 for one in found if key_of(one) == key)
        new = errors_in(after) - errors_in(before)
        result = "not fixed" if count(after) >= count(before) else "new error" if new else "fixed"
        row[kind + " " + result] += 1
        if self.verbose and result != "fixed":
            print("%s: %s: %s" % (shown, key, fix["title"]))
            print("    %s %s" % (result, ", ".join(new)))

    def show(self):
        columns = ["diagnostics", "with a fix", "sure fixed", "sure not fixed", "sure new error"]
        if self.with_proposals:
            columns += ["proposal fixed", "proposal not fixed", "proposal new error"]
        total = collections.Counter()
        print("code\t" + "\t".join(columns))
        for code in sorted(self.rows):
            row = self.rows[code]
            total.update(row)
            if row["with a fix"]:
                print(code + "\t" + "\t".join(str(row[column]) for column in columns))
        print("all\t" + "\t".join(str(total[column]) for column in columns))


def files_in(path):
    if os.path.isdir(path):
        return sorted(os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names)
    return [path]


def words_of(text):
    return re.findall(r"\w+|[^\w\s]", text)


# Whether the first fix of the page's code gives its fixed program, or one without errors.
def compare_page(page):
    code = os.path.basename(page)[:-3]
    blocks = blocks_of(page)
    outcome = None
    for index, (kind, language, options, text) in enumerate(blocks):
        if kind != "broken" or language not in SUFFIX:
            continue
        fixed = next((block[3] for block in blocks[index + 1:] if block[0] == "fixed"), "")
        with tempfile.TemporaryDirectory() as folder:
            name = "program" + SUFFIX[language]
            path = os.path.join(folder, name)
            with open(path, "w", encoding="utf-8", newline="") as stream:
                stream.write(text)
            diagnostics = [d for d in check(folder, name, options) or [] if d["code"] == code and d.get("fixes")]
            if not diagnostics:
                continue
            results = [applied(text, name, fix) for fix in diagnostics[0]["fixes"]]
            if any(result is not None and words_of(result) == words_of(fixed) for result in results):
                outcome = "the same"
                continue
            run = subprocess.run(["rung", "check", name, "--fix=all", "--format=json", *options], cwd=folder,
                                 capture_output=True, text=True)
            rest = check(folder, name, options) or []
            if run.returncode == 0 and all(d["code"] != code for d in rest):
                outcome = outcome or "clean"
            else:
                print("%s: %s leaves %s" % (page, diagnostics[0]["fixes"][0]["title"],
                                            sorted({key_of(d) for d in rest if d["severity"] == "error" or d["code"] == code})))
                return "wrong"
    return outcome


CUT = ["THEN", "DO", "OF", "TO", "UNTIL", "END_IF", "END_FOR", "END_WHILE", "END_CASE", "END_REPEAT", "END_VAR", "END_STRUCT",
       "END_FUNCTION_BLOCK", "END_FUNCTION", "END_PROGRAM", "END_TYPE", ";", ")", "(", ":=", ":", ","]


# Each word of a program in another place of which the program stays the same: those in comments and strings are not.
def places_in(text, word):
    code = re.sub(r"\(\*.*?\*\)|//[^\n]*|'[^'\n]*'|\"[^\"\n]*\"|\{[^}]*\}", lambda m: " " * len(m[0]), text, flags=re.S)
    pattern = r"(?<![\w])" + word + r"(?![\w])" if word[0].isalpha() else re.escape(word) + ("(?!=)" if word == ":" else "")
    return [match.span() for match in re.finditer(pattern, code)]


def cut(paths, count):
    chance = random.Random(1)
    rows = collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "program.st")
        programs = []
        for source in paths:
            for suffix, options, text in programs_in(source) if source.endswith(".st") else ():
                shutil.copy(source, path)
                found = check(folder, "program.st", options)
                if found is not None and not errors_in(found):
                    programs.append((options, text))
        for _ in range(count):
            options, text = chance.choice(programs)
            word = chance.choice(CUT)
            places = places_in(text, word)
            if not places:
                continue
            begin, end = chance.choice(places)
            with open(path, "w", encoding="utf-8", errors="surrogateescape", newline="") as stream:
                stream.write(text[:begin] + text[end:])
            before = errors_in(check(folder, "program.st", options) or [])
            if not before:
                continue
            subprocess.run(["rung", "check", "--fix", "program.st", *options], cwd=folder, capture_output=True)
            after = errors_in(check(folder, "program.st", options) or [])
            result = "the same" if words_of(read_text(path)) == words_of(text) else "clean" if not after else "left"
            rows[word][result] += 1
            rows[word]["cut"] += 1
            if sum(after.values()) > sum(before.values()):
                rows[word]["more errors"] += 1
                if "--verbose" in sys.argv:
                    print(word, repr(text[max(0, begin - 60):begin]), repr(text[end:end + 60]), list(before), list(after))
    columns = ["cut", "the same", "clean", "left", "more errors"]
    print("word\t" + "\t".join(columns))
    for word in [*CUT, "all"]:
        row = sum(rows.values(), collections.Counter()) if word == "all" else rows[word]
        print(word + "\t" + "\t".join(str(row[column]) for column in columns))


def main():
    if "--cut" in sys.argv:
        at = sys.argv.index("--cut")
        return cut([path for argument in sys.argv[1:at] for path in files_in(argument)], int(sys.argv[at + 1]))
    arguments = [word for word in sys.argv[1:] if not word.startswith("--")]
    if "--pages" in sys.argv:
        outcomes = collections.Counter(compare_page(page) for page in files_in(arguments[0]) if page.endswith(".md"))
        print("pages with a fix: %d give the fixed program, %d another one without errors, %d are wrong"
              % (outcomes["the same"], outcomes["clean"], outcomes["wrong"]))
        return
    measure = Measure("--all" in sys.argv, "--verbose" in sys.argv or "--failures" in sys.argv)
    for argument in arguments:
        for path in files_in(argument):
            for suffix, options, text in programs_in(path):
                measure.program(path, suffix, options, text)
    if "--failures" in sys.argv:
        failed = sum(row["sure not fixed"] + row["sure new error"] for row in measure.rows.values())
        return print("sure fixes that fail: %d" % failed)
    measure.show()


if __name__ == "__main__":
    main()

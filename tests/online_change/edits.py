#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Random edits of a running program: after each online change every variable whose path and type both versions have
# keeps its value, all others begin with their initial values, and the program goes on as the new version does that is
# started with these values. A refused change has to say which pointer loses its target.
#   edits.py [EDITS [SEED]]      every tenth program is compiled; every tenth change is undone by a fault after it
import os
import random
import re
import subprocess
import sys
import tempfile

INITIAL = {"BOOL": ["FALSE", "TRUE"], "INT": ["0", "7", "-3"], "DINT": ["0", "100000"], "REAL": ["0.0", "2.5"],
           "STRING": ["''", "'ab'"], "LINT": ["0", "5"], "WORD": ["0", "258"], "Color": ["Red", "Green"]}
CHANGE = 6  # the cycle before which the change is made; even: the slower task begins with it
CYCLES = 4  # that are compared after it


class Holder:
    """A variable of Main that holds an address."""

    def __init__(self, kind, target, set_to, is_empty, use):
        self.kind, self.target, self.set_to, self.is_empty, self.use = kind, target, set_to, is_empty, use


HOLDERS = {
    "to_int": Holder("POINTER TO INT", "INT", "to_int := ADR(%s)", "to_int = 0", "to_int^ := to_int^ + 10;"),
    "to_pair": Holder("POINTER TO Pair", "Pair", "to_pair := ADR(%s)", "to_pair = 0", "met := to_pair = ADR(%s);"),
    "to_base": Holder("POINTER TO Base", "Base", "to_base := ADR(%s)", "to_base = 0", "sum := to_base^.Sum();"),
    "itf": Holder("INamed", "Base", "itf := %s", "itf = 0", "name_sum := itf.Sum();"),
    "ref": Holder("REFERENCE TO REAL", "REAL", "ref REF= %s", "NOT __ISVALIDREF(ref)", "ref := ref + 0.5;"),
}


def places_of(variable):
    return ["[%d]" % i for i in range(variable.low, variable.high + 1)] if variable.is_array else [""]


class Variable:
    def __init__(self, name, kind, low=0, high=0, initial=""):
        self.name, self.kind, self.low, self.high, self.initial = name, kind, low, high, initial
        self.is_array = high > 0

    def text(self):
        kind = "ARRAY[%d..%d] OF %s" % (self.low, self.high, self.kind) if self.is_array else self.kind
        return "  %s : %s%s;" % (self.name, kind, " := " + self.initial if self.initial and not self.is_array else "")

    def copy(self):
        return Variable(self.name, self.kind, self.low, self.high, self.initial)


class Unit:
    """A STRUCT, FUNCTION_BLOCK, list of globals or PROGRAM."""

    def __init__(self, what, name, base=""):
        self.what, self.name, self.base = what, name, base
        self.variables, self.step = [], 1

    def copy(self):
        unit = Unit(self.what, self.name, self.base)
        unit.variables = [variable.copy() for variable in self.variables]
        unit.step = self.step
        return unit


class Model:
    def __init__(self, generator):
        self.random = generator
        self.next_name = 0
        self.units = [Unit("STRUCT", "Pair"), Unit("STRUCT", "Row")]
        self.units += [Unit("FUNCTION_BLOCK", "Base"), Unit("FUNCTION_BLOCK", "Pump", "Base"),
                       Unit("FUNCTION_BLOCK", "Valve")]
        self.units += [Unit("GLOBALS", ""), Unit("PROGRAM", "Main"), Unit("PROGRAM", "Second")]
        self.targets = {}  # what the pointers of Main point to, as paths in Main, by the names of HOLDERS
        for unit in self.units:
            for _ in range(generator.randint(2, 4)):
                self.add_variable(unit)
        for _ in range(generator.randint(0, 5)):
            self.point(None)

    def copy(self):
        model = Model.__new__(Model)
        model.random, model.next_name = self.random, self.next_name
        model.targets = dict(self.targets)
        model.units = [unit.copy() for unit in self.units]
        return model

    def unit(self, name):
        return next((unit for unit in self.units if unit.name == name and unit.what != "GLOBALS"), None)

    # What a variable of this unit may be: elementary, or a type that comes before.
    def kinds(self, unit):
        at = self.units.index(unit)
        known = [other.name for other in self.units[:at] if other.what in ("STRUCT", "FUNCTION_BLOCK")]
        if unit.what == "STRUCT":
            known = [name for name in known if self.unit(name).what == "STRUCT"]
        return list(INITIAL) + known

    def add_variable(self, unit):
        self.next_name += 1
        variable = Variable("v%d" % self.next_name, self.random.choice(self.kinds(unit)))
        if self.random.random() < 0.3:
            variable.low = self.random.randint(-1, 2)
            variable.high = variable.low + self.random.randint(1, 3) + 1
            variable.is_array = variable.high > 0
        if variable.kind in INITIAL:
            variable.initial = self.random.choice(INITIAL[variable.kind])
        unit.variables.insert(self.random.randint(0, len(unit.variables)), variable)

    # ---- edits

    def edit(self):
        unit = self.random.choice(self.units)
        getattr(self, self.random.choice(
            ["add_variable", "add_variable", "remove", "rename", "retype", "bounds", "reorder", "rebase", "body", "body",
             "add_block", "point", "initial"]))(unit)

    def some(self, unit):
        return self.random.choice(unit.variables) if unit.variables else None

    def remove(self, unit):
        if len(unit.variables) > 1:
            unit.variables.remove(self.some(unit))

    def rename(self, unit):
        self.next_name += 1
        self.some(unit).name = "v%d" % self.next_name

    def retype(self, unit):
        variable = self.some(unit)
        variable.kind = self.random.choice(self.kinds(unit))
        variable.initial = self.random.choice(INITIAL[variable.kind]) if variable.kind in INITIAL else ""

    def bounds(self, unit):
        variable = self.some(unit)
        if variable.is_array:
            variable.low += self.random.randint(-1, 1)
            variable.high = max(variable.high + self.random.randint(-1, 1), variable.low, 1)

    def reorder(self, unit):
        self.random.shuffle(unit.variables)

    def rebase(self, unit):
        blocks = [other for other in self.units if other.what == "FUNCTION_BLOCK"]
        if unit not in blocks:
            return
        before = blocks[:blocks.index(unit)]
        unit.base = self.random.choice([""] + [block.name for block in before])

    def body(self, unit):
        unit.step = self.random.randint(1, 9)

    def initial(self, unit):
        variable = self.some(unit)
        if variable.kind in INITIAL:
            variable.initial = self.random.choice(INITIAL[variable.kind])

    def add_block(self, _):
        self.next_name += 1
        unit = Unit("FUNCTION_BLOCK", "%s%d" % (self.random.choice("ANZ"), self.next_name))
        self.units.insert(2 + self.random.randint(0, 3), unit)
        self.add_variable(unit)
        self.add_variable(self.unit("Main"))

    # One of the pointers gets another target, a variable or an element of an array.
    def point(self, _):
        holder, main = self.random.choice(list(HOLDERS)), self.unit("Main")
        wanted = HOLDERS[holder].target
        if not any(v.kind == wanted for v in main.variables):
            self.next_name += 1
            main.variables.append(Variable("v%d" % self.next_name, wanted))
        paths = [v.name + place for v in main.variables for place in places_of(v) if self.is_target(holder, v.kind)]
        self.targets[holder] = self.random.choice(paths)

    # Whether a pointer may point to a variable of this type.
    def is_target(self, holder, kind):
        wanted = HOLDERS[holder].target
        if wanted != "Base":
            return kind == wanted
        at = self.unit(kind)
        while at is not None and at.name != "Base":
            at = self.unit(at.base) if at.base else None
        return at is not None

    # The target of a pointer once Main has run, and its type; None: there is none.
    def target(self, holder):
        path = self.targets.get(holder)
        for v in self.unit("Main").variables:
            for place in places_of(v):
                if v.name + place == path and self.is_target(holder, v.kind):
                    return path, v.kind, v.is_array
        return None

    # ---- text

    # `faults`: the program divides by zero in its second activation.
    def source(self, faults=False):
        self.faults = faults
        lines = ["TYPE Color : (Red, Green, Blue); END_TYPE",
                 "INTERFACE INamed", "METHOD Sum : DINT", "END_METHOD", "END_INTERFACE"]
        for unit in self.units:
            if unit.what == "STRUCT":
                lines += ["TYPE %s : STRUCT" % unit.name] + [v.text() for v in unit.variables] + ["END_STRUCT END_TYPE"]
            elif unit.what == "GLOBALS":
                lines += ["VAR_GLOBAL"] + [v.text() for v in unit.variables] + ["END_VAR"]
            else:
                lines += self.block(unit)
        lines += ["CONFIGURATION C RESOURCE R ON X TASK T1(INTERVAL := T#10ms, PRIORITY := 1);",
                  "TASK T2(INTERVAL := T#20ms, PRIORITY := 2); PROGRAM Main WITH T1 : Main;",
                  "PROGRAM Second WITH T2 : Second; END_RESOURCE END_CONFIGURATION"]
        return "\n".join(lines) + "\n"

    def block(self, unit):
        is_block = unit.what == "FUNCTION_BLOCK"
        lines = ["%s %s%s%s" % (unit.what, unit.name, " EXTENDS " + unit.base if unit.base else "",
                                " IMPLEMENTS INamed" if unit.name == "Base" else "")]
        lines += ["VAR"] + [v.text() for v in unit.variables]
        if unit.name == "Main":
            lines.append("  mark : BYTE; sum, name_sum : DINT; met : BOOL;")
            lines += ["  %s : %s;" % (name, holder.kind) for name, holder in HOLDERS.items()]
            if self.faults:
                lines.append("  activations, zero : DINT;")
        lines.append("END_VAR")
        if is_block:
            lines += ["METHOD Sum : DINT", "Sum := %d;" % unit.step, "END_METHOD"]
        if unit.name == "Main":
            lines += ["IF %s THEN %s; END_IF" % (holder.is_empty, holder.set_to % self.target(name)[0])
                      for name, holder in HOLDERS.items() if self.target(name)]
        for v in unit.variables:
            lines += self.statement(v, unit.step)
        if unit.name == "Main":
            for name, holder in HOLDERS.items():
                if self.target(name):
                    use = holder.use % self.target(name)[0] if "%s" in holder.use else holder.use
                    lines.append("IF NOT (%s) THEN %s END_IF" % (holder.is_empty, use))
            if self.faults:
                lines.append("IF activations > 0 THEN zero := 1 / zero; END_IF activations := activations + 1;")
        return lines + ["END_" + unit.what]

    def statement(self, variable, step):
        if variable.kind not in INITIAL:
            unit = self.unit(variable.kind)
            if unit is None or unit.what != "FUNCTION_BLOCK":
                return []
            return ["%s%s();" % (variable.name, "[%d]" % variable.high if variable.is_array else "")]
        place = variable.name + ("[%d]" % variable.high if variable.is_array else "")
        return {"BOOL": ["%s := NOT %s;" % (place, place)], "INT": ["%s := %s + %d;" % (place, place, step)],
                "DINT": ["%s := %s + %d;" % (place, place, step)], "LINT": ["%s := %s + %d;" % (place, place, step)],
                "REAL": ["%s := %s + %d.5;" % (place, place, step)], "WORD": ["%s := ROL(%s, 1);" % (place, place)],
                "STRING": ["%s := '%d';" % (place, step)],
                "Color": ["%s := Blue;" % place if step % 2 else "%s := Red;" % place]}[variable.kind]

    # The elementary variables by path, each with the types on the way to it.
    def leaves(self):
        found = {}
        for unit in self.units:
            if unit.what == "GLOBALS":
                self.collect(unit, "", (), found)
            elif unit.what == "PROGRAM":
                self.collect(unit, unit.name + ".", (unit.name,), found)
        found.update({"Main.sum": ("Main", "", "DINT"), "Main.name_sum": ("Main", "", "DINT"),
                      "Main.met": ("Main", "", "BOOL")})
        return found

    def collect(self, unit, path, kinds, found):
        if unit.base:
            self.collect(self.unit(unit.base), path, kinds, found)
        for v in unit.variables:
            for place in places_of(v):
                here = kinds + (("ARRAY" if v.is_array else ""), v.kind)
                if v.kind in INITIAL:
                    found[path + v.name + place] = here
                else:
                    self.collect(self.unit(v.kind), path + v.name + place + ".", here, found)

    # Whether each name is declared once on every line of descent.
    def is_valid(self):
        for unit in self.units:
            names, at = [], unit
            while at is not None:
                names += [v.name for v in at.variables]
                at = self.unit(at.base) if at.base else None
            if len(names) != len(set(names)):
                return False
        order = [unit.name for unit in self.units]
        return all(v.kind in INITIAL or order.index(v.kind) < order.index(unit.name)
                   for unit in self.units for v in unit.variables)


def run(project, folder, commands, *arguments):
    control = os.path.join(folder, "control")
    with open(control, "w") as file:
        file.write("".join(command + "\n" for command in commands))
    cycles, trace = str(CHANGE + CYCLES + 1), os.path.join(folder, "trace.csv")
    return subprocess.run(["rung", "run", project, "--control", control, "-Wno-all", "--cycles", cycles, "--watch",
                           "Main.mark", "--trace", trace, *arguments],
                          capture_output=True, text=True, timeout=300)


# The answers of `get`, a group for each: what is printed between two values of `Main.mark`.
def groups_of(text):
    groups = [{}]
    for path, value in re.findall(r"^(\S+) = (.*)$", text, re.M):
        if path == "Main.mark":
            groups.append({})
        else:
            groups[-1][path] = value
    return groups[1:]


def get(cycle, leaves):
    return ["%d get Main.mark" % cycle, "%d get %s" % (cycle, ",".join(leaves))]


class Edit:
    def __init__(self, seed, folder):
        self.seed, self.folder = seed, folder
        generator = random.Random(seed)
        self.old = Model(generator)
        for _ in range(generator.randint(0, 6)):
            self.old = self.edited(self.old)
        self.new = self.edited(self.old)
        self.faults = seed % 10 == 3
        self.engine = "--engine=" + ("native" if seed % 10 == 7 else "interp")
        self.old_project, self.new_project = self.write("old", self.old), self.write("new", self.new)

    def edited(self, model):
        while True:
            changed = model.copy()
            for _ in range(changed.random.randint(1, 3)):
                changed.edit()
            if changed.is_valid():
                return changed

    def write(self, name, model):
        project = os.path.join(self.folder, name)
        os.makedirs(project, exist_ok=True)
        with open(os.path.join(project, "main.st"), "w") as file:
            file.write(model.source(self.faults and name == "new"))
        return project

    def fail(self, what, *details):
        print("seed %d: %s" % (self.seed, what))
        for detail in details:
            print("  " + str(detail).rstrip().replace("\n", "\n  "))
        sys.exit(1)

    def expect(self, what, expected, actual):
        wrong = {path: (expected.get(path), actual.get(path)) for path in expected.keys() | actual.keys()
                 if expected.get(path) != actual.get(path)}
        if wrong:
            self.fail(what, *["%s: expected %s, got %s" % (path, *both) for path, both in sorted(wrong.items())])

    # The change loses what a pointer of Main points to: it has another type, or does not extend Base any more.
    def loses_target(self):
        return any(self.loses(holder) for holder in HOLDERS)

    def loses(self, holder):
        before = self.old.target(holder)
        if before is None:
            return False
        path, kind, is_array = before
        return not any(v.name + place == path and (v.kind, v.is_array) == (kind, is_array) and
                       (holder == "itf" or self.new.is_target(holder, kind))
                       for v in self.new.unit("Main").variables for place in places_of(v))

    def run(self):
        old_leaves, new_leaves = self.old.leaves(), self.new.leaves()
        rollback = "rollback=3 " if self.faults else ""
        commands = get(CHANGE, old_leaves) + ["%d change %s%s" % (CHANGE, rollback, self.new_project)]
        is_new = not self.loses_target()
        for cycle in range(CHANGE, CHANGE + CYCLES):
            shows_new = is_new and not (self.faults and cycle > CHANGE + 1)
            commands += get(cycle, new_leaves if shows_new else old_leaves)
        done = run(self.old_project, self.folder, commands, self.engine)
        groups = groups_of(done.stdout)
        if len(groups) != CYCLES + 1 or done.returncode != (0 if is_new else 2):
            self.fail("the run ends with exit code %d" % done.returncode, done.stderr[-2000:])
        if is_new != ("  refused Main." not in done.stderr):
            self.fail("the change is %s" % ("refused" if is_new else "made"), done.stderr[-2000:])
        if not is_new:
            return self.expect("after a refused change", groups[0], groups[1])
        self.compare_values(groups[0], groups[1])
        if self.faults:
            return self.expect("after the fault", groups[0], groups[3])
        if all(self.old.target(holder) == self.new.target(holder) for holder in HOLDERS):
            self.compare_runs(groups)

    def compare_values(self, before, after):
        initial = groups_of(run(self.new_project, self.folder, get(0, self.new.leaves())).stdout)[0]
        old_leaves = self.old.leaves()
        self.expect("after the change", {path: before[path] if old_leaves.get(path) == kinds else initial[path]
                                         for path, kinds in self.new.leaves().items()}, after)

    # The new version, started with the values after the change.
    def compare_runs(self, groups):
        leaves, commands, sets = self.new.leaves(), [], []
        for path, value in groups[1].items():
            sets += ["--set", path + "=" + value]
        for cycle in range(CYCLES):
            commands += get(cycle, leaves)
        alone = groups_of(run(self.new_project, self.folder, commands, *sets).stdout)
        for cycle in range(CYCLES):
            self.expect("%d cycles after the change" % cycle, alone[cycle], groups[1 + cycle])


def main():
    edits = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    refused = undone = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + edits):
            edit = Edit(seed, folder)
            edit.run()
            refused += edit.loses_target()
            undone += edit.faults and not edit.loses_target()
    print("%d edits of running programs: %d changes refused, %d undone" % (edits, refused, undone))


if __name__ == "__main__":
    main()

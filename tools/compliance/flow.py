# SPDX-License-Identifier: Apache-2.0
"""Cuts a program into units (statements, declarations, elements of networks, heads of blocks), each with the names that it reads
and writes, and says on which names its assertions depend. Called by evidence.py for each test.
The flow is that of names, whatever their scope: an approximation that finds too much rather than too little. Comments are spaces
in `code`, so that a place in the text is the same place in the code."""
import html
import pathlib
import re

HEAD = re.compile(r"^(?://|#|<!--) (features|covers|with): (.*?)(?: *-->)?$", re.M)
STRINGS = r"'(?:\$.|[^'$])*'|\"(?:\$.|[^\"$])*\""
NOTES = re.compile(rf"(?P<text>{STRINGS})|//[^\n]*|\(\*|/\*|<!--", re.S)
TOKEN = re.compile(rf"(?P<string>{STRINGS})|(?P<pragma>\{{(?:'[^'\n]*'|[^{{}}'])*\}})|(?P<word>%[A-Z]+[\d.*]+|%?\w+(?:#[\w.:+-]+)?)"
                   r"|(?P<sign>:=|=>|<=|>=|<>|\*\*|\?=|[^\s\w])|(?P<line>\n)", re.I)
# Words that open a block, with those that close it: what a head says holds for everything that its block writes.
BLOCKS = {"IF": "END_IF", "CASE": "END_CASE", "FOR": "END_FOR", "WHILE": "END_WHILE", "REPEAT": "END_REPEAT", "__TRY": "__ENDTRY",
          "TYPE": "END_TYPE", "FUNCTION": "END_FUNCTION", "FUNCTION_BLOCK": "END_FUNCTION_BLOCK", "PROGRAM": "END_PROGRAM",
          "CLASS": "END_CLASS", "INTERFACE": "END_INTERFACE", "METHOD": "END_METHOD", "PROPERTY": "END_PROPERTY",
          "PROPERTY_GET": "END_PROPERTY", "PROPERTY_SET": "END_PROPERTY", "GET": "END_GET", "SET": "END_SET",
          "NAMESPACE": "END_NAMESPACE", "CONFIGURATION": "END_CONFIGURATION", "RESOURCE": "END_RESOURCE", "ACTION": "END_ACTION",
          "STEP": "END_STEP", "INITIAL_STEP": "END_STEP", "TRANSITION": "END_TRANSITION"}
CLOSING = set(BLOCKS.values())
STATEMENTS = {"IF", "CASE", "FOR", "WHILE", "REPEAT", "__TRY"}
NAMELESS = {"REPEAT", "__TRY", "GET", "SET", "TYPE"}        # no name or condition follows
WITH_BODY = {"FUNCTION", "FUNCTION_BLOCK", "PROGRAM", "CLASS", "METHOD"}
HEADED = WITH_BODY | {"INTERFACE", "NAMESPACE", "CONFIGURATION", "RESOURCE", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET"}
DECLARING = {"TYPE", "CONFIGURATION", "RESOURCE"}           # their statements declare
CHART = {"STEP", "INITIAL_STEP", "TRANSITION"}
MODIFIERS = {"PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "FINAL", "ABSTRACT", "OVERRIDE", "FROM"}
INNER = {"THEN", "DO", "OF", "ELSE", "UNTIL", "__CATCH", "__FINALLY"}   # end the head of a block or of one of its parts
JUMPS = {"EXIT", "CONTINUE", "RETURN", "JMP", "JMPC", "JMPCN", "RET", "RETC", "RETCN"}
STORES = {"ST", "STN", "S", "R", "CAL", "CALC", "CALCN"} | JUMPS        # a line of IL that ends what is calculated
SECTION = re.compile(r"VAR(?:_\w+)?(?:\s+(?:RETAIN|NON_RETAIN|CONSTANT|PERSISTENT|PUBLIC|PRIVATE|PROTECTED|INTERNAL)\b)*", re.I)
# Words that name nothing, so that nothing flows through them.
RESERVED = set("""constant retain non_retain true false null not and or xor mod function function_block class method array of then do else
elsif if case for while repeat until end_if var struct pointer reference ref ref_to extends implements bool sint int dint lint usint uint
udint ulint real lreal byte word dword lword string wstring time date tod dt ltime ldate ltod ldt char wchar""".split())
OF_TASKS = {"task", "program", "with", "interval", "single", "priority", "kind", "trigger", "watchdog", "sensitivity"}
IMPLICIT = re.compile(r"fb_(?:init|exit|reinit)|check(?:bounds|div|l?range|pointer)\w*")  # called without a call
LITERAL = re.compile(r"(?:L?T|L?D|L?TOD|L?DT|\d+)#.*", re.I)
ASSERTIONS = {"ASSERT", "ASSERT_EQ", "ASSERT_NEAR"}
PRAGMA = "{"          # what a pragma writes: it belongs to what follows
CONTROL = "control"   # the control of a machine, between what a ladder of NCT tells it and what it answers


class Unit:
    """A part of a program: its place, and the names that it reads and writes. An assertion writes nothing."""

    def __init__(self, start, end, reads, writes, asserts=False, types=()):
        self.start, self.end, self.reads, self.writes = start, end, reads, writes
        self.asserts, self.types = asserts, types  # types: of what it declares


class Block:
    """An open block: its first word, the unit of its head, where its units begin, and the names of its head."""

    def __init__(self, word, head, first, jumps):
        self.word, self.head, self.first, self.jumps, self.names = word, head, first, jumps, set()
        self.named = False


def names(text):
    return {word.lower() for word in re.findall(r"%[A-Za-z]+[\d.]+|[A-Za-z_]\w*", text)} - RESERVED


def parts(tokens):
    """The names among some tokens, with their index."""
    return [(index, name) for index, (kind, text, _) in enumerate(tokens) if kind == "word" for name in names(LITERAL.sub("", text))]


def blanked(text):
    """The text with spaces in place of comments, also nested ones."""
    out, at = [], 0
    while found := NOTES.search(text, at):
        start, end = found.span()
        out.append(text[at:start])
        opening = found.group()
        if found.group("text"):
            out.append(opening)
        else:
            close = {"(*": "*)", "/*": "*/", "<!--": "-->"}.get(opening)
            depth = 1 if close else 0
            while depth and end < len(text):
                if text.startswith(close, end):
                    depth, end = depth - 1, end + len(close)
                elif opening != "<!--" and text.startswith(opening, end):
                    depth, end = depth + 1, end + len(opening)
                else:
                    end += 1
            out.append(re.sub(r"[^\n]", " ", text[start:end]))
        at = end
    return "".join(out) + text[at:]


def spaces(found):
    return " " * len(found.group())


def level(tokens, upto):
    """How many parentheses are open before a token."""
    return sum((text in ("(", "[")) - (text in (")", "]")) for kind, text, _ in tokens[:upto] if kind == "sign")


def at_top(tokens, signs):
    return next((i for i, token in enumerate(tokens) if token[1] in signs and level(tokens, i) == 0), None)


def dropLabels(tokens):
    """Drops the labels of a CASE, or of a jump, before a statement; whether it was one of a jump."""
    colon = at_top(tokens, (":",))
    if colon is None or colon + 1 == len(tokens) or any(text == ":=" for _, text, _ in tokens[:colon]):
        return False
    is_name = colon == 1 and tokens[0][0] == "word" and not tokens[0][1].isdigit()
    del tokens[:colon + 1]
    return is_name


def element(tokens, end, network, outer):
    """The unit of an element of a network: its wires are names, too."""
    wires = {f"#{network}:{text}" for i, (_, text, _) in enumerate(tokens) if text.isdigit() and i > 1 and
             tokens[i - 1][1].upper() in (":=", "OR")}
    own = {f"#{network}:{text}" for _, text, _ in tokens[1:2] if text.isdigit()}
    first = next((i for i, token in enumerate(tokens) if token[1] == "("), len(tokens))
    last = next((i for i in range(first + 1, len(tokens)) if level(tokens, i + 1) == 0), len(tokens))
    variable = {name for index, name in parts(tokens) if first < index < last}
    everything = {name for _, name in parts(tokens[1:])}
    writes = set() if tokens[0][1] in ("input", "contact", "rail") else everything if tokens[0][1] == "execute" else variable
    return Unit(tokens[0][2], end, everything | wires | outer, writes | own)


def statement(tokens, end, declares, outer):
    """The unit of a statement or declaration; `outer` are the names of the heads around it."""
    start = tokens[0][2]
    words = parts(tokens)
    everything = {name for _, name in words}
    if tokens[0][1].upper() in ASSERTIONS and len(tokens) > 1 and tokens[1][1] == "(":
        return Unit(start, end, everything | outer, set(), asserts=True)
    refers = any(text.upper() in ("REF", "ADR", "REFERENCE") for _, text, _ in tokens)
    assigns = at_top(tokens, (":=", "?="))
    colon = at_top(tokens, (":",))
    if declares and (colon is not None or assigns is not None):
        left = {word for index, word in words if colon is not None and index < colon}
        said = {text.upper() for _, text, _ in tokens}
        of_task = tokens[0][1].upper() in ("TASK", "PROGRAM") and tokens[1][0] == "word"
        whole = refers or not left or of_task or {"STRUCT", "WITH"} & said
        everything -= OF_TASKS if of_task else set()
        right = {name for index, name in words if colon is None or index > colon}
        return Unit(start, end, (everything if whole else right) | outer, everything if whole else left, types=right)
    if assigns is not None and not refers and tokens[0][1].upper() not in HEADED and all(text != "=>" for _, text, _ in tokens):
        return Unit(start, end, everything | outer, {word for index, word in words if index < assigns})
    return Unit(start, end, everything | outer, everything)


def opens(code, found, word):
    """Whether a word that is also a modifier or a name opens a block here."""
    before, after = code[:found.start()], code[found.end():found.end() + 40]
    if word in ("SET", "GET"):
        return bool(re.search(r"(?:\n|;|END_GET|END_SET|END_VAR)\s*$", before)) and not re.match(r"\s*[(:.]", after)
    if word == "PROGRAM":  # not an instance in a resource
        return not re.match(r"\s+(?:(?:NON_)?RETAIN\s+)?\w+\s*(?:\bWITH\b|:)", after)
    if word in ("STEP", "ACTION"):
        return bool(re.match(r"\s+\w+", after)) and not before.rstrip().endswith((".", "("))
    return True


class Statements:
    """Reads one piece of code in ST, IL, textual SFC or the notation of networks, and appends its units."""

    def __init__(self, code, units, blocks_of_program):
        self.code, self.units, self.block_names = code, units, blocks_of_program
        self.open, self.tokens, self.section, self.depth = [], [], None, 0
        self.network, self.networks = 0, []  # where the innermost one begins, 0 for statements; those around it
        self.jumps = []  # units that concern all that their body writes: jumps, labels, parts of charts

    def outer(self):
        return set().union(*(block.names for block in self.open))

    def read(self, start, end):
        previous, skip = "", 0
        for found in TOKEN.finditer(self.code, start, end):
            kind, text = found.lastgroup, found.group()
            if found.start() < skip:
                continue
            if kind == "line":
                self.lineEnds(found.start())
            elif kind == "pragma":
                self.pragma(found)
            elif kind == "word" and not self.network and previous != ".":
                skip = self.word(found, text.upper(), previous) or 0
            else:
                self.sign(found, kind, text)
            if kind != "line":
                previous = text.upper()
        self.close(end)
        everything = set().union(*(unit.writes for unit in self.units)) if self.jumps else set()
        for unit in self.jumps:
            unit.writes |= everything

    def lineEnds(self, at):
        """The line of a POU's head ends it; a line of IL that stores ends a statement."""
        tokens = self.tokens
        if tokens and not self.network and not self.depth and tokens[0][1].upper() in HEADED and len(tokens) > 1 and tokens[-1][1] not in (
                ",", ":", "EXTENDS", "IMPLEMENTS"):
            self.close(at)
            return
        if (not self.network and not self.depth and self.section is None and len(tokens) > 1 and tokens[0][1].upper() in STORES
                and tokens[1][1] not in (":=", "(", ".", "[")):
            self.close(at)

    def pragma(self, found):
        text = found.group()[1:-1].strip().lower()
        if text.startswith("network"):
            self.close(found.start())
            self.networks.append(0 if text == "network st" else found.start() + 1)
        elif text == "end_network":
            self.close(found.start())
            del self.networks[-1:]
        self.network = self.networks[-1] if self.networks else 0
        self.units.append(Unit(*found.span(), set(), {PRAGMA}))

    def word(self, found, word, previous):
        """A word outside of networks; the place up to which it has been read."""
        if word in BLOCKS and opens(self.code, found, word):
            self.openBlock(found, word)
        elif word in CLOSING:
            self.closeBlock(found, word)
        elif re.fullmatch(r"VAR(_\w+)?", word) and self.depth == 0 and previous != ":=" and (
                not self.tokens or self.tokens[0][1].upper() in BLOCKS or all(text not in (":=", "(") for _, text, _ in self.tokens)):
            self.close(found.start())
            self.section = Unit(found.start(), SECTION.match(self.code, found.start()).end(), set(), set())
            self.units.append(self.section)
            return self.section.end
        elif word == "END_VAR":
            self.close(found.start())
            if self.section is not None:
                self.units.append(Unit(*found.span(), set(), set(self.section.writes)))
            self.section = None
        else:
            self.sign(found, "word", found.group())
            if word in INNER and self.section is None and self.open and self.open[-1].word in STATEMENTS:
                self.endHead(found, word)
            elif self.open and self.open[-1].word not in STATEMENTS and not self.open[-1].named and word not in MODIFIERS:
                self.nameBlock(found.group().lower())
        return None

    def nameBlock(self, name):
        block = self.open[-1]
        block.named = True
        block.names.add(name)
        block.head.writes.add(name)
        if block.word in ("FUNCTION_BLOCK", "CLASS", "PROGRAM"):
            self.block_names.add(name)

    def endHead(self, found, word):
        """THEN, DO, OF and the like: the names before it belong to everything in the block."""
        block = self.open[-1]
        own = {name for _, name in parts(self.tokens)}
        block.names |= own
        block.head.reads |= own
        part = Unit(self.tokens[0][2], found.end(), own, block.head.writes)
        block.head.end = max(block.head.end, found.end())
        self.units.append(part)
        self.tokens.clear()

    def openBlock(self, found, word):
        self.close(found.start())
        head = Unit(*found.span(), set(), set())
        self.units.append(head)
        self.open.append(Block(word, head, len(self.units), len(self.jumps)))
        if word not in ("REPEAT", "__TRY"):
            self.tokens.append(("word", found.group(), found.start()))
        self.open[-1].named = word in NAMELESS

    def closeBlock(self, found, word):
        self.close(found.start())
        index = next((i for i in range(len(self.open) - 1, -1, -1) if BLOCKS[self.open[i].word] == word), None)
        if index is None:
            return
        block = self.open[index]
        del self.open[index:]
        written = set(block.head.writes).union(*(unit.writes for unit in self.units[block.first:]))
        block.head.writes |= written
        self.units.append(Unit(*found.span(), set(), written))
        if block.word in WITH_BODY:
            for unit in self.jumps[block.jumps:]:
                unit.writes |= written
            del self.jumps[block.jumps:]

    def sign(self, found, kind, text):
        self.depth = max(0, self.depth + (text in ("(", "[")) - (text in (")", "]"))) if kind == "sign" else self.depth
        if text == ";":
            self.close(found.end())
            self.depth = 0
        else:
            self.tokens.append((kind, text, found.start()))

    def close(self, end):
        """Ends a statement, declaration or element."""
        tokens = self.tokens
        if not tokens:
            return
        words = {block.word for block in self.open}
        declares = self.section is not None or not words.isdisjoint(DECLARING)
        is_head = tokens[0][1].upper() in HEADED
        labelled = not self.network and not declares and not is_head and dropLabels(tokens)
        first = next((text for kind, text, _ in tokens if kind == "word"), "")
        if self.network:
            unit = element(tokens, end, self.network, self.outer())
        else:
            unit = statement(tokens, end, declares, self.outer())
        self.units.append(unit)
        if self.section is not None:
            self.section.writes |= unit.writes
        if labelled or first.upper() in JUMPS or self.network and first in ("jump", "label", "return") or not words.isdisjoint(CHART):
            self.jumps.append(unit)
        tokens.clear()


class Program:
    """A test: its rows, and the texts and units of its file and of those that belong to it."""

    def __init__(self, file):
        self.texts, self.units, self.block_names = [], [], set()
        self.ladders = []  # which texts are ladders of NCT
        text = file.read_text(errors="replace").replace("\r", "")
        self.rows = {kind: [] for kind in ("features", "covers", "with")}
        for kind, words in HEAD.findall(text):
            self.rows[kind] += words.split()
        text = HEAD.sub(spaces, text)
        traced = re.findall(r"^(?://|<!--|    ) *(?:run|trace): ([^\n]*)", text, re.M)
        self.texts.append(("", ""))
        self.units.append([Unit(0, 0, names(" ".join(traced)), set(), asserts=True)] if traced else [])
        expected = {int(line) for line in re.findall(r"^(?://|<!--) expect: [^:\s]*:(\d+):", text, re.M)}
        expected |= {int(line) for line in re.findall(r"^(?://|<!--) expect: .* on line (\d+)$", text, re.M)}
        text = re.sub(r"^(?://|<!--) expect:[^\n]*", spaces, text, flags=re.M)
        others = [file.parent / name for name in self.rows["with"]]
        if file.suffix == ".test":
            self.addSession(text)
        elif file.name == "test.txt":
            others += [other for other in sorted(file.parent.rglob("*")) if other.is_file() and other != file]
        else:
            self.add(text, file.suffix)
            self.expect(expected)
        for other in others:
            self.add(other.read_text(errors="replace"), other.suffix)
        self.known = self.asserted()

    def add(self, text, suffix):
        text = html.unescape(text) if suffix == ".xml" else text
        self.texts.append((text, blanked(text)))
        self.units.append([])
        if suffix == ".xml":
            self.addXml()
        elif suffix == ".nct":
            self.ladders.append(len(self.texts) - 1)
            self.addRungs()
        else:
            self.addStatements(0, len(text))

    def addStatements(self, start, end):
        Statements(self.texts[-1][1], self.units[-1], self.block_names).read(start, end)

    def expect(self, lines):
        """The lines that diagnostics name are asserted."""
        text, code = self.texts[-1]
        starts = [0] + [found.end() for found in re.finditer("\n", text)] + [len(text)]
        places = [(starts[line - 1], starts[line]) for line in lines if line < len(starts)]
        for unit in self.units[-1]:
            unit.asserts |= any(unit.start < end and start < unit.end for start, end in places)
        self.units[-1] += [Unit(start, end, names(code[start:end]), set(), asserts=True) for start, end in places]

    def addSession(self, text):
        """A session: programs in its commands and after `> `, and printed lines, which are asserted."""
        text = re.sub(r"^#[^\n]*", spaces, text, flags=re.M)
        code = re.sub(r"^(?:> ?|\$ )", spaces, text, flags=re.M)
        self.texts.append((code, code))
        self.units.append([])
        for part in re.finditer(r"(?:^>[^\n]*\n?)+|^\$ (?:[^\n]*\\\n)*[^\n]*\n?|^[^>$\n][^\n]*\n?", text, re.M):
            start, end = part.span()
            if part.group().startswith(">"):
                self.addStatements(start, end)
                self.addWatched(part)
            elif part.group().startswith("$"):
                at = start
                for piece in re.split(r"(\\n)", part.group()):  # of printf
                    if piece != "\\n":
                        self.addStatements(at, at + len(piece))
                    at += len(piece)
                self.addWatched(part)
            else:
                self.units[-1].append(Unit(start, end, names(part.group()), set(), asserts=True))

    def addWatched(self, part):
        self.units[-1] += [Unit(part.start() + option.start(), part.start() + option.end(), names(option.group(1)), set(), asserts=True)
                           for option in re.finditer(r"--(?:watch|set)[= ](\S+)", part.group())]

    def addRungs(self):
        """A ladder of NCT: each rung reads and writes all its names; what it tells the control changes what that answers."""
        code, units = self.texts[-1][1], self.units[-1]
        units.append(Unit(-1, -1, {CONTROL}, {"nct_simulated_code", "nct_simulated_text", "nct_simulate"}))
        everything = names(code)
        for part in re.finditer(r"^\s*(?:RUNG|SBN|JME)\b.*?(?=^\s*(?:RUNG|SBN|JME|END_MODULE)\b|\Z)", code, re.M | re.S):
            labels = {f"label {number}" for number in re.findall(r"\b(?:JMP|JME|SBS|SBN)\s+(\d+)", part.group())}
            found = names(part.group()) | labels
            units.append(Unit(*part.span(), found, everything if re.search(r"\b(?:JMP|SBS)\b", part.group()) else found))
        for part in re.finditer(r"^\s*(MODULE\s+\w+).*?(END_MODULE)", code, re.M | re.S):
            found = names(part.group())
            units += [Unit(*part.span(1), set(), found), Unit(*part.span(2), set(), found)]
        symbols = re.search(r"SYMBOLS(.*?)END_SYMBOLS", code, re.S)
        for line in re.finditer(r"[^\n]+", symbols.group(1) if symbols else ""):
            found = names(line.group())
            if re.search(r"\b[ACDS]?P_\w", line.group()):
                units.append(Unit(-1, -1, found, {CONTROL}))
                found.add(CONTROL)
            elif re.search(r"\b[ACDS]?N_\w", line.group()):
                units.append(Unit(-1, -1, {CONTROL}, found))
            start = symbols.start(1) + line.start()
            units.append(Unit(start, start + len(line.group()), found, found))

    def addXml(self):
        """PLCopen: elements with their wires, declarations, and texts in ST and IL."""
        code, units = self.texts[-1][1], self.units[-1]
        whole = []  # they concern everything that the file writes
        for number, body in enumerate(re.finditer(r"<body\b.*?</body>", code, re.S)):
            for part in re.finditer(r"<(\w+)\b[^<>]*\blocalId=\"(\d+)\".*?(?=<\w+\b[^<>]*\blocalId=\"|</body>)", body.group(), re.S):
                wires = {f"#{number}:{ref}" for ref in re.findall(r"refLocalId=\"(\d+)\"", part.group())}
                said = re.findall(r"<(?:expression|variable)>([^<]*)<|(?:typeName|instanceName|name|label)=\"([^\"]*)\"", part.group())
                inside = names(" ".join(one or other for one, other in said))
                unit = Unit(body.start() + part.start(), body.start() + part.end(), wires | inside,
                            {f"#{number}:{part.group(2)}"} | inside)
                units.append(unit)
                if re.match(r"<(?:step|transition|jump\w*|actionBlock|\w+vergence|label|return|macroStep)\b", part.group()):
                    whole.append(unit)
        for part in re.finditer(r"<(xhtml|\w+:\w+|ST|IL|textDeclaration)\b[^<>]*>\s*(?:<!\[CDATA\[)?(?!<[a-z])(.*?)(?:\]\]>)?\s*</\1>",
                                code, re.S):
            self.addStatements(*part.span(2))
        for part in re.finditer(r"<(dataType|pou|configuration|resource|task|pouInstance) [^<>]*\bname=\"([^\"]+)\"[^<>]*>", code):
            end = code.find(f"</{part.group(1)}>", part.end()) if part.group(1) == "dataType" else part.end()
            inside = names(code[part.end():end])
            units.append(Unit(part.start(), end, inside, names(part.group(2)) | inside))
        for part in re.finditer(r"<variable [^<>]*\bname=\"(\w+)\"[^<>]*>(.*?)</variable>", code, re.S):
            units.append(Unit(*part.span(), names(part.group(2)), {part.group(1).lower()}))
        whole.append(Unit(0, len(code), set(), set()))
        units.append(whole[-1])
        everything = set().union(*(unit.writes for unit in units))
        for unit in whole:
            unit.writes = everything

    def asserted(self):
        """The names on which an assertion depends."""
        units = [unit for group in self.units for unit in group]
        known = set().union(*(unit.reads for unit in units if unit.asserts))
        known |= {name for unit in units for name in unit.writes if known and IMPLICIT.fullmatch(name)}
        size = -1
        while size != len(known):
            size = len(known)
            for unit in units:
                if not unit.writes.isdisjoint(known):
                    known |= unit.reads
                elif any(name in known and name in self.block_names for name in unit.types):
                    known |= unit.writes  # an instance whose block has an effect elsewhere
        return known

    def lacks(self, pattern, with_comments, of_ladder=False):
        """What evidence of a pattern the program lacks; None when there is some. Its groups are the places that count. A word of
        the language of ladders is sought in those that the test has."""
        occurs = False
        for number, ((text, code), units) in enumerate(zip(self.texts, self.units)):
            if of_ladder and self.ladders and number not in self.ladders:
                continue
            for found in pattern.finditer(text if with_comments else code):
                occurs = True
                start, end = next((found.span(group) for group in pattern.groupindex if found.group(group) is not None), found.span())
                near = [unit for unit in units if unit.start < end and start < unit.end]
                if all(unit.writes == {PRAGMA} for unit in near):  # a pragma or comment belongs to what follows
                    near = [unit for unit in units if unit.start >= start and unit.writes != {PRAGMA}]
                    near = [min(near, key=lambda unit: unit.start)] if near else []
                if any(unit.asserts or not unit.writes.isdisjoint(self.known) for unit in near):
                    return None
        return "no assertion depends on it" if occurs else "it does not occur"

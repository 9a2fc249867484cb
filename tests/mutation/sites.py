# SPDX-License-Identifier: Apache-2.0
"""The places of a C++ source at which a mistake could have been made, and the text of each mistake. In: the text of a file
in the style of .clang-format, which is what tells an operator from a template bracket, a pointer or a sign. Out: Sites in
the order of the text, and the file with some of them built in, each chosen at run time by its number. Called by mutation.py.
  operator  < <= > >= == != && || + - * / % & | ^ << >> += -= |= &= exchanged with its neighbour; a `!` dropped
  constant  an integer one greater, a real number one greater, true and false exchanged
  check     a guard never taken: an `if` around a return, a break, a continue or a report
  table     a value of a constant table exchanged with that of the next row"""
import bisect
import re

KINDS = ("operator", "constant", "check", "table")
TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<directive>^[ \t]*\#(?:[^\n\\]|\\.)*)"""
    r"""|(?P<string>(?:u8|[uUL])?R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|(?:u8|[uUL])?"(?:\\.|[^"\\\n])*")"""
    r"""|(?P<char>(?:u8|[uUL])?'(?:\\.|[^'\\\n])+')|(?P<number>\.?\d(?:'?[\w.]|(?<=[eEpP])[+-])*)|(?P<word>[A-Za-z_]\w*)"""
    r"""|(?P<sign><<=|>>=|->\*|\.\.\.|::|->|\+\+|--|&&|\|\||<<|>>|<=|>=|==|!=|[-+*/%&|^]=|[-+*/%&|^~!<>=?:;,.(){}\[\]])""",
    re.S | re.M)
PRECEDENCE = {sign: level for level, signs in enumerate(
    ("||", "&&", "|", "^", "&", "== !=", "< <= > >=", "<< >>", "+ -", "* / %"), 2) for sign in signs.split()}
ASSIGNMENTS = set("= += -= *= /= %= &= |= ^= <<= >>=".split())
FLIPPED = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-", "-": "+",
           "*": "/", "/": "*", "%": "*", "&": "|", "|": "&", "^": "&", "<<": ">>", ">>": "<<", "+=": "-=", "-=": "+=",
           "|=": "&=", "&=": "|="}
CLOSING = {"(": ")", "[": "]", "{": "}", "<": ">"}
OPENING = {close: open for open, close in CLOSING.items()}
# Where an expression cannot begin further left.
STATEMENT_WORDS = set("return case else throw co_return goto do if while for switch".split())
FIXED = set("static_assert template case using typedef enum friend concept requires alignas operator extern goto "
            "asm __asm__ consteval".split())  # a statement with one of these holds nothing that may change at run time
LEAVES = set("return continue break".split())
REPORT = re.compile(r"report|error|fail|warn|refuse|reject|fault", re.I)
INTEGER = re.compile(r"(0[xX][\dA-Fa-f]+|0[bB][01]+|\d+)([uUlLzZ]*)$")
REAL = re.compile(r"(\d*\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+)([fFlL]?)$")


class Token:
    __slots__ = ("kind", "text", "begin", "end", "blank_before", "blank_after", "match")

    def __init__(self, kind, text, begin, end):
        self.kind, self.text, self.begin, self.end = kind, text, begin, end
        self.blank_before = self.blank_after = True
        self.match = -1  # of a bracket: its partner


class Site:
    """One possible mistake: `text[begin:end]`, the expression around it, and how it reads with the mistake."""

    def __init__(self, kind, begin, end, mutated, line, original):
        self.kind, self.begin, self.end, self.mutated, self.line, self.original = kind, begin, end, mutated, line, original
        self.in_constexpr = False   # inside of a constexpr function
        self.constant = None        # (begin, end) of a word constexpr that has to become const
        self.file = None

    def __str__(self):
        return f"{self.file}:{self.line}: [{self.kind}] {oneLine(self.original)} -> {oneLine(self.mutated)}"


def oneLine(text):
    return re.sub(r"\s+", " ", text).strip()


def tokens(text):
    found = []
    for match in TOKEN.finditer(text):
        kind = match.lastgroup if match.lastgroup != "mark" else "string"
        if kind in ("comment", "directive"):
            continue
        found.append(Token(kind, match[0], match.start(), match.end()))
    for token in found:
        token.blank_before = token.begin == 0 or text[token.begin - 1].isspace()
        token.blank_after = token.end >= len(text) or text[token.end].isspace()
    open_brackets = []
    for i, token in enumerate(found):
        if token.kind != "sign":
            continue
        is_angle = token.text == "<" and not isBinary(token)
        if token.text in "([{" or is_angle:
            open_brackets.append(i)
        elif token.text in ")]}" or (token.text == ">" and not isBinary(token)):
            while open_brackets and found[open_brackets[-1]].text == "<" and token.text != ">":
                open_brackets.pop()  # it was no bracket
            if open_brackets and CLOSING[found[open_brackets[-1]].text] == token.text:
                token.match = open_brackets.pop()
                found[token.match].match = i
        elif token.text == ">>" and not isBinary(token):  # closes two; the partner of the outer is good enough
            for _ in range(2):
                if open_brackets and found[open_brackets[-1]].text == "<":
                    token.match = open_brackets.pop()
                    found[token.match].match = i
    return found


def isBinary(token):
    return token.blank_before and token.blank_after


class Reader:
    def __init__(self, text):
        self.text = text
        self.tokens = tokens(text)
        self.lines = [0] + [match.end() for match in re.finditer("\n", text)]
        self.sites = []

    def line(self, at):
        return bisect.bisect_right(self.lines, at)

    def slice(self, first, last):
        """The text of tokens first to last, both included."""
        return self.text[self.tokens[first].begin:self.tokens[last].end]

    def left(self, i, precedence):
        """The first token of the operand that ends before token i."""
        k = i - 1
        while k >= 0:
            token = self.tokens[k]
            if token.kind == "sign":
                if token.text in (")", "]", ">", ">>") and token.match >= 0:
                    if self.tokens[token.match - 1].text in ("if", "for", "while", "switch"):
                        break
                    k = token.match - 1
                    continue
                if token.text == "}" and token.match >= 0 and not self.tokens[token.match].blank_before:
                    k = token.match - 1
                    continue
                if token.text in "([{};,?:" or token.text in ASSIGNMENTS:
                    break
                if token.text in PRECEDENCE and isBinary(token) and PRECEDENCE[token.text] < precedence:
                    break
            elif token.kind == "word" and token.text in STATEMENT_WORDS:
                break
            k -= 1
        return k + 1

    def right(self, i, precedence):
        """The last token of the operand that begins behind token i."""
        k = i + 1
        while k < len(self.tokens):
            token = self.tokens[k]
            if token.kind == "sign":
                is_open = token.text in ("(", "[", "<") and token.match >= 0 and not (token.text == "<" and isBinary(token))
                if is_open or (token.text == "{" and token.match >= 0 and not token.blank_before):
                    k = token.match + 1
                    continue
                if token.text in ")]};,{" or (token.text in "?:" and precedence > 0) or token.text in ASSIGNMENTS:
                    break
                if token.text in PRECEDENCE and isBinary(token) and PRECEDENCE[token.text] <= precedence:
                    break
            k += 1
        return k - 1

    def add(self, kind, first, last, mutated, original=None):
        begin, end = self.tokens[first].begin, self.tokens[last].end
        text = self.text[begin:end]
        if first > last or "//" in text or "\n#" in text or "/*" in text or "]{" in text or "] {" in text:
            return  # a comment, a directive, or a lambda
        self.sites.append(Site(kind, begin, end, mutated, self.line(begin), original or text))

    # ---- the kinds

    def findOperators(self):
        for i, token in enumerate(self.tokens):
            if token.kind != "sign" or i == 0:
                continue
            if token.text == "!" and not token.blank_after:
                last = self.right(i, 99)
                if last > i and self.tokens[i - 1].text != "operator":
                    self.add("operator", i, last, f"!!({self.slice(i + 1, last)})")
                continue
            if token.text not in FLIPPED or not isBinary(token):
                continue
            precedence = PRECEDENCE.get(token.text, 0)
            first, last = self.left(i, precedence), self.right(i, precedence)
            if first >= i or last <= i:
                continue
            joins_text = token.text in ("+", "+=") and any(t.kind in ("string", "char") for t in self.tokens[first:last + 1])
            if joins_text or self.tokens[first].text.startswith("out"):
                continue
            self.add("operator", first, last,
                     f"{self.slice(first, i - 1)} {FLIPPED[token.text]} {self.slice(i + 1, last)}")

    def findConstants(self):
        for i, token in enumerate(self.tokens):
            if token.kind == "number":
                mutated = greater(token.text)
                if mutated and not self.isArraySize(i):
                    self.add("constant", i, i, mutated)
            elif token.kind == "word" and token.text in ("true", "false"):
                self.add("constant", i, i, "false" if token.text == "true" else "true")

    def isArraySize(self, i):
        if not (2 < i < len(self.tokens) - 1) or self.tokens[i - 1].text != "[" or self.tokens[i + 1].text != "]":
            return False
        name, before = self.tokens[i - 2], self.tokens[i - 3]
        return name.kind == "word" and (before.kind == "word" or before.text in (">", "*", "&")) and before.text != "return"

    def findChecks(self):
        for i, token in enumerate(self.tokens):
            if token.text != "if" or i + 1 >= len(self.tokens) or self.tokens[i + 1].text != "(":
                continue
            close = self.tokens[i + 1].match
            if close < 0 or not self.guards(close + 1):
                continue
            first, last, depth = i + 2, close - 1, i + 2
            is_declaration = False
            while depth <= last:  # at depth 0 of the condition
                inner = self.tokens[depth]
                if inner.text == ";":
                    first, is_declaration = depth + 1, False
                is_declaration = is_declaration or inner.text == "="
                depth = inner.match + 1 if inner.text in ("(", "[", "{", "<") and inner.match > depth else depth + 1
            if not is_declaration and first <= last:
                self.add("check", first, last, "false")

    def guards(self, i):
        """Whether the statement at token i leaves or reports, first or at its end."""
        if i >= len(self.tokens):
            return False
        firsts = [i]
        if self.tokens[i].text == "{":
            close = self.tokens[i].match
            if close < 0:
                return False
            firsts = [i + 1]
            k = close - 2
            while k > i and self.tokens[k].text not in (";", "{", "}"):
                k -= 1
            firsts.append(k + 1)
        for first in firsts:
            if self.tokens[first].text in LEAVES:
                return True
            k = first
            while k < len(self.tokens) and self.tokens[k].text not in (";", "{", "}", "(", "="):
                if self.tokens[k].kind == "word" and REPORT.search(self.tokens[k].text):
                    return True
                k += 1
        return False

    def findTables(self):
        for i, token in enumerate(self.tokens):
            if token.text != "{" or token.match < 0 or i < 2 or self.tokens[i - 1].text != "=" or \
                    self.tokens[i - 2].text != "]":
                continue
            rows = self.elements(i)
            if len(rows) < 2:
                continue
            columns = [self.elements(first) if self.tokens[first].text == "{" and self.tokens[first].match == last else None
                       for first, last in rows]
            for n, (first, last) in enumerate(rows):
                other = n + 1 if n + 1 < len(rows) else n - 1
                if columns[n] is None:
                    if columns[other] is None:
                        self.exchange((first, last), rows[other])
                elif columns[other] is not None:
                    for mine, theirs in zip(columns[n], columns[other]):
                        self.exchange(mine, theirs)

    def exchange(self, mine, theirs):
        a, b = self.slice(*mine), self.slice(*theirs)
        if oneLine(a) != oneLine(b) and "{" not in a + b:
            self.add("table", *mine, b)

    def elements(self, open_brace):
        """(first, last) of each element between braces."""
        close, found = self.tokens[open_brace].match, []
        first = i = open_brace + 1
        while i < close:
            if self.tokens[i].text == ",":
                if first < i:
                    found.append((first, i - 1))
                first = i + 1
            inner = self.tokens[i]
            i = inner.match + 1 if inner.text in ("(", "[", "{", "<") and inner.match > i else i + 1
        if first < close:
            found.append((first, close - 1))
        return found

    # ---- where nothing may change at run time

    def statementStart(self, i):
        k = i - 1
        while k >= 0:
            token = self.tokens[k]
            if token.text == "}" and token.match >= 0:
                if self.tokens[token.match].blank_before and self.tokens[token.match - 1].text not in ("=", ",", "{", "("):
                    break
                k = token.match - 1
                continue
            if token.text in (";", "{") or (token.text == ":" and not token.blank_before and token.blank_after):
                if token.text == "{" and self.tokens[k - 1].text in ("=", ",", "{", "("):
                    k -= 1
                    continue
                break
            if token.text in (")", "]") and token.match >= 0:
                k = token.match - 1
                continue
            k -= 1
        return k + 1

    def finish(self):
        """Drops what stands in a context of constants, and marks what needs a change of `constexpr`."""
        begins = [token.begin for token in self.tokens]
        blocks = []  # (begin, end, word) of enumerations and constexpr functions
        for i, token in enumerate(self.tokens):
            if token.text != "{" or token.match < 0:
                continue
            k = i - 1
            while k >= 0 and self.tokens[k].text not in (";", "{", "}"):
                k -= 1
            head = [t.text for t in self.tokens[k + 1:i]]
            if "enum" in head:
                blocks.append((token.begin, self.tokens[token.match].end, "enum"))
            elif ("constexpr" in head or "consteval" in head) and "(" in head and "=" not in head and "if" not in head:
                blocks.append((token.begin, self.tokens[token.match].end, "constexpr"))
        kept = []
        for site in self.sites:
            i = bisect.bisect_left(begins, site.begin)
            start = self.statementStart(i)
            head = self.tokens[start:i]
            words = {token.text for token in head}
            around = {word for begin, end, word in blocks if begin < site.begin < end}
            if "enum" in around or words & FIXED:
                continue
            if "if" in words and "constexpr" in words:
                continue
            site.in_constexpr = "constexpr" in around
            if "constexpr" in words:
                word = next(token for token in head if token.text == "constexpr")
                site.constant = (word.begin, word.end)
            kept.append(site)
        kept.sort(key=lambda site: (site.begin, -site.end, KINDS.index(site.kind)))
        return kept


def greater(number):
    plain = number.replace("'", "")
    if match := INTEGER.match(plain):
        if len(match[1]) > 1 and match[1][0] == "0" and match[1][1] not in "xXbB":
            return None  # octal
        value = int(match[1], 0) + 1
        return (hex(value) if match[1][:2] in ("0x", "0X") else str(value)) + match[2]
    if match := REAL.match(plain):
        return f"{float(match[1]) + 1!r}{match[2]}"
    return None


def sitesOf(text, file=None):
    reader = Reader(text)
    reader.findOperators()
    reader.findConstants()
    reader.findChecks()
    reader.findTables()
    found = reader.finish()
    for site in found:
        site.file = file
    return found


def built(text, numbered, include):
    """The text with the sites of `numbered`, (number, Site), chosen at run time. Lines keep their numbers. Sites lie
    beside or inside of each other; those that cross another one are left out, and returned."""
    inside, crossing = [], []
    for number, site in sorted(numbered, key=lambda pair: (pair[1].begin, -pair[1].end)):
        if any(a.begin < site.begin < a.end < site.end for _, a in inside):
            crossing.append(number)
        else:
            inside.append((number, site))
    edits = {}
    for _, site in inside:
        if site.constant:
            has_const = re.match(r"\s+const\b", text[site.constant[1]:])
            edits[site.constant[0]] = (site.constant[1], "" if has_const else "const")

    def render(begin, end, sites):
        out, at = [], begin
        while sites:
            number, site = sites[0]
            within = [pair for pair in sites[1:] if pair[1].end <= site.end and pair[1].begin >= site.begin]
            out.append(plain(at, site.begin))
            original = render(site.begin, site.end, within)
            test = f"rung_mutant{'_constexpr' if site.in_constexpr else ''}({number})"
            if site.kind == "check":
                out.append(f"({test} ? false : bool({original}))")  # a condition may be a pointer
            else:
                out.append(f"({test} ? ({oneLine(site.mutated)}) : ({original}))")
            at = site.end
            sites = sites[1 + len(within):]
        out.append(plain(at, end))
        return "".join(out)

    def plain(begin, end):
        out, at = [], begin
        for edit in sorted(edit for edit in edits if begin <= edit < end):
            out += [text[at:edit], edits[edit][1]]
            at = edits[edit][0]
        return "".join(out) + text[at:end]

    return f'#include "{include}"\n#line 1\n' + render(0, len(text), inside), crossing

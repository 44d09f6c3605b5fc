"""Where a C++ file can be mutated, and how.

It reads code in Google's format: a binary operator has white space on both sides, the bracket of a template and a sign
have not. Whatever it takes for what it is not fails to compile and is dropped (build.py)."""

import re
from dataclasses import dataclass, field

from tokens import tokenize

OPERATORS = {  # what the runtime calls it, and the mutations
    "<": ("Less", ["<=", ">="]), ">": ("Greater", [">=", "<="]),
    "<=": ("LessEqual", ["<", ">"]), ">=": ("GreaterEqual", [">", "<"]),
    "==": ("Equal", ["!="]), "!=": ("Unequal", ["=="]),
    "+": ("Plus", ["-"]), "-": ("Minus", ["+"]), "*": ("Times", ["/"]), "/": ("Over", ["*"]), "%": ("Modulo", ["*"]),
}
_ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
_STATEMENT_WORDS = {"return", "throw", "else", "do", "co_return", "co_yield", "case"}
_NO_CALLS = {"if", "for", "while", "switch", "return", "sizeof", "catch", "static_assert", "assert", "defined"}
_SKIPPED_CALLS = {"static_assert", "assert", "alignas", "sizeof", "decltype", "noexcept"}
_NUMERIC = r"(?:double|float|int|long|std::size_t|std::u?int\d+_t)"
_MEMBER = re.compile(rf"^\s+(?:{_NUMERIC}|bool) \w+ = [^;{{}}\"]*;")


@dataclass
class Site:
    line: int
    column: int
    original: str
    mutations: list  # texts: one mutant each
    # ("open" | "close", offset, the extent's other end, text) or ("replace", start, end, text); {0}, {1} … in a text
    # are the mutants' numbers. Of edits with the same extent, those of a logical operator stand inside.
    edits: list = field(default_factory=list)


class Finder:
    def __init__(self, text, constants=()):
        self.text = text
        self.tokens = tokenize(text)
        self.constants = dict(constants) | constants_of(text)
        self.skipped = self._skipped()
        self.sites = []

    def find(self):
        for i, token in enumerate(self.tokens):
            if self.skipped[i]:
                continue
            if token.kind == "number":
                self._number(i)
            elif token.kind == "word":
                self._word(i)
            elif token.kind == "mark":
                self._mark(i)
        self.sites.sort(key=lambda site: (site.line, site.column))
        return self.sites

    # --- what is no code that runs -------------------------------------------------------------------------------
    def _skipped(self):
        skipped = [False] * len(self.tokens)

        def skip(first, last):
            for k in range(first, min(last, len(self.tokens) - 1) + 1):
                skipped[k] = True

        for i, token in enumerate(self.tokens):
            after = self.tokens[i + 1] if i + 1 < len(self.tokens) else None
            if token.text in ("constexpr", "consteval", "constinit"):
                is_condition = i > 0 and self.tokens[i - 1].text == "if"
                skip(i, after.match if is_condition else self._end_of_declaration(i))
            elif token.text in ("using", "case", "concept", "requires", "typedef"):
                stop = {"case": ":", "requires": "{"}.get(token.text, ";")
                k = i
                while k < len(self.tokens) - 1 and self.tokens[k].text not in (stop, ";"):
                    k += 1
                skip(i, k - 1)
            elif token.text == "enum":
                skip(i, self._end_of_declaration(i))
            elif token.text in _SKIPPED_CALLS and after and after.text == "(":
                skip(i, after.match)
            elif token.text == "[" and after and after.text == "[":
                skip(i, token.match)
            elif token.text == "template" and after and after.text == "<":
                skip(i, self._end_of_template(i + 1))
            elif token.text == "<" and not token.spaced_left and i > 0 and self.tokens[i - 1].kind == "word":
                skip(i, self._end_of_template(i))
        return skipped

    def _end_of_declaration(self, i):
        """Of one that begins at i: its semicolon, or the brace that closes its body."""
        k = i
        while k < len(self.tokens) - 1:
            token = self.tokens[k]
            if token.text == ";":
                return k
            if token.match > k:
                k = token.match
                following = self.tokens[k + 1].text if k + 1 < len(self.tokens) else ""
                if token.text == "{" and following not in (";", ",", "(", ")", "[", ".", "{"):
                    return k
            k += 1
        return k

    def _end_of_template(self, i):
        depth, k = 0, i
        while k < len(self.tokens):
            text = self.tokens[k].text
            if text == "<":
                depth += 1
            elif text == ">":
                depth -= 1
                if depth == 0:
                    return k
            elif text == ";":
                return i  # no template after all
            elif self.tokens[k].match > k:
                k = self.tokens[k].match
            k += 1
        return i

    # --- operands ------------------------------------------------------------------------------------------------
    def _left_extent(self, i, stops):
        """The first token of the left operand of a loosely binding operator at i."""
        k = i - 1
        while k >= 0:
            token = self.tokens[k]
            if token.text in stops or token.text in (";", ",", "?", ":", "(", "[", "{") or token.text in _ASSIGNMENTS \
                    or token.text in _STATEMENT_WORDS:
                break
            if token.text == "}" and self.tokens[token.match].spaced_left:
                break  # of a block
            k = token.match - 1 if token.text in (")", "]", "}") else k - 1
        return k + 1

    def _right_extent(self, i, stops):
        k = i + 1
        while k < len(self.tokens):
            token = self.tokens[k]
            if token.text in stops or token.text in (";", ",", "?", ":", ")", "]", "}"):
                break
            k = token.match + 1 if token.match > k else k + 1
        return k - 1

    # --- kinds of sites ------------------------------------------------------------------------------------------
    def _add(self, i, original, mutations, edits):
        start = self.tokens[i].start
        line = self.text.count("\n", 0, start) + 1
        column = start - self.text.rfind("\n", 0, start)
        self.sites.append(Site(line, column, original, mutations, edits))

    def _around(self, first, last, before, after):
        start, end = self.tokens[first].start, self.tokens[last].end
        return [("open", start, end, before), ("close", end, start, after)]

    def _replace(self, i, text):
        return [("replace", self.tokens[i].start, self.tokens[i].end, text)]

    def _choice(self, i, original, mutations):
        """The token is one of several expressions of the same type."""
        text = "".join(f"etude_mutation::On({{{k}}}) ? ({m}) : " for k, m in enumerate(mutations))
        self._add(i, original, mutations, self._replace(i, f"({text}{original})"))

    def _number(self, i):
        text = self.tokens[i].text
        if "_" in text:
            return
        if re.fullmatch(r"\d[\d']*[uUlLzZ]*", text):
            value = int(re.sub(r"\D", "", text))
            self._choice(i, text, ["0 + 1"] if value == 0 else ["0", "1 + 1"] if value == 1 else [f"{text} / 4", f"{text} + 1"])
        elif not text.lower().startswith("0x"):
            is_zero = float(re.sub("[fFlL']", "", text)) == 0
            self._choice(i, text, [f"{text} + 1" if is_zero else f"{text} / 4"])

    def _word(self, i):
        token, before = self.tokens[i], self.tokens[i - 1].text if i > 0 else ";"
        after = self.tokens[i + 1].text if i + 1 < len(self.tokens) else ""
        if token.text in ("true", "false"):
            self._choice(i, token.text, ["!" + token.text])
        elif token.text in self.constants and before not in ("::", ".", "->") and after not in ("(", "::"):
            name, kind = token.text, self.constants[token.text]
            self._choice(i, name, {"real": [f"{name} / 4"], "zero": [f"{name} + 1"]}.get(kind, [f"{name} + 1", f"0 * {name}"]))
        elif token.text in ("min", "max") and before == "::" and self.tokens[i - 2].text == "std" and after == "(":
            other = "max" if token.text == "min" else "min"
            edits = [("replace", self.tokens[i - 2].start, token.end,
                      f"etude_mutation::{token.text.title()}<{{0}}>{{{{}}}}")]
            self._add(i, "std::" + token.text, ["std::" + other], edits)
        elif token.text in ("if", "while") and after == "(":
            self._condition(i)
        if before in (";", "{", "}", ")", "else"):
            self._statement(i)

    def _condition(self, i):
        opening = self.tokens[i + 1]
        inner = range(i + 2, opening.match)
        semicolons = [k for k in inner if self.tokens[k].text == ";" and self.tokens[k].inside == i + 1]
        first = semicolons[-1] + 1 if semicolons else i + 2
        if any(self.tokens[k].text == "=" and self.tokens[k].inside == i + 1 for k in range(first, opening.match)):
            return  # declares what it tests
        before = "!etude_mutation::On({1}) && etude_mutation::On({0}) != static_cast<bool>("
        edits = self._around(first, opening.match - 1, before, ")")
        word = self.tokens[i].text
        self._add(i, f"{word} (c)", [f"{word} (!(c))", f"{word} (false)"], edits)

    def _statement(self, i):
        """`Call(…);` or `variable = …;` left out."""
        if self.tokens[i].inside >= 0 and self.tokens[self.tokens[i].inside].text != "{":
            return
        if self.tokens[i].text in _NO_CALLS or self.tokens[i].text.isupper():
            return
        if self.tokens[i - 1].text == ")" and not self._is_control(self.tokens[i - 1].match):
            return
        k, called = i, False
        while k < len(self.tokens):
            token, following = self.tokens[k], self.tokens[k + 1].text if k + 1 < len(self.tokens) else ""
            called = token.text == "("
            if token.text in ("(", "["):
                k, following = token.match, self.tokens[token.match + 1].text if token.match + 1 < len(self.tokens) else ""
            elif not (token.kind == "word" or token.text in (".", "->", "::")) or (k > i and token.spaced_left):
                return
            if following == ";" and called or following in _ASSIGNMENTS:
                break
            k += 1
        end = k + 1
        while end < len(self.tokens) and self.tokens[end].text != ";":
            end = self.tokens[end].match + 1 if self.tokens[end].match > end else end + 1
        if end + 1 >= len(self.tokens) or self.tokens[end + 1].text == "else":
            return
        statement = self.text[self.tokens[i].start : self.tokens[end].end]
        edit = ("open", self.tokens[i].start, self.tokens[end].end, "if (!etude_mutation::On({0})) ")
        self._add(i, " ".join(statement.split()), ["(nothing)"], [edit])

    def _is_control(self, parenthesis):
        return parenthesis > 0 and self.tokens[parenthesis - 1].text in ("if", "for", "while", "constexpr")

    def _mark(self, i):
        token = self.tokens[i]
        if i == 0 or i + 1 == len(self.tokens):
            return
        before, after = self.tokens[i - 1], self.tokens[i + 1]
        spaced = token.spaced_left and token.spaced_right
        if token.text in ("&&", "||") and spaced:
            self._logical(i)
        elif token.text in OPERATORS and spaced and "string" not in (before.kind, after.kind):
            name, mutations = OPERATORS[token.text]
            text = f"{token.text} etude_mutation::{name}<{{0}}>{{{{}}}} {token.text}"
            self._add(i, token.text, mutations, self._replace(i, text))
        elif token.text in ("+=", "-=", "*=", "/=") and after.kind != "string":
            wrapper = "Opposite" if token.text in ("+=", "-=") else "Inverse"
            other = {"+": "-=", "-": "+=", "*": "/=", "/": "*="}[token.text[0]]
            edits = self._around(i + 1, self._right_extent(i, ()), f"etude_mutation::{wrapper}<{{0}}>(", ")")
            self._add(i, token.text, [other], edits)
        elif token.text == "-" and not token.spaced_right and after.kind != "number" and (
                before.text in OPERATORS or before.text in _ASSIGNMENTS or before.text in ("(", ",", "{", "?", ":", "return")):
            self._add(i, "-x", ["x"], self._replace(i, "etude_mutation::Negation<{0}>{{}}->*"))
        elif token.text == "?" and spaced:
            first = self._left_extent(i, ())
            self._add(i, "c ?", ["!(c) ?"], self._around(first, i - 1, "(etude_mutation::On({0}) != static_cast<bool>(", "))"))

    def _logical(self, i):
        text = self.tokens[i].text
        left = self._left_extent(i, ("||",) if text == "&&" else ())
        right = self._right_extent(i, ("||", "&&") if text == "&&" else ("||",))
        if left >= i or right <= i:
            return
        name = "And" if text == "&&" else "Or"
        start, end = self.tokens[left].start, self.tokens[right].end
        edits = [("open", start, end, f"etude_mutation::{name}({{0}}, static_cast<bool>("),
                 ("replace", self.tokens[i].start, self.tokens[i].end, "), [&]() -> bool {{ return static_cast<bool>("),
                 ("close", end, start, "); }})")]
        self._add(i, text, ["||" if text == "&&" else "&&"], edits)


def constants_of(text):
    """The named numbers that a file declares: name → "real", "whole", or "zero"."""
    found = {}
    for kind, name, value in re.findall(rf"\bconstexpr ({_NUMERIC}) (k\w+) = ([^;]*);", text):
        real = kind in ("double", "float")
        found[name] = "zero" if re.fullmatch(r"0(\.0)?", value) else "real" if real else "whole"
    return found


def find_sites(text, header_text=""):
    """The sites of a source file, which also uses the constants of its own header."""
    return Finder(text, constants_of(header_text)).find()


def find_defaults(text):
    """The sites of a header: what members are by default, other than nothing (which is there to be overwritten)."""
    lines, sites = text.split("\n"), []
    for site in Finder(text).find():
        if _MEMBER.match(lines[site.line - 1]) and re.fullmatch(r"[\d.'e+-]*[1-9][\d.'e+-]*|true", site.original):
            sites.append(site)
    return sites


def rewrite(text, numbered):
    """The text with sites in it: `numbered` are pairs of a site and the number of its first mutant."""
    opens, closes, replaced = {}, {}, {}
    for site, first in numbered:
        numbers = range(first, first + max(2, len(site.mutations)))
        for what, at, other, template in site.edits:
            new = template.format(*numbers)
            if what == "replace":
                replaced[at] = (other, new)
            else:
                inner = site.original in ("&&", "||")
                (opens if what == "open" else closes).setdefault(at, []).append((-other, inner, new))
    out, at = [], 0
    while at <= len(text):
        out += [new for *_, new in sorted(closes.get(at, []), key=lambda e: (e[0], not e[1]))]  # the narrowest first
        out += [new for *_, new in sorted(opens.get(at, []), key=lambda e: e[:2])]  # the widest first
        if at in replaced:
            at, new = replaced[at]
            out.append(new)
        elif at < len(text):
            out.append(text[at])
            at += 1
        else:
            break
    return "".join(out)

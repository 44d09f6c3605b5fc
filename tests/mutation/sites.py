"""Finds the places at which a C++ file can be mutated, and the mutations.

It reads code in Google's format: a binary operator has white space on both sides; a template's bracket and a sign
have none. If it confuses them, the mutant does not compile and is dropped (shadow.py)."""

import re
from dataclasses import dataclass, field

from source import ASSIGNMENTS, Code

OPERATORS = {  # the runtime's name, and the mutations
    "<": ("Less", ["<=", ">="]), ">": ("Greater", [">=", "<="]),
    "<=": ("LessEqual", ["<", ">"]), ">=": ("GreaterEqual", [">", "<"]),
    "==": ("Equal", ["!="]), "!=": ("Unequal", ["=="]),
    "+": ("Plus", ["-"]), "-": ("Minus", ["+"]), "*": ("Times", ["/"]), "/": ("Over", ["*"]), "%": ("Modulo", ["*"]),
}
_BEFORE_SIGNS = {*OPERATORS, *ASSIGNMENTS, "(", ",", "{", "?", ":", "return"}
_NO_CALLS = {"if", "for", "while", "switch", "return", "sizeof", "catch", "static_assert", "assert", "defined"}
_NUMERIC = r"(?:double|float|int|long|std::size_t|std::u?int\d+_t)"
_MEMBER = re.compile(rf"^\s+(?:{_NUMERIC}|bool) \w+ = [^;{{}}\"]*;")


@dataclass
class Site:
    line: int
    column: int
    original: str
    mutations: list  # one text per mutant
    # Tuples ("open" or "close", offset, offset of the extent's other end, inserted text) and ("replace", start, end,
    # new text). In texts, {0}, {1} … stand for the mutants' numbers. Where several sites have the same extent,
    # rewrite.py inserts a logical operator's texts inside the others.
    edits: list = field(default_factory=list)


class Finder(Code):
    def __init__(self, text, constants=()):
        super().__init__(text)
        self.constants = dict(constants) | constants_of(text)
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
        """Adds a token that is one of several expressions of the same type."""
        text = "".join(f"etude_mutation::On({{{k}}}) ? ({m}) : " for k, m in enumerate(mutations))
        self._add(i, original, mutations, self._replace(i, f"({text}{original})"))

    def _number(self, i):
        text = self.tokens[i].text
        if "_" in text:
            return
        if re.fullmatch(r"\d[\d']*[uUlLzZ]*", text):
            value = int(re.sub(r"\D", "", text))
            others = {0: ["0 + 1"], 1: ["0", "1 + 1"]}
            self._choice(i, text, others.get(value, [f"{text} / 4", f"{text} + 1"]))
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
            others = {"real": [f"{name} / 4"], "zero": [f"{name} + 1"], "whole": [f"{name} + 1", f"0 * {name}"]}
            self._choice(i, name, others[kind])
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
            return  # the condition declares a variable
        before = "!etude_mutation::On({1}) && etude_mutation::On({0}) != static_cast<bool>("
        edits = self._around(first, opening.match - 1, before, ")")
        word = self.tokens[i].text
        self._add(i, f"{word} (c)", [f"{word} (!(c))", f"{word} (false)"], edits)

    def _statement(self, i):
        """Adds the removal of `Call(…);` or `variable = …;`."""
        if not self._is_in_body(self.tokens[i].inside):
            return
        if self.tokens[i].text in _NO_CALLS or self.tokens[i].text.isupper():
            return
        if self.tokens[i - 1].text == ")" and not self._is_control(self.tokens[i - 1].match):
            return
        k, called = i, False
        while k < len(self.tokens):
            token = self.tokens[k]
            called = token.text == "("
            if token.text in ("(", "["):
                k = token.match
            elif not (token.kind == "word" or token.text in (".", "->", "::")) or (k > i and token.spaced_left):
                return
            following = self.tokens[k + 1].text if k + 1 < len(self.tokens) else ""
            if following == ";" and called or following in ASSIGNMENTS:
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

    def _is_in_body(self, brace):
        """Returns true if the bracket encloses statements, not a class or namespace."""
        if brace < 0 or self.tokens[brace].text != "{":
            return False
        k = brace - 1
        while k >= 0 and self.tokens[k].text not in (";", "{", "}", "(", ")"):
            if self.tokens[k].text in ("namespace", "class", "struct", "union"):
                return False
            k -= 1
        return True

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
            edits = self._around(i + 1, self.right_extent(i, ()), f"etude_mutation::{wrapper}<{{0}}>(", ")")
            self._add(i, token.text, [other], edits)
        elif token.text == "-" and not token.spaced_right and after.kind != "number" and before.text in _BEFORE_SIGNS:
            self._add(i, "-x", ["x"], self._replace(i, "etude_mutation::Negation<{0}>{{}}->*"))
        elif token.text == "?" and spaced:
            first = self.left_extent(i, ())
            edits = self._around(first, i - 1, "(etude_mutation::On({0}) != static_cast<bool>(", "))")
            self._add(i, "c ?", ["!(c) ?"], edits)

    def _logical(self, i):
        text = self.tokens[i].text
        left = self.left_extent(i, ("||",) if text == "&&" else ())
        right = self.right_extent(i, ("||", "&&") if text == "&&" else ("||",))
        if left >= i or right <= i:
            return
        name = "And" if text == "&&" else "Or"
        start, end = self.tokens[left].start, self.tokens[right].end
        edits = [("open", start, end, f"etude_mutation::{name}({{0}}, static_cast<bool>("),
                 ("replace", self.tokens[i].start, self.tokens[i].end, "), [&]() -> bool {{ return static_cast<bool>("),
                 ("close", end, start, "); }})")]
        self._add(i, text, ["||" if text == "&&" else "&&"], edits)


def constants_of(text):
    """Returns the named numbers that a file declares: name → "real", "whole", or "zero"."""
    found = {}
    for kind, name, value in re.findall(rf"\bconstexpr ({_NUMERIC}) (k\w+) = ([^;]*);", text):
        real = kind in ("double", "float")
        found[name] = "zero" if re.fullmatch(r"0(\.0)?", value) else "real" if real else "whole"
    return found


def find_sites(text, header_text=""):
    """Returns the sites of a source file, which also uses the constants of its header."""
    return Finder(text, constants_of(header_text)).find()


def find_defaults(text):
    """Returns the sites of a header: the defaults of members, except zero values, which code overwrites."""
    lines, sites = text.split("\n"), []
    for site in Finder(text).find():
        if _MEMBER.match(lines[site.line - 1]) and re.fullmatch(r"[\d.'e+-]*[1-9][\d.'e+-]*|true", site.original):
            sites.append(site)
    return sites

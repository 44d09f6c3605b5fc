"""Splits C++ into tokens, as far as the mutator needs."""

import re
from dataclasses import dataclass

_PATTERNS = [
    ("space", r"\s+"),
    ("comment", r"//[^\n]*|/\*.*?\*/"),
    ("directive", r"^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*"),
    ("string", r'(?:u8|[uUL])?R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"|(?:u8|[uUL])?"(?:\\.|[^"\\\n])*"'),
    ("number", r"\.?\d(?:[eEpP][+-]|'?[\w.])*"),
    ("char", r"(?:u8|[uUL])?'(?:\\.|[^'\\\n])+'"),
    ("word", r"[A-Za-z_]\w*"),
    ("mark", r"<=>|<<=|>>=|\.\.\.|->\*|->|::|\+\+|--|&&|\|\||<<|[-+*/%&|^<>=!]=|."),
]
_TOKEN = re.compile("|".join(f"(?P<{kind}>{pattern})" for kind, pattern in _PATTERNS), re.DOTALL | re.MULTILINE)


@dataclass
class Token:
    kind: str  # string, number, char, word or mark
    text: str
    start: int  # offset of the first character
    spaced_left: bool  # follows white space or a comment
    spaced_right: bool
    match: int = -1  # for a bracket, its partner's index
    inside: int = -1  # index of the enclosing bracket: ( [ or {

    @property
    def end(self):
        return self.start + len(self.text)


def tokenize(text):
    """Returns the tokens of a C++ file without white space, comments and directives; brackets are matched."""
    tokens, gap = [], True
    for found in _TOKEN.finditer(text):
        if found.lastgroup in ("space", "comment", "directive"):
            gap = True
            if tokens:
                tokens[-1].spaced_right = True
            continue
        kind = "string" if found.lastgroup == "d" else found.lastgroup
        tokens.append(Token(kind, found.group(), found.start(), gap, False))
        gap = False
    _match_brackets(tokens)
    return tokens


def _match_brackets(tokens):
    closes, open_ones = {"(": ")", "[": "]", "{": "}"}, []
    for index, token in enumerate(tokens):
        if token.kind == "mark" and token.text in ")]}":
            if not open_ones or closes[tokens[open_ones[-1]].text] != token.text:
                raise ValueError(f"unmatched '{token.text}' at offset {token.start}")
            partner = open_ones.pop()
            tokens[partner].match, token.match = index, partner
        token.inside = open_ones[-1] if open_ones else -1
        if token.kind == "mark" and token.text in ("(", "[", "{"):
            open_ones.append(index)
    if open_ones:
        raise ValueError(f"unmatched '{tokens[open_ones[-1]].text}' at offset {tokens[open_ones[-1]].start}")

"""Finds the executed code of a C++ file, and the operands of its loosely binding operators."""

from tokens import tokenize

ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
_STATEMENT_WORDS = {"return", "throw", "else", "do", "co_return", "co_yield", "case"}
_SKIPPED_CALLS = {"static_assert", "assert", "alignas", "sizeof", "decltype", "noexcept"}


class Code:
    def __init__(self, text):
        self.text = text
        self.tokens = tokenize(text)
        self.skipped = self._skipped()

    # --- code that does not run ----------------------------------------------------------------------------------
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
        """Returns the end of a declaration that begins at i: its semicolon, or the brace that closes its body."""
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
                return i  # not a template after all
            elif self.tokens[k].match > k:
                k = self.tokens[k].match
            k += 1
        return i

    # --- operands ------------------------------------------------------------------------------------------------
    def left_extent(self, i, stops):
        """Returns the first token of the left operand of a loosely binding operator at i."""
        k = i - 1
        while k >= 0:
            token = self.tokens[k]
            if token.text in stops or token.text in (";", ",", "?", ":", "(", "[", "{") or token.text in ASSIGNMENTS \
                    or token.text in _STATEMENT_WORDS:
                break
            if token.text == "}" and self.tokens[token.match].spaced_left:
                break  # the brace opens a block
            k = token.match - 1 if token.text in (")", "]", "}") else k - 1
        return k + 1

    def right_extent(self, i, stops):
        k = i + 1
        while k < len(self.tokens):
            token = self.tokens[k]
            if token.text in stops or token.text in (";", ",", "?", ":", ")", "]", "}"):
                break
            k = token.match + 1 if token.match > k else k + 1
        return k - 1

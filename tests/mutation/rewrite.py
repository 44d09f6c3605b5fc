"""Rewrites a file with all its mutants at once."""


def rewrite(text, numbered):
    """Returns the text with its sites rewritten; `numbered` are pairs of a site and its first mutant's number."""
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
        out += [new for *_, new in sorted(closes.get(at, []), key=lambda e: (e[0], not e[1]))]  # the innermost first
        out += [new for *_, new in sorted(opens.get(at, []), key=lambda e: e[:2])]  # the outermost first
        if at in replaced:
            at, new = replaced[at]
            out.append(new)
        elif at < len(text):
            out.append(text[at])
            at += 1
        else:
            break
    return "".join(out)

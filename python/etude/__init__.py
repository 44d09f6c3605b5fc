"""Etude from Python: runs as tables, your own methods, scenarios run from a notebook (docs/python.md).

The package needs only the standard library, and imports each of its modules when this module is first used. It uses
numpy, pandas and matplotlib if they are installed.
"""
import importlib

__version__ = "0.4.0"

_HOMES = {
    "etude.program": ("EtudeError", "find_program"),
    "etude.results": ("load", "Run", "Table", "Column", "Pairs", "Answer", "Verdict", "Motion", "Series"),
    "etude.catalogue": ("metrics", "joints"),
    "etude.commands": ("run", "report", "gate", "compare", "score"),
    "etude.evaluation": ("evaluate", "DoubtWarning", "LimitWarning"),
    "etude.conversation": ("method", "metric", "serve", "NoAnswer"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
__all__ = [*_HOME_OF, "engine", "plot", "problems"]


def __getattr__(name):
    if name in _HOME_OF:
        return getattr(importlib.import_module(_HOME_OF[name]), name)
    if name in ("engine", "plot", "problems"):
        return importlib.import_module("etude." + name)
    if name[:1].isupper():  # IkProblem, CoachPolicyAnswer, …
        problems = importlib.import_module("etude.problems")
        if hasattr(problems, name):
            return getattr(problems, name)
    raise AttributeError(f"etude has no {name!r}; it has {', '.join(__all__)}, and the classes of etude.problems")


def __dir__():
    return __all__

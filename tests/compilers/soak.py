"""Compiles with other compilers and optimisation levels, and finds the results that are equal to the last bit. See
README.md."""

import argparse
import json
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILDS = {
    "gcc -O2": ["-DCMAKE_CXX_COMPILER=g++"],
    "gcc -O1": ["-DCMAKE_CXX_COMPILER=g++", "-DETUDE_OPTIMISE=-O1"],
    "gcc -O3": ["-DCMAKE_CXX_COMPILER=g++", "-DETUDE_OPTIMISE=-O3"],
    "clang -O1": ["-DCMAKE_CXX_COMPILER=clang++", "-DETUDE_OPTIMISE=-O1"],
    "clang -O2": ["-DCMAKE_CXX_COMPILER=clang++"],
    "clang -O3": ["-DCMAKE_CXX_COMPILER=clang++", "-DETUDE_OPTIMISE=-O3"],
}
YARDSTICK = "gcc -O2"


def arguments(words=None):
    about = "Builds etude by other compilers and at other levels and compares every cell's row with gcc -O2's."
    parser = argparse.ArgumentParser(prog="scripts/soak compilers", description=about)
    parser.add_argument("--only", nargs="+", default=list(BUILDS), choices=BUILDS, metavar="BUILD", help="such as 'clang -O2'")
    parser.add_argument("--program", nargs="+", default=[], metavar="BUILD=PATH", help="built already; any name will do")
    parser.add_argument("--suite", default="scenarios/quick", help="what is run (default: %(default)s)")
    parser.add_argument("--trials", type=int, help="of each scenario; else its own")
    return parser.parse_args(words)


def build(name):
    """Builds the program in a folder of its own; returns its path."""
    folder = ROOT / "build" / ("compilers-" + name.replace(" -", "-"))
    subprocess.run(["cmake", "--preset", "release", "-B", folder, *BUILDS[name]], cwd=ROOT, check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder, "etude"], cwd=ROOT, check=True)
    return folder / "etude"


def rows_of(program, options, folder):
    """Runs the suite; returns the cells' lines by scenario."""
    trials = ["--trials", str(options.trials)] if options.trials else []
    subprocess.run([program, "run", options.suite, *trials, "-o", folder], cwd=ROOT, check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    scenarios = {}
    for line in (folder / "cells.jsonl").read_text().splitlines():
        scenarios.setdefault(json.loads(line)["scenario"], []).append(line)
    return scenarios


def first_difference(line, other):
    """Returns the first stage whose digest differs, or the first value; None if the lines are equal."""
    if line == other:
        return None
    row, changed = json.loads(line), json.loads(other)
    differing = [key for key in row if row[key] != changed.get(key)]
    stages = [key.removeprefix("digest_") for key in differing if key.startswith("digest_")]
    return next(iter(stages + differing), "more values")


def compare(rows, other):
    """Returns per scenario the number of equal rows, of all rows, and the stages at which others first differ."""
    table = {}
    for scenario, lines in rows.items():
        others = other.get(scenario, [])
        first = [first_difference(*pair) for pair in zip(lines, others)]
        differing = Counter(stage for stage in first if stage is not None)
        differing["missing"] += abs(len(lines) - len(others))
        table[scenario] = {"rows": len(lines), "same": first.count(None), "first": dict(sorted((+differing).items()))}
    return table


def run(options, kept_in=HERE):
    programs = dict(word.rsplit("=", 1) for word in options.program)
    for name in options.only if not programs else []:
        programs[name] = build(name)
    figure = kept_in / "figure.json"
    kept = json.loads(figure.read_text()) if figure.exists() else {}
    with tempfile.TemporaryDirectory() as folder:
        rows = {name: rows_of(Path(program).resolve(), options, Path(folder) / str(i))
                for i, (name, program) in enumerate(programs.items())}
    if YARDSTICK not in rows:
        raise SystemExit(f"scripts/soak compilers: nothing to compare with: {YARDSTICK} is missing")
    for name in rows:
        if name == YARDSTICK:
            continue
        kept[name] = compare(rows[YARDSTICK], rows[name])
        for scenario, found in kept[name].items():
            print(f"{name:12} {scenario:24} {found['same']:>5} of {found['rows']:>5} the same  {found['first'] or ''}")
    figure.with_suffix(".new").write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n")
    figure.with_suffix(".new").rename(figure)


if __name__ == "__main__":
    run(arguments())

"""For each library, tunes the transition method `played` on all other libraries, and judges it on this one.

    scripts/soak transitions [--library NAME=CLIPS]... [--trials N] [--etude PROGRAM] [--keep FILE]

Every library is a condition of its own. The two weights of `played` are searched on a grid: the weights with which
transitions are most often clean on all *other* libraries are chosen (mean of libraries, 100 requests each, seed 2), and
judged on the library that was left out, with other requests (seed 3). This takes a few minutes. --keep writes the
results as JSON.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

EXCESS = [0.1, 0.2, 0.4]
INVENTED = [2.5, 5.0, 10.0]
GRID = {f"e{e:g}-i{i:g}": (e, i) for e in EXCESS for i in INVENTED}
YARDSTICK = "unbroken"
TUNING_SEED, JUDGED_SEED = 2, 3
METRICS = ["clean_share", "clean_share_v3", "supported_share", "natural_share", "join_slide_cmps", "skipped_s"]

SCENARIO = """scenario: left-out
question: Do weights that were chosen on other libraries hold on this one?
task: transition
libraries:
  moves: ['builtin:*']
  acts: ['builtin:acts']
  captured: ['/usr/share/assimp/models/BVH/*.bvh']
methods:
""" + "".join(f"  - {{name: {name}, choice: played, join: planted-feet, excess_per_s: {e:g}, invented_per_s: {i:g}}}\n"
              for name, (e, i) in GRID.items()) + f"  - {{name: {YARDSTICK}, choice: unbroken}}\n"


class Rows:
    """The values of (library, method, metric) of one run; failed requests count as the task defines."""

    def __init__(self, lines):
        self.values = {}
        for row in map(json.loads, lines):
            if row["status"] == "skipped":
                continue
            for metric in METRICS:
                if row[metric] is not None:
                    self.values.setdefault((row["library"], row["method"], metric), []).append(row[metric])
        self.libraries = list(dict.fromkeys(key[0] for key in self.values))

    def mean(self, library, method, metric):
        return statistics.fmean(self.values[library, method, metric])

    def count(self, library):
        return len(self.values[library, YARDSTICK, METRICS[0]])


def chosen_without(rows, left_out):
    """Returns the grid's method that is clean most often on all libraries but one; the first of equal ones."""
    others = [library for library in rows.libraries if library != left_out]
    if not others:
        raise ValueError("two libraries are needed at least")
    return max(GRID, key=lambda method: statistics.fmean(rows.mean(one, method, "clean_share") for one in others))


def judge(tuning, judged):
    """Returns each library's results with the weights that the other libraries chose."""
    table = []
    for library in judged.libraries:
        method = chosen_without(tuning, library)
        line = {"library": library, "requests": judged.count(library), "excess_per_s": GRID[method][0],
                "invented_per_s": GRID[method][1]}
        for metric in METRICS:
            line[metric] = judged.mean(library, method, metric)
            line[f"unbroken_{metric}"] = judged.mean(library, YARDSTICK, metric)
        table.append(line)
    return table


def printed(table):
    lines = [f"{'library':<14}{'requests':>9}{'excess':>8}{'invented':>9}{'natural':>9}{'clean':>7}{'slide':>7}"
             f"   unbroken: {'clean':>6}{'slide':>7}"]
    for one in [*table, mean_of(table)]:
        lines.append(f"{one['library']:<14}{one.get('requests', ''):>9}{one.get('excess_per_s', ''):>8}"
                     f"{one.get('invented_per_s', ''):>9}{100 * one['natural_share']:>8.0f}%"
                     f"{100 * one['clean_share']:>6.0f}%{one['join_slide_cmps']:>7.1f}             "
                     f"{100 * one['unbroken_clean_share']:>5.0f}%{one['unbroken_join_slide_cmps']:>7.1f}")
    return "\n".join(lines)


def mean_of(table):
    means = [key for key in table[0] if key.removeprefix("unbroken_") in METRICS]
    return {"library": "mean", **{key: statistics.fmean(line[key] for line in table) for key in means}}


def kept(table, trials):
    """Returns the table for scripts/figures: pages bind `left-out/library=NAME/played/METRIC, mean`, shares with `,
    times 100`."""
    figures = {}
    for line in [*table, mean_of(table)]:
        for metric in METRICS:
            is_share = metric.endswith("_share")
            for method, key in (("played", metric), (YARDSTICK, f"unbroken_{metric}")):
                path = f"left-out/library={line['library']}/{method}/{metric}, mean" + (", times 100" if is_share else "")
                figures[path] = line[key] * (100 if is_share else 1)
    weights = {line["library"]: [line["excess_per_s"], line["invented_per_s"]] for line in table}
    return {"runs": [{"suite": "left-out", "seed": seed, "trials": trials} for seed in (TUNING_SEED, JUDGED_SEED)],
            "weights": weights, "figures": figures}


def run(etude, scenario, seed, arguments, folder):
    command = [etude, "run", str(scenario), "--seed", str(seed), "--trials", str(arguments.trials), "-o", str(folder)]
    for library in arguments.library:
        command += ["--library", library]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"scripts/soak transitions: {done.stderr.strip()}")
    return Rows((folder / "cells.jsonl").read_text().splitlines())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", action="append", default=[], metavar="NAME=CLIPS")
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--etude", default="build/release/etude")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scenario = folder / "left_out.yaml"
        scenario.write_text(SCENARIO)
        tuning = run(arguments.etude, scenario, TUNING_SEED, arguments, folder / "tuning")
        judged = run(arguments.etude, scenario, JUDGED_SEED, arguments, folder / "judged")
    table = judge(tuning, judged)
    print(printed(table))
    if arguments.keep:
        arguments.keep.write_text(json.dumps(kept(table, arguments.trials), indent=1) + "\n")


if __name__ == "__main__":
    main()

"""Mutants of engine/ against the tests that mirror it: see README.md."""

import argparse
import json
import random
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import figure
from shadow import Shadow
from trials import judge, list_tests, record

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def arguments():
    about = "A seeded sample of the mutants of engine/, each against the tests of its folder. Killed, it goes on."
    parser = argparse.ArgumentParser(prog="scripts/soak mutation", description=about)
    parser.add_argument("--count", type=int, default=300, help="mutants in the sample (default: %(default)s)")
    parser.add_argument("--hours", type=float, help="stop after this time, with the figure of what was tried")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=2, help="tests and compilers at once (default: %(default)s)")
    parser.add_argument("--only", nargs="+", default=["engine"], metavar="FOLDER",
                        help="only mutants of these folders, such as engine/vision; the figure is then not kept")
    parser.add_argument("--keep", action="store_true", help="keep figure.json and survivors.json even so")
    return parser.parse_args()


def recorded(shadow, folders, digest, jobs):
    """Every test with what it reaches; from the last time, as far as that got."""
    path = shadow.work / f"reached-{digest}.jsonl"
    known = {}
    for line in complete_lines(path):
        entry = json.loads(line)
        known[entry["folder"], entry["name"]] = entry
    tests = list_tests(shadow.build, folders)
    missing = [test for test in tests if (test.folder, test.name) not in known]
    print(f"{len(tests)} tests, {len(missing)} to be recorded", flush=True)
    with path.open("a") as file, ThreadPoolExecutor(jobs) as pool:
        for test in pool.map(lambda t: record(t, shadow.tree), missing):
            entry = {"folder": test.folder, "name": test.name, "seconds": test.seconds}
            entry["reached"] = sorted(test.reached)
            known[test.folder, test.name] = entry
            file.write(json.dumps(entry) + "\n")
            file.flush()
    entries = [(test, known[test.folder, test.name]) for test in tests]
    return [replace(test, seconds=entry["seconds"], reached=frozenset(entry["reached"])) for test, entry in entries]


def complete_lines(path):
    """Those of a file whose last line may be cut off, which is then removed."""
    if not path.exists():
        return []
    text = path.read_text()
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        path.write_text(whole)
    return whole.splitlines()


def tried(sample, tests, shadow, path, options, end):
    """Pairs of mutant and verdict, in the sample's order; goes on after the verdicts in the file."""
    verdicts = {entry["number"]: entry["verdict"] for entry in map(json.loads, complete_lines(path))}
    missing = [mutant for mutant in sample if mutant.number not in verdicts]
    print(f"{len(sample)} mutants, {len(missing)} to be tried", flush=True)

    def try_one(mutant):
        return None if time.monotonic() > end else judge(mutant, tests, shadow.tree)

    with path.open("a") as file, ThreadPoolExecutor(options.jobs) as pool:
        for mutant, verdict in zip(missing, pool.map(try_one, missing)):
            if verdict is None:
                continue
            verdicts[mutant.number] = verdict
            file.write(json.dumps({"number": mutant.number, "verdict": verdict}) + "\n")
            file.flush()
            print(f"{verdict:9} {mutant.file}:{mutant.line} {mutant.original} → {mutant.mutation}", flush=True)
    return [(mutant, verdicts[mutant.number]) for mutant in sample if mutant.number in verdicts]


def main():
    options = arguments()
    end = time.monotonic() + (options.hours * 3600 if options.hours else float("inf"))
    work = ROOT / "out/soak/mutation"
    work.mkdir(parents=True, exist_ok=True)
    shadow = Shadow(ROOT, work)
    wanted = lambda folder: any(folder == f.rstrip("/") or folder.startswith(f.rstrip("/") + "/") for f in options.only)
    folders = [f for f in shadow.test_folders() if wanted(f.removeprefix("tests/"))]
    print(f"Building {len(folders)} test programs: {work}/build.log", flush=True)
    with (work / "build.log").open("a") as log:
        shadow.compile(folders, options.jobs, log)
    digest = shadow.digest()
    tests = recorded(shadow, folders, digest, options.jobs)
    mutants = [mutant for mutant in shadow.mutants() if wanted(mutant.folder)]
    sample = random.Random(options.seed).sample(mutants, min(options.count, len(mutants)))
    verdicts = work / f"verdicts-{digest}.jsonl"
    results = tried(sample, tests, shadow, verdicts, options, end)

    survivors = figure.survivors_of(results, figure.load(HERE / "survivors.json"))
    about = {"seed": options.seed, "mutants": len(mutants), "not_compiling": shadow.dropped_count(), "engine": digest}
    kept = figure.figure_of(results, survivors, about)
    for folder, (noticed, total) in figure.by_folder(results).items():
        print(f"{folder:32} {noticed:4} of {total:4}")
    print(json.dumps(kept, indent=1))
    if options.keep or options.only == ["engine"]:
        figure.save(HERE / "figure.json", kept)
        figure.save(HERE / "survivors.json", survivors)
    else:
        figure.save(work / "survivors.json", survivors)
    return 0


if __name__ == "__main__":
    sys.exit(main())

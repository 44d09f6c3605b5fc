"""Runs mutants of engine/ against the tests that mirror it; see README.md."""

import argparse
import hashlib
import json
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import figure
from shadow import Shadow
from trials import home_of, judge, list_tests, record

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def arguments(words=None):
    about = "A seeded sample of the mutants of engine/, each against the tests of its folder. Killed, it goes on."
    parser = argparse.ArgumentParser(prog="scripts/soak mutation", description=about)
    parser.add_argument("--count", type=int, default=300, help="mutants in the sample (default: %(default)s)")
    parser.add_argument("--hours", type=float, help="stop after this time, with the figure of what was tried")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=2, help="tests and compilers at once (default: %(default)s)")
    parser.add_argument("--only", nargs="+", default=["engine"], metavar="FOLDER",
                        help="only mutants of these folders, such as engine/vision; the figure is then not kept")
    parser.add_argument("--keep", action="store_true", help="keep figure.json and survivors.json even so")
    return parser.parse_args(words)


class Notes:
    """Notes about tests and mutants in a file that survives a kill. A note is valid while the engine has the file's
    digest, and the tests of its folder are unchanged."""

    def __init__(self, path, shadow):
        self.path, self.shadow, self.digests = path, shadow, {}
        self.entries = [json.loads(line) for line in complete_lines(path)]

    def tests(self, folder):
        if folder not in self.digests:
            self.digests[folder] = self.shadow.tests_digest(folder)
        return self.digests[folder]

    def known(self):
        return [entry for entry in self.entries if entry["tests"] == self.tests(entry["folder"])]

    def add(self, folder, **entry):
        entry = {"folder": folder, "tests": self.tests(folder)} | entry
        self.entries.append(entry)
        with self.path.open("a") as file:
            file.write(json.dumps(entry) + "\n")


def recorded(shadow, folders, notes, jobs):
    """Yields every test with the mutants that it reaches, from earlier notes if there are any."""
    known = {(entry["folder"], entry["name"]): entry for entry in notes.known()}
    tests = list_tests(shadow.build, folders)
    missing = [test for test in tests if (test.folder, test.name) not in known]
    print(f"{len(tests)} tests, {len(missing)} to be recorded", flush=True)
    with ThreadPoolExecutor(jobs) as pool:
        for test in pool.map(lambda t: record(t, shadow.tree), missing):
            notes.add(test.folder, name=test.name, seconds=test.seconds, reached=sorted(test.reached))
    known = {(entry["folder"], entry["name"]): entry for entry in notes.known()}
    entries = [(test, known[test.folder, test.name]) for test in tests]
    return [replace(test, seconds=entry["seconds"], reached=frozenset(entry["reached"])) for test, entry in entries]


def complete_lines(path):
    """Returns a file's lines; an incomplete last line is removed from the file."""
    if not path.exists():
        return []
    text = path.read_text()
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        path.write_text(whole)
    return whole.splitlines()


def sample_of(mutants, count, seed):
    """Ranks mutants by their digests, so that an edit of the engine changes little of the sample."""
    seen, ranked = Counter(), []
    for mutant in mutants:
        name = "\0".join((mutant.file, mutant.code, mutant.original, mutant.mutation))
        seen[name] += 1  # equal mutants in one line, or in two equal lines
        ranked.append((hashlib.sha256(f"{seed}\0{seen[name]}\0{name}".encode()).digest(), mutant))
    return [mutant for _, mutant in sorted(ranked, key=lambda pair: pair[0])[:count]]


def tried(sample, tests, shadow, notes, options, end):
    """Returns pairs of mutant and verdict in the sample's order; skips mutants with a verdict."""
    verdicts = {entry["number"]: entry["verdict"] for entry in notes.known()}
    missing = [mutant for mutant in sample if mutant.number not in verdicts]
    print(f"{len(sample)} mutants, {len(missing)} to be tried", flush=True)

    def try_one(mutant):
        return None if time.monotonic() > end else judge(mutant, tests, shadow.tree)

    with ThreadPoolExecutor(options.jobs) as pool:
        for mutant, verdict in zip(missing, pool.map(try_one, missing)):
            if verdict is None:
                continue
            verdicts[mutant.number] = verdict
            notes.add(home_of(mutant, tests), number=mutant.number, verdict=verdict)
            print(f"{verdict:9} {mutant.file}:{mutant.line} {mutant.original} → {mutant.mutation}", flush=True)
    return [(mutant, verdicts[mutant.number]) for mutant in sample if mutant.number in verdicts]


def run(options, root=ROOT, kept_in=HERE):
    """Takes one sample, from building to its figure; returns the figure."""
    end = time.monotonic() + (options.hours * 3600 if options.hours else float("inf"))
    work = root / "out/soak/mutation"
    work.mkdir(parents=True, exist_ok=True)
    shadow = Shadow(root, work)

    def is_wanted(folder):
        return any((folder + "/").startswith(wanted.rstrip("/") + "/") for wanted in options.only)

    folders = [f for f in shadow.test_folders() if is_wanted(f.removeprefix("tests/"))]
    print(f"Building {len(folders)} test programs: {work}/build.output", flush=True)
    mutants = [mutant for mutant in shadow.mutants() if is_wanted(mutant.folder)]
    ranked, sample, most = sample_of(mutants, len(mutants), options.seed), [], options.count + 20
    while True:  # until enough mutants compile
        shadow.wanted = {mutant.site for mutant in ranked[:most]}
        with (work / "cmake.log").open("w") as log:
            shadow.compile(folders, options.jobs, log)
        sample = [mutant for mutant in ranked[:most] if mutant.site not in shadow.dropped][: options.count]
        if len(sample) == options.count or most >= len(ranked):
            break
        most *= 2
    digest = shadow.digest()
    sites = hashlib.sha256(repr(sorted(shadow.wanted)).encode()).hexdigest()[:16]
    tests = recorded(shadow, folders, Notes(work / f"reached-{digest}-{sites}.jsonl", shadow), options.jobs)
    results = tried(sample, tests, shadow, Notes(work / f"verdicts-{digest}.jsonl", shadow), options, end)

    survivors = figure.survivors_of(results, figure.load(kept_in / "survivors.json"))
    about = {} if options.only == ["engine"] else {"only": sorted(options.only)}
    about |= {"seed": options.seed, "mutants": len(mutants), "not_compiling": shadow.dropped_count(), "engine": digest}
    found = figure.figure_of(results, survivors, about)
    keeps = options.keep or options.only == ["engine"]
    figure.save((kept_in if keeps else work) / "figure.json", found)
    figure.save((kept_in if keeps else work) / "survivors.json", survivors)
    for folder, (noticed, total) in figure.by_folder(results).items():
        print(f"{folder:32} {noticed:4} of {total:4}")
    print(json.dumps(found, indent=1))
    return found


if __name__ == "__main__":
    run(arguments())

"""Runs libFuzzer on every reader of files; see README.md."""

import argparse
import json
import os
import re
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FOUND = re.compile(r"(crash|leak|timeout|oom|slow-unit)-")
LONGEST = 65536    # bytes of an input, at most
SHORT = 2048       # bytes of a fast round's inputs, if no seed is longer


def arguments(words=None):
    about = "A seeded minute of libFuzzer for each reader, fewest executions first. Killed, it goes on."
    parser = argparse.ArgumentParser(prog="scripts/soak fuzz", description=about)
    parser.add_argument("--seconds", type=int, default=60, help="of each round of a reader (default: %(default)s)")
    parser.add_argument("--rounds", type=int, default=1, help="for each reader (default: %(default)s)")
    parser.add_argument("--until", type=int, metavar="N", help="instead of rounds: until each reader was executed N times")
    parser.add_argument("--hours", type=float, help="begin no round after this time")
    parser.add_argument("--only", nargs="+", default=[], metavar="READER", help="only these, such as bvh")
    parser.add_argument("--jobs", type=int, default=1, help="readers at once (default: %(default)s)")
    parser.add_argument("--fast", action="store_true",
                        help="without the address sanitizer, short inputs: many more executions in the same time")
    parser.add_argument("--check", action="store_true",
                        help="no new inputs: those that were kept, once each, with the address sanitizer")
    parser.add_argument("--program", type=Path, help="an etude_fuzz that is built already")
    return parser.parse_args(words)


def build(preset):
    subprocess.run(["cmake", "--preset", preset], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", f"build/{preset}", "etude_fuzz"], cwd=ROOT, check=True)
    return ROOT / f"build/{preset}/tests/fuzz/program/etude_fuzz"


class Reader:
    """One target: its files are in out/soak/fuzz/NAME, its counts in the figure."""

    def __init__(self, program, name, work, counts):
        self.program, self.name, self.folder = program, name, work / name
        self.counts = {"executions": 0, "fast_executions": 0, "rounds": 0, "edges": 0, "corpus": 0} | counts
        self.busy = False

    def round(self, options):
        """Runs one round with a seed of its own; returns the files that broke the reader."""
        (self.folder / "found").mkdir(parents=True, exist_ok=True)
        known = set((self.folder / "found").iterdir())
        seeds = [path.stat().st_size for path in (self.folder / "corpus").glob("seed-*")]
        longest = max([SHORT, *seeds]) if options.fast else LONGEST
        command = [self.program, f"--target={self.name}", self.folder / "corpus", f"-seed={self.counts['rounds'] + 1}",
                   f"-max_len={longest}", "-timeout=20", "-rss_limit_mb=2048", "-print_final_stats=1",
                   f"-artifact_prefix={self.folder / 'found'}/"]
        command += ["-runs=0"] if options.check else [f"-max_total_time={options.seconds}"]
        if (self.folder / "words").stat().st_size > 0:
            command.append(f"-dict={self.folder / 'words'}")
        environment = dict(os.environ, TMPDIR="/dev/shm" if Path("/dev/shm").is_dir() else "/tmp")
        log = self.folder / "log"
        with log.open("wb") as file:
            subprocess.run(command, cwd=ROOT, env=environment, stdout=file, stderr=file, preexec_fn=lambda: os.nice(5))
        self.count(log.read_text(errors="replace"), options.fast)
        return sorted(path for path in (self.folder / "found").iterdir() if path not in known and FOUND.match(path.name))

    def count(self, text, fast):
        executed = re.findall(r"stat::number_of_executed_units: (\d+)", text) or re.findall(r"^#(\d+)", text, re.M)
        edges = re.findall(r" cov: (\d+) ", text)
        for kind in ["executions"] + ["fast_executions"] * fast:
            self.counts[kind] += int(executed[-1]) if executed else 0
        self.counts["rounds"] += 1
        self.counts["edges"] = max([self.counts["edges"]] + [int(edge) for edge in edges[-1:]])
        self.counts["corpus"] = sum(1 for _ in (self.folder / "corpus").iterdir())


def findings(name):
    """Returns the findings about this reader that were mended; the tests replay them."""
    folder = HERE / "found" / name
    return sum(1 for _ in folder.iterdir()) if folder.is_dir() else 0


def save(path, readers, kept):
    """Writes the figure: counts for each reader, also for those that this program lacks, and for all."""
    counts = kept | {name: reader.counts for name, reader in readers.items()}
    counts = {name: counts[name] | {"findings_mended": findings(name)} for name in sorted(counts)}
    whole = {key: sum(c[key] for c in counts.values()) for key in next(iter(counts.values()), {}) if key != "edges"}
    whole["fewest_executions"] = min((c["executions"] for c in counts.values()), default=0)
    path.with_suffix(".new").write_text(json.dumps({"all": whole, "readers": counts}, indent=1) + "\n")
    path.with_suffix(".new").rename(path)
    return whole


def run(options, kept_in=HERE, work=ROOT / "out/soak/fuzz"):
    """Runs rounds until each reader has had its share; returns the findings that are not mended."""
    end = time.monotonic() + (options.hours * 3600 if options.hours else float("inf"))
    program = (options.program or build("fuzz-fast" if options.fast else "fuzz")).resolve()
    names = subprocess.run([program, "--list"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    if unknown := [name for name in options.only if name not in names]:
        raise SystemExit(f"scripts/soak fuzz: no reader '{unknown[0]}'; allowed: {', '.join(names)}")
    work.mkdir(parents=True, exist_ok=True)
    subprocess.run([program, f"--make={work}"], cwd=ROOT, check=True)
    figure = kept_in / "figure.json"
    kept = json.loads(figure.read_text())["readers"] if figure.exists() else {}
    readers = {name: Reader(program, name, work, kept.get(name, {})) for name in names}
    wanted = [readers[name] for name in (options.only or names)]
    counted, goal = ("executions", options.until) if options.until else ("rounds", options.rounds)
    left = {reader.name: goal - (0 if counted == "rounds" else reader.counts[counted]) for reader in wanted}
    broken = []
    lock = threading.Lock()

    def choose():
        with lock:
            waiting = [reader for reader in wanted if left[reader.name] > 0 and not reader.busy]
            if not waiting or time.monotonic() >= end:
                return None
            reader = min(waiting, key=lambda one: one.counts["executions"])
            reader.busy = True
            return reader

    def fuzz():
        while reader := choose():
            before = reader.counts[counted]
            found = reader.round(options)
            with lock:
                done = reader.counts[counted] - before
                left[reader.name] -= done or left[reader.name]  # a reader that executes nothing gets no further round
                reader.busy = False
                save(figure, readers, kept)
                print(f"{reader.name:24} {reader.counts['executions']:>12,} executions, {reader.counts['edges']:>6,} edges, "
                      f"{reader.counts['corpus']:>5,} files" + "".join(f"\n  FOUND {path}" for path in found), flush=True)
                broken.extend(found)

    with ThreadPoolExecutor(options.jobs) as pool:
        for worker in [pool.submit(fuzz) for _ in range(options.jobs)]:
            worker.result()
    print(json.dumps(save(figure, readers, kept)))
    return broken


if __name__ == "__main__":
    raise SystemExit(1 if run(arguments()) else 0)

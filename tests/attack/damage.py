"""Attacks Etude with damaged files: those of a sealed run, of a run read with --unsealed, the journal of an
interrupted run, a shard, a baseline, a pack, and every kind of file that a command reads from its user. The round's
number seeds the choice of a damage; then a command reads the file. A damaged sealed file must be refused by its
name; a damaged run that is continued must give the same bytes or be refused; and no command may end by a signal or
with more than one complaint."""
import json
import os
import pathlib
import random
import shutil
import subprocess

SCENARIO = """scenario: s
question: What is read of a damaged run?
task: ik
trials: 3
sweep: {joint_noise_deg: [2, 5]}
methods:
  - {name: fixed, solver: ccd, weights: fixed}
  - {name: least-squares, solver: damped-least-squares}
video: {compare: [fixed, least-squares], trials: [0]}
"""
RESULTS = ("cells.jsonl", "summary.json")
LOCK = shutil.ignore_patterns("lock")  # the file "lock", which nobody may read, is not copied
READERS = {
    "report": ["report", "--no-video", "RUN"],
    "gate": ["gate", "RUN", "--baseline", "BASELINE"],
    "compare": ["compare", "RUN", "WHOLE"],
    "rows": ["rows", "RUN"],
    "replay": ["replay", "RUN"],
    "verify": ["verify", "RUN"],
}
# User files: how each is made, and what reads it.
FILES = {f"clap.{ending}": (["clip", "convert", "builtin:clap", "FILE"], ["clip", "info", "FILE"])
         for ending in ("bvh", "glb", "trc", "csv", "c3d", "npz", "mot")} | {
    "tags.xml": (["bridge", "builtin:clap", "builtin:sway", "-o", "FILE"], ["bridge", "builtin:clap", "builtin:sway", "--check", "FILE"]),
    "moves.yaml": (["teach", "clap.csv", "-o", "FILE"], ["recognise", "clap.csv", "--moves", "FILE"]),
    "s.yaml": (None, ["run", "FILE", "--dry-run"]),
}
CAN_UNSEALED = ("report", "gate", "compare", "rows", "replay")


def damaged(content, dice):
    """Returns a file's bytes after one random accident; they always differ from before."""
    kind = dice.choice(["flip", "cut", "empty", "double a line", "lose a line", "swap lines", "zeros", "another number", "noise"])
    now = bytearray(content)
    lines = content.splitlines(keepends=True)
    place = dice.randrange(max(1, len(now)))
    if kind == "flip" and now:
        now[place] ^= 1 << dice.randrange(8)
    elif kind == "cut":
        now = now[:place]
    elif kind == "empty":
        now = bytearray()
    elif kind == "double a line" and lines:
        at = dice.randrange(len(lines))
        now = b"".join(lines[:at + 1] + lines[at:])
    elif kind == "lose a line" and lines:
        at = dice.randrange(len(lines))
        now = b"".join(lines[:at] + lines[at + 1:])
    elif kind == "swap lines" and len(lines) > 1:
        at, other = dice.sample(range(len(lines)), 2)
        lines[at], lines[other] = lines[other], lines[at]
        now = b"".join(lines)
    elif kind == "zeros":
        now[place:place + 512] = bytes(len(now[place:place + 512]))
    elif kind == "another number":
        digits = [i for i, byte in enumerate(now) if chr(byte).isdigit()]
        for at in digits and [dice.choice(digits)]:
            now[at] = ord(dice.choice([each for each in "0123456789" if ord(each) != now[at]]))
    elif kind == "noise":
        now[place:place + 8] = dice.randbytes(8)
    return kind, bytes(now) if bytes(now) != content else content + b"\xff"


class Damage:
    """Makes the runs and files to damage once; each round damages a copy."""

    def __init__(self, etude, folder):
        self.etude, self.folder = etude, pathlib.Path(folder)
        self.scenario = self.folder / "s.yaml"
        self.scenario.write_text(SCENARIO)
        self.whole, self.baseline, self.pack = self.folder / "whole", self.folder / "baseline.json", self.folder / "cell.pack"
        self.must("run", self.scenario, "-o", self.whole, "--jobs", "1")
        self.must("gate", self.whole, "--update", "--baseline", self.baseline)
        cell = json.loads((self.whole / "cells.jsonl").read_text().splitlines()[0])["cell"]
        self.must("replay", self.whole, "--cell", cell, "--pack", self.pack)
        self.shards = [self.folder / f"shard-{i}" for i in (1, 2)]
        for i, shard in enumerate(self.shards, 1):
            self.must("run", self.scenario, "-o", shard, "--jobs", "1", "--shard", f"{i}/2")
        for name, (made, _) in FILES.items():
            if made:
                self.must(*("FILE" == word and name or word for word in made))
        self.interrupted = self.folder / "interrupted"
        self.interrupt()

    def call(self, *words):
        return subprocess.run([self.etude, *map(str, words)], capture_output=True, timeout=120, cwd=self.folder)

    def must(self, *words):
        result = self.call(*words)
        if result.returncode != 0:
            raise SystemExit(f"etude {words[0]}: {result.stderr.decode(errors='replace')}")

    def interrupt(self):
        """Makes a run that was killed when half of its cells were done."""
        shutil.rmtree(self.interrupted, ignore_errors=True)
        run = subprocess.Popen([self.etude, "run", self.scenario, "-o", self.interrupted, "--jobs", "1", "--sync-seconds", "0",
                                "--trials", "60"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        journal = self.interrupted / "journal.jsonl"
        while run.poll() is None and not (journal.exists() and journal.read_bytes().count(b"\n") > 30):
            pass
        run.kill()
        run.wait()
        if not journal.exists():
            return self.interrupt()
        self.resumed = self.folder / "resumed"
        shutil.rmtree(self.resumed, ignore_errors=True)
        shutil.copytree(self.interrupted, self.resumed, ignore=LOCK)
        self.must("run", self.scenario, "-o", self.resumed, "--jobs", "1", "--trials", "60", "--resume")

    def round(self, number):
        """Damages a copy; returns what was damaged and how, the reader, and the fault of its end ("" if there is
        none)."""
        dice = random.Random(f"damage/{number}")
        what = dice.choice(["sealed", "sealed", "unsealed", "unsealed", "journal", "shard", "baseline", "pack", *FILES])
        copy = self.folder / f"round-{number}{pathlib.Path(what).suffix}"
        try:
            source = {"journal": self.interrupted, "shard": self.shards[1], "baseline": self.baseline,
                      "pack": self.pack, **{name: self.folder / name for name in FILES}}.get(what, self.whole)
            shutil.copytree(source, copy, ignore=LOCK) if source.is_dir() else shutil.copyfile(source, copy)
            files = [path for path in sorted(copy.rglob("*")) if path.is_file() and path.name != "lock"
                     and "report" not in path.relative_to(copy).parts] or [copy]  # a report can be made again
            if what == "journal":
                files = [copy / "journal.jsonl"]
            file = dice.choice(files)
            kind, content = damaged(file.read_bytes(), dice)
            file.write_bytes(content)
            reader = dice.choice(sorted(CAN_UNSEALED if what == "unsealed" else READERS))
            if what in ("sealed", "unsealed"):
                words = [copy if word == "RUN" else word for word in READERS[reader]] + ["--unsealed"] * (what == "unsealed")
            elif what in FILES:
                words = [copy if word == "FILE" else word for word in FILES[what][1]]
                reader = words[0]
            else:
                reader, words = {
                    "journal": ("run --resume", ["run", self.scenario, "-o", copy, "--jobs", "1", "--trials", "60", "--resume"]),
                    "shard": ("merge", ["merge", self.shards[0], copy, "-o", f"{copy}-merged"]),
                    "baseline": ("gate", ["gate", self.whole, "--baseline", copy]),
                    "pack": ("replay", ["replay", copy]),
                }[what]
            words = [{"BASELINE": self.baseline, "WHOLE": self.whole}.get(word, word) for word in words]
            result = self.call(*words)
            wrong = self.wrong(what, reader, file, copy, result)
            return {"damaged": what, "file": what if what in FILES else file.name, "kind": kind, "reader": reader,
                    "exit": result.returncode, "wrong": wrong}
        finally:
            for left in (copy, pathlib.Path(f"{copy}-merged")):
                shutil.rmtree(left) if left.is_dir() else left.unlink(missing_ok=True)

    def wrong(self, what, reader, file, copy, result):
        said = result.stderr.decode(errors="replace")
        complaints = [line for line in said.splitlines()
                      if line.startswith("etude: ") and not line.startswith("etude: read unsealed: ")]
        if result.returncode not in (0, 1, 2) and (reader, result.returncode) != ("gate", 3):  # rows may be missing
            return f"ended with {result.returncode}: {said[-300:]}"
        if result.returncode == 2 and len(complaints) != 1:
            return f"{len(complaints)} complaints: {said[-300:]}"
        if b"nan" in result.stdout.lower().split():
            return "printed NaN"
        if what == "sealed" and reader != "verify" and (result.returncode != 2 or file.name not in said and
                                                        file.name != "seal.json"):
            return f"a damaged {file.name} was read: {said[-300:]}"
        if what == "sealed" and reader == "verify" and result.returncode == 0:
            return "verified a damaged run"
        if what == "journal" and result.returncode == 0 and not self.same(copy, self.resumed):
            return "went on to other results"
        if what == "shard" and result.returncode == 0 and not self.same(pathlib.Path(f"{copy}-merged"), self.whole):
            return "merged other results"
        return ""

    @staticmethod
    def same(a, b):
        return all((a / name).read_bytes() == (b / name).read_bytes() for name in RESULTS)

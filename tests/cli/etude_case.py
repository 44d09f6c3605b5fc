"""Parts that the tests of the program share: a scratch folder, and a way to call `etude`."""
import json
import os
import re
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from json_schema import complaints, load_schema  # noqa: E402

ETUDE = os.environ["ETUDE"]
PROGRAM = pathlib.Path(ETUDE).resolve().with_name("etude_program")  # the program that ETUDE starts
HEAVY = bool(os.environ.get("ETUDE_HEAVY"))  # set by scripts/test --full
heavy = unittest.skipUnless(HEAVY, "heavy")  # takes too long for every change
os.environ["PATH"] = "/usr/bin:" + os.environ["PATH"]  # a fence shows no Python in a home folder


COMMAND_GROUPS = ["Run and judge", "Your motions", "Your recordings of people", "Your cameras", "Share"]


def commands_in(help_text):
    """Returns the names of all subcommands in a help text."""
    headings = "|".join(["Subcommands", *COMMAND_GROUPS])
    listed = re.findall(rf"^(?:{headings}):\n((?:  .*\n)+)", help_text, re.M)
    return [name for block in listed for name in re.findall(r"^  (\S+)", block, re.M)]


def ik_scenario(trials, question="Does it run?", weights="fixed"):
    """Returns a scenario of two solvers under two conditions that runs quickly."""
    return f"""scenario: ik
question: {question}
task: ik
trials: {trials}
sweep: {{joint_noise_deg: [2, 5]}}
methods:
  - {{name: fixed, solver: ccd, weights: {weights}}}
  - {{name: least-squares, solver: damped-least-squares}}
"""


IK = ik_scenario(trials=4)


# The files that two runs promise to share byte for byte.
SHARED = ["manifest.json", "cells.jsonl", "columns", "summary.json", "series", "recordings"]


def cells_in_journal(folder, kind="cell"):
    """Returns the number of cells that a run has flushed; with `answered`, of answered cells that programs have yet
    to measure."""
    try:
        lines = (folder / "journal.jsonl").read_bytes().split(b"\n")[:-1]
    except FileNotFoundError:
        return 0
    return sum(line.startswith(f'{{"{kind}":'.encode()) for line in lines)


def png_size(data):
    """Returns the size of a PNG file; checks every chunk and unpacks the pixels."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, pixels, size = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0]
        if kind == b"IHDR":
            size = struct.unpack(">II", body[:8])
        if kind == b"IDAT":
            pixels += body
        at += 12 + length
    assert len(zlib.decompress(pixels)) == size[1] * (1 + 3 * size[0])
    return size


class EtudeCase(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.out = self.folder / "out"

    def facts(self, command, *arguments):
        """Returns the output of `command` with --json, which must be JSON that fits its schema."""
        done = self.etude(*command.split(), *(() if "--" in arguments else ("--json",)), *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(done.stdout.count("\n"), 1, done.stdout)
        facts, schema = json.loads(done.stdout), load_schema("facts.schema.json")
        schema["$ref"] = f"#/$defs/{command}"
        self.assertEqual(complaints(facts, schema), [])
        self.assertNotEqual(complaints({**facts, "more": 1}, schema), [])
        self.assertEqual(list(facts)[:2], ["command", "etude"])
        return facts

    @classmethod
    def shared_folder(cls):
        """Makes the class's scratch folder for files that setUpClass writes once for all tests."""
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        return pathlib.Path(scratch.name)

    @classmethod
    def run_once(cls, text):
        """Writes and runs a scenario for the whole class; returns both paths."""
        shared = cls.shared_folder()
        scenario, whole = shared / "ik.yaml", shared / "whole"
        scenario.write_text(text)
        result = cls.etude("run", scenario, "-o", whole)
        assert result.returncode == 0, result.stderr
        return str(scenario), whole

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return str(path)

    def cut_scenario(self, *clips, trials=1, more="", clip_key=None):
        """Writes a scenario of task transition with one method; returns its path."""
        clip_key = clip_key or f"clips: {[str(clip) for clip in clips]}"
        return self.write("t.yaml", f"scenario: t\nquestion: Does it run?\ntask: transition\n{clip_key}\ntrials: {trials}\n"
                                    f"methods:\n  - {{name: cut, choice: now, join: cut}}\n{more}")

    @staticmethod
    def etude(*arguments, text=None):
        """Runs the program; `text` is its standard input."""
        return subprocess.run([ETUDE, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=120)

    def ends(self, code, *arguments, text=None):
        """Runs the program, which must end with `code`."""
        result = self.etude(*arguments, text=text)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def refusal(self, *arguments, says=(), leaves=None):
        """Returns the line that refuses a command. It must contain all of `says`, and the file `leaves` must not
        exist."""
        complaint = re.sub(r"^ *\d+ %  .*\n", "", self.ends(2, *arguments).stderr, flags=re.M)  # a slow machine shows progress
        self.assertEqual(complaint.count("\n"), 1, complaint)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, complaint)
        self.assertFalse(leaves and pathlib.Path(leaves).exists(), "a refused command left a file")
        return complaint

    def run_suite(self, *arguments, out=None, code=0):
        """Runs `etude run`, which must end with `code` (1: a method has no answer); returns the rows."""
        out = out or self.out
        self.ends(code, "run", *arguments, "-o", out)
        return [json.loads(line) for line in (out / "cells.jsonl").read_text().splitlines()]

    def wait_for_cells(self, folder, count=1, limit_s=60, kind="cell"):
        deadline = time.monotonic() + limit_s
        while cells_in_journal(folder, kind) < count:
            self.assertLess(time.monotonic(), deadline, f"no {count} cells in {limit_s} s")
            time.sleep(0.005)

    def assert_same_results(self, folder, other):
        """Checks that the files that two runs must share have the same bytes; returns their number."""
        compared = 0
        for part in SHARED:
            files = [path.relative_to(root) for root in (folder, other)
                     for path in ([root / part] if (root / part).is_file() else (root / part).rglob("*"))
                     if path.is_file()]
            for name in sorted(set(files)):
                self.assertEqual((folder / name).read_bytes(), (other / name).read_bytes(), name)
                compared += 1
        self.assertGreater(compared, 2)
        return compared

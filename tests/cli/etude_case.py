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
HEAVY = bool(os.environ.get("ETUDE_HEAVY"))  # scripts/test --full
heavy = unittest.skipUnless(HEAVY, "heavy")  # costs more than it tells at every change
os.environ["PATH"] = "/usr/bin:" + os.environ["PATH"]  # a fence shows no Python of a home


COMMAND_GROUPS = ["Run and judge", "Your motions", "Your recordings of people", "Your cameras", "Share"]


def commands_in(help_text):
    """The names of all subcommands that a help text lists, whatever their group."""
    headings = "|".join(["Subcommands", *COMMAND_GROUPS])
    listed = re.findall(rf"^(?:{headings}):\n((?:  .*\n)+)", help_text, re.M)
    return [name for block in listed for name in re.findall(r"^  (\S+)", block, re.M)]


def ik_scenario(trials, question="Does it run?", weights="fixed"):
    """A scenario of two solvers under two conditions, quick to run."""
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


# What a run promises to be the same bytes, however it came about.
SHARED = ["manifest.json", "cells.jsonl", "columns", "summary.json", "series", "recordings"]


def cells_in_journal(folder, kind="cell"):
    """How many cells a run has flushed so far; of the kind `answered`: those that programs measure, before they do."""
    try:
        lines = (folder / "journal.jsonl").read_bytes().split(b"\n")[:-1]
    except FileNotFoundError:
        return 0
    return sum(line.startswith(f'{{"{kind}":'.encode()) for line in lines)


def png_size(data):
    """The size of a PNG file, after checking every chunk and unpacking its pixels."""
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
        """What `command` tells with --json and nothing else on standard output, after checking it against its
        schema."""
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
        """A scratch folder of the whole class: what all its tests read is made once, in setUpClass."""
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        return pathlib.Path(scratch.name)

    @classmethod
    def run_once(cls, text):
        """A scenario of that text and its run, for the whole class: their paths."""
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
        """The path of a scenario of task transition with one method, and more."""
        clip_key = clip_key or f"clips: {[str(clip) for clip in clips]}"
        return self.write("t.yaml", f"scenario: t\nquestion: Does it run?\ntask: transition\n{clip_key}\ntrials: {trials}\n"
                                    f"methods:\n  - {{name: cut, choice: now, join: cut}}\n{more}")

    @staticmethod
    def etude(*arguments, text=None):
        """Runs the program; `text` is what it reads from its standard input."""
        return subprocess.run([ETUDE, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=120)

    def ends(self, code, *arguments, text=None):
        """The same, which must end with that code."""
        result = self.etude(*arguments, text=text)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def refusal(self, *arguments, says=(), leaves=None):
        """The one line in which a command is refused, with all those words; it leaves no file of that name."""
        complaint = self.ends(2, *arguments).stderr
        self.assertEqual(complaint.count("\n"), 1, complaint)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, complaint)
        self.assertFalse(leaves and pathlib.Path(leaves).exists(), "a refused command left a file")
        return complaint

    def run_suite(self, *arguments, out=None, code=0):
        """`etude run` that must succeed, or end with 1 where a method has no answer; gives the rows."""
        out = out or self.out
        self.ends(code, "run", *arguments, "-o", out)
        return [json.loads(line) for line in (out / "cells.jsonl").read_text().splitlines()]

    def wait_for_cells(self, folder, count=1, limit_s=60, kind="cell"):
        deadline = time.monotonic() + limit_s
        while cells_in_journal(folder, kind) < count:
            self.assertLess(time.monotonic(), deadline, f"no {count} cells in {limit_s} s")
            time.sleep(0.005)

    def assert_same_results(self, folder, other):
        """Same bytes in every file that two runs promise to share; says how many were compared."""
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

"""What the tests of the program share: a scratch folder, and a way to call `etude`."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ETUDE = os.environ["ETUDE"]

IK = """scenario: ik
question: Does it run?
task: ik
trials: 4
sweep: {joint_noise_deg: [2, 5]}
methods:
  - {name: fixed, solver: ccd, weights: fixed}
  - {name: least-squares, solver: damped-least-squares}
"""


class EtudeCase(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.out = self.folder / "out"

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return str(path)

    def etude(self, *arguments):
        return subprocess.run([ETUDE, *map(str, arguments)], capture_output=True, text=True, timeout=120)

    def run_suite(self, *arguments, out=None):
        """`etude run` that must succeed; gives the rows."""
        out = out or self.out
        result = self.etude("run", *arguments, "-o", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [json.loads(line) for line in (out / "cells.jsonl").read_text().splitlines()]

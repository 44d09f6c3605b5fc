"""Tests that scripts/findings repeats runs, continues them and lists changes, in a temporary tree with a stub in place
of Etude."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# The stub writes a run of one scenario: a jump of `jump` cm in every world, and a stage digest `stage`. It reads both
# from files next to itself.
PROGRAM = '''#!/usr/bin/env python3
import json, pathlib, sys
here, told = pathlib.Path(__file__).parent, sys.argv[1:]
with open(here / "calls", "a") as calls:
    calls.write(" ".join(told) + "\\n")
if (here / "broken").exists():
    sys.exit(3)
out = pathlib.Path(told[told.index("-o") + 1])
out.mkdir(parents=True, exist_ok=True)
trials = int(told[told.index("--trials") + 1]) if "--trials" in told else 4
text = pathlib.Path(told[1]).read_text()
row = {"scenario": "transition-acts", "condition": "-", "method": "a", "jump_cm": json.loads((here / "jump").read_text()),
       "digest_world": (here / "stage").read_text()}
(out / "cells.jsonl").write_text("".join(json.dumps({**row, "trial": i}) + "\\n" for i in range(trials)))
(out / "timings.jsonl").write_text(json.dumps({"cpu_s": 36, "world_cpu_s": 36}) + "\\n")
(out / "summary.json").write_text("{}")
(out / "manifest.json").write_text(json.dumps({"suite": "s", "seed": 3, "etude": "0.2.0", "metrics": {"jump_cm": 1},
    "scenarios": [{"name": "transition-acts", "file": told[1]}], "sources": {told[1]: text}}))
'''
PAGE = """It jumps 5.0 cm.
<!-- bound
5.0 = transition-acts: transition-acts/-/a/jump_cm
-->

<!-- age -->
<!-- end of age -->
"""


class Findings(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        for folder in ("scripts", "docs/figures", "scenarios/full", "bench/metrics/catalogue", "program"):
            (self.root / folder).mkdir(parents=True)
        for name in ("figures", "findings"):
            shutil.copy2(ROOT / "scripts" / name, self.root / "scripts")
        (self.root / "CMakeLists.txt").write_text("project(etude VERSION 0.2.0 LANGUAGES CXX)\n")
        (self.root / "bench/metrics/catalogue/1.yaml").write_text("metrics:\n  - id: jump_cm\n")
        (self.root / "scenarios/full/transition_acts.yaml").write_text("scenario: transition-acts\n")
        (self.root / "README.md").write_text(PAGE)
        kept = {"runs": [{"suite": "s", "seed": 3}],
                "of": {"etude": "0.1.0", "taken": "2026-11-23", "metrics": {"jump_cm": 1}, "scenarios": {}},
                "figures": {"transition-acts/-/a/jump_cm": 5.0}}
        (self.root / "docs/figures/transition-acts.json").write_text(json.dumps(kept))
        self.program = self.root / "program" / "etude"
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)
        self.let(jump="5.0", stage="one")

    def let(self, **files):
        for name, text in files.items():
            (self.root / "program" / name).write_text(text)

    def findings(self, *arguments):
        result = subprocess.run([sys.executable, self.root / "scripts/findings", "--etude", self.program, *arguments],
                                capture_output=True, text=True)
        return result.returncode, result.stdout + result.stderr

    def test_keep_what_came_out_and_tell_what_changed(self):
        code, output = self.findings("transition-acts")
        self.assertEqual((code, output.splitlines()[-1]), (0, "transition-acts: done, 0 changes so far"))
        kept = json.loads((self.root / "docs/figures/transition-acts.json").read_text())
        self.assertEqual((kept["of"]["etude"], kept["cpu_hours"]), ("0.2.0", 0.02))
        self.assertIn("Etude 0.2.0, seed 3: `transition-acts`", (self.root / "README.md").read_text())
        self.let(jump="6.0")
        code, output = self.findings("transition-acts")
        self.assertEqual((code, output.splitlines()[-1]), (1, "transition-acts: transition-acts/-/a/jump_cm: 5 is 6"))
        self.assertIn("It jumps 6.0 cm.", (self.root / "README.md").read_text())
        calls = (self.root / "program/calls").read_text().splitlines()
        self.assertTrue(all("scenarios/full/transition_acts.yaml --seed 3 --resume" in call for call in calls), calls)

    def test_say_when_a_run_does_not_end_and_keep_nothing(self):
        before = (self.root / "docs/figures/transition-acts.json").read_text()
        self.let(broken="")
        code, output = self.findings("transition-acts")
        self.assertEqual(code, 2)
        self.assertIn("transition_acts.yaml did not finish", output)
        self.assertEqual((self.root / "docs/figures/transition-acts.json").read_text(), before)

    def test_probe_the_stages_of_the_first_world(self):
        self.assertIn("the stored run has no digests of stages", self.findings("--probe", "transition-acts")[1])
        self.findings("transition-acts")
        self.assertEqual(self.findings("--probe", "transition-acts")[0], 0)
        self.let(stage="another")
        code, output = self.findings("--probe", "transition-acts")
        self.assertEqual(code, 1)
        self.assertIn("transition-acts: transition-acts: the digests of the stages differ", output)

    def test_list_tables_and_refuse_unknown_ones(self):
        code, output = self.findings("--list", "transition-acts")
        self.assertEqual(code, 0)
        self.assertRegex(output, r"transition-acts +1 claims +\? CPU-hours  of 0.1.0, 2026-11-23")
        code, output = self.findings("transition")
        self.assertNotEqual(code, 0)
        self.assertIn("no table transition; there are", output)

    def test_know_every_table_that_is_kept(self):
        result = subprocess.run([sys.executable, ROOT / "scripts/findings", "--list"], capture_output=True, text=True)
        listed = sorted(line.split()[0] for line in result.stdout.splitlines())
        self.assertEqual(listed, sorted(path.stem for path in (ROOT / "docs/figures").glob("*.json")))


if __name__ == "__main__":
    unittest.main()

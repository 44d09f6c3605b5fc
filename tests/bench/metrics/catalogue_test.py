"""Tests that the build reads the files of bench/metrics/catalogue, and stops at a fault with its place."""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
GOOD = """domain: Tests
inputs:
  found: what was found
metrics:
  - id: fault_cm
    label: fault
    unit: cm
    direction: lower
    aggregate: median
    definition: How far off.
    formula: found − truth.
    null_rule: Never.
    practical_threshold: 0.5
    practical_reason: A test.
    source: Etude.
    inputs:
      - found
      - truth: what is true
    vectors:
      - title: three
        input: '{"found": 5, "truth": 2}'
        expected: 3
        tolerance: 1e-9
        source: "derived: 5 − 2"
"""
# The replaced text, its replacement, and the error message: its line and some of its words.
FAULTS = {
    "a broken document": ("domain: Tests", "domain: [Tests", 2, "not valid YAML"),
    "an unknown key": ("label: fault", "lable: fault", 6, "'label'"),
    "no unit of that name": ("    unit: cm", "    units: cm", 7, "units"),
    "a wrong direction": ("direction: lower", "direction: down", 8, "'down'"),
    "no direction": ("    direction: lower\n", "", 5, "'direction'"),
    "a wrong aggregate": ("aggregate: median", "aggregate: mode", 9, "'mode'"),
    "a wrong reading": ("aggregate: median", "aggregate: median\n    reads: percent", 10, "'percent'"),
    "a success that is neither": ("aggregate: median", "aggregate: median\n    success: often", 10, "'often'"),
    "no threshold": ("    practical_threshold: 0.5\n", "", 5, "'practical_threshold' is missing"),
    "a negative threshold": ("practical_threshold: 0.5", "practical_threshold: -1", 13, "-1 is out of range"),
    "version 0": ("label: fault", "label: fault\n    version: 0", 7, "version"),
    "an input that nobody explains": ("- found\n", "- fond\n", 17, "what is the input 'fond'?"),
    "no inputs": ("    inputs:\n      - found\n      - truth: what is true\n", "", 5, "'inputs' must be a list"),
    "no vectors": ("vectors:\n", "vectors: []\n    more:\n", 19, "'vectors' must be a list"),
    "an input that is no JSON": ('"truth": 2}', '"truth": 2', 21, "JSON"),
    "an input that is no object": ('{"found": 5, "truth": 2}', "[5, 2]", 21, "one JSON object"),
    "neither value nor reason": ("        expected: 3\n", "", 20, "null_reason"),
    "both value and reason": ("expected: 3", "expected: 3\n        null_reason: none", 20, "null_reason"),
    "a value that is none": ("expected: 3", "expected: three", 22, "'three'"),
    "no tolerance": ("        tolerance: 1e-9\n", "", 20, "'tolerance' is missing"),
    "a negative tolerance": ("tolerance: 1e-9", "tolerance: -1", 23, "-1 is out of range"),
    "a source of no kind": ("derived: 5", "felt: 5", 20, "'derived: '"),
    "no title": ("title: three\n        input", "input", 20, "title"),
    "the same metric again": ("metrics:\n", "metrics:\n" + GOOD.split("metrics:\n")[1], 25, "stands here twice"),
}


class Catalogue(unittest.TestCase):
    def table(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file, out = pathlib.Path(folder, "mine.yaml"), pathlib.Path(folder, "out.cc")
            file.write_text(text)
            result = subprocess.run([os.environ["ETUDE_METRIC_TABLE"], out, file], capture_output=True, text=True,
                                    timeout=600)
            self.assertEqual(out.exists(), result.returncode == 0)
            return result.returncode, result.stderr.replace(f"{folder}/", "")

    def test_a_file_without_a_fault_is_read(self):
        self.assertEqual(self.table(GOOD), (0, ""))

    def test_every_fault_is_named_with_its_place(self):
        for name, (part, by, line, words) in FAULTS.items():
            with self.subTest(name):
                self.assertEqual(GOOD.count(part), 1)
                code, complaint = self.table(GOOD.replace(part, by))
                self.assertEqual(code, 1)
                self.assertRegex(complaint, rf"^mine\.yaml:{line}(:\d+)?: ")
                self.assertIn(words, complaint)
                self.assertEqual(complaint.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()

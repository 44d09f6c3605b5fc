"""Tests scripts/soak fuzz, with a stub instead of the fuzzer."""

import json
import tempfile
import unittest
from pathlib import Path

import soak

# A fuzzer with two readers: in each round, `good` reads 100 inputs; `bad` reads 7 and leaves an input that breaks it.
FUZZER = """#!/bin/sh
corpus=$2; seed=${3#-seed=}
for argument; do case $argument in
  --list) printf 'good\\nbad\\n'; exit ;;
  --make=*) for name in good bad; do mkdir -p ${argument#--make=}/$name/corpus; : > ${argument#--make=}/$name/words; done; exit ;;
  -artifact_prefix=*) found=${argument#-artifact_prefix=} ;;
esac; done
echo new > $corpus/$seed
echo "$@" > ${0%/*}/arguments
case $1 in
  --target=good) echo "#100 DONE cov: 42 ft: 1 corp: 1"; echo "stat::number_of_executed_units: 100" ;;
  --target=bad) echo "#7 NEW cov: 5 ft: 1"; echo broken > ${found}crash-$seed; exit 77 ;;
esac
"""


class Soak(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.program = self.folder / "fuzzer"
        self.program.write_text(FUZZER)
        self.program.chmod(0o755)

    def run_soak(self, *words):
        options = soak.arguments(["--program", str(self.program), "--seconds", "1", *words])
        return [path.name for path in soak.run(options, kept_in=self.folder, work=self.folder / "work")]

    def figure(self):
        return json.loads((self.folder / "figure.json").read_text())

    def test_what_was_executed_adds_up_and_what_was_found_is_told(self):
        self.assertEqual(self.run_soak(), ["crash-1"])
        self.assertEqual(self.run_soak("--rounds", "2"), ["crash-2", "crash-3"])
        readers = self.figure()["readers"]
        self.assertEqual(readers["good"], {"executions": 300, "fast_executions": 0, "rounds": 3, "edges": 42, "corpus": 3,
                                           "findings_mended": 0})
        self.assertEqual(readers["bad"]["executions"], 21)
        self.assertEqual(self.figure()["all"]["fewest_executions"], 21)

    def test_counts_of_readers_that_this_program_has_not_are_kept(self):
        old = {"executions": 5, "fast_executions": 0, "rounds": 1, "edges": 2, "corpus": 3, "findings_mended": 0}
        (self.folder / "figure.json").write_text(json.dumps({"readers": {"old": old}}))
        self.run_soak("--only", "good")
        self.assertEqual(self.figure()["readers"]["old"], old)
        self.assertEqual(self.figure()["all"]["executions"], 105)

    def test_only_those_asked_for_run(self):
        self.assertEqual(self.run_soak("--only", "good"), [])
        self.assertEqual(self.figure()["readers"]["bad"]["rounds"], 0)
        with self.assertRaisesRegex(SystemExit, "no reader 'ugly'; allowed: good, bad"):
            self.run_soak("--only", "ugly")

    def test_rounds_go_on_until_so_many_executions_several_readers_at_once(self):
        self.run_soak("--until", "250", "--only", "good", "--fast")
        self.assertEqual(self.figure()["readers"]["good"]["executions"], 300)
        self.assertEqual(self.figure()["all"]["fast_executions"], 300)
        self.run_soak("--until", "250", "--jobs", "2")
        self.assertEqual(self.figure()["readers"]["good"]["rounds"], 3)
        self.assertEqual(self.figure()["readers"]["bad"]["executions"], 252)

    def test_a_reader_that_executes_nothing_ends_after_a_round(self):
        self.program.write_text(FUZZER.replace('echo "#100 DONE cov: 42 ft: 1 corp: 1"; echo "stat::number_of_executed_units: 100"',
                                               "exit 1"))
        self.run_soak("--until", "250", "--only", "good")
        self.assertEqual(self.figure()["readers"]["good"]["rounds"], 1)

    def test_inputs_that_were_kept_are_checked_once(self):
        self.run_soak("--check", "--only", "good")
        self.assertIn("-runs=0", (self.folder / "arguments").read_text())


if __name__ == "__main__":
    unittest.main()

"""Tests `etude train`: it learns a fuzzy system that scenarios can use."""
import unittest

from etude_case import EtudeCase

MOVES = ["builtin:clap", "builtin:sway", "builtin:boxing", "builtin:stretch", "builtin:bird"]
QUICK = ["--population", "8", "--generations", "3"]

SCENARIO = """scenario: tuned
question: Is the learnt system used?
task: pose-distance
pairs: blindspots
fuzzy: '{}'
trials: 8
methods:
  - {{name: fuzzy, distance: fuzzy}}
"""


class Train(EtudeCase):
    def train(self, *arguments, code=0):
        result = self.etude("train", *arguments, "-o", self.folder / "tuned.yaml")
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def test_writes_a_system_that_a_scenario_uses(self):
        for method in (["--method", "adaptive"], [], ["--memberships"]):
            with self.subTest(method):
                result = self.train(*MOVES, "--hold-out", "builtin:b*", *QUICK, "--overwrite", *method)
                self.assertIn("3 clips were used for learning, 2 were held out", result.stdout)
                self.assertEqual(result.stdout.count("held out  F1"), 2)
                text = (self.folder / "tuned.yaml").read_text()
                self.assertIn("# Learnt by `etude train", text)
                self.assertIn("#   builtin:boxing, builtin:bird", text)
        told = self.facts("train", *MOVES, "--hold-out", "builtin:b*", *QUICK, "--overwrite", "-o", self.folder / "tuned.yaml",
                          "--method", "adaptive")
        self.assertEqual((told["held_out"], len(told["scores"])), (["builtin:boxing", "builtin:bird"], 4))
        scenario = self.folder / "tuned_scenario.yaml"
        scenario.write_text(SCENARIO.format(self.folder / "tuned.yaml"))
        self.assertEqual(len(self.run_suite(scenario)), 8)

    def test_the_same_seed_gives_the_same_bytes(self):
        files = []
        for seed in ("1", "1", "2"):
            self.train(*MOVES, "--hold-out", "0", "--seed", seed, *QUICK, "--overwrite")
            files.append((self.folder / "tuned.yaml").read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertNotEqual(files[0].split(b"features:")[1], files[2].split(b"features:")[1])

    def test_bad_input_is_refused_and_nothing_written(self):
        for arguments, word in (([MOVES[0]], "two clips"), ([*MOVES, "--hold-out", "zzz*"], "no clip has the name"),
                                ([*MOVES, "--hold-out", "1.5"], "or a share from 0"),
                                ([*MOVES, "--method", "adaptive", "--memberships"], "--method genetic"),
                                ([*MOVES, "--generations", "0"], "--generations"), ([*MOVES, "--seed", "-1"], "--seed"),
                                (["builtin:nothing"], "nothing")):
            with self.subTest(word):
                result = self.train(*arguments, code=2)
                self.assertIn(word, result.stderr)
                self.assertEqual(len(result.stderr.strip().splitlines()), 1)
                self.assertFalse((self.folder / "tuned.yaml").exists())

    def test_a_copy_is_not_held_out_from_its_original(self):
        copy = self.folder / "copy.csv"
        self.assertEqual(self.etude("clip", "convert", MOVES[0], copy).returncode, 0)
        told = self.train(*MOVES, copy, "--hold-out", "copy", code=2).stderr
        self.assertIn(f"{copy}: shows the same motion as {MOVES[0]}, but only one of the two is held out", told)
        told = self.train(*MOVES, copy, "--hold-out", "0", "--method", "adaptive")
        self.assertIn(f"left out: {copy}: shows the same motion as {MOVES[0]}\n", told.stderr)
        self.assertIn("5 clips were used for learning, 0 were held out", told.stdout)

    def test_a_file_that_is_there_is_kept(self):
        (self.folder / "tuned.yaml").write_text("mine")
        self.train(*MOVES, code=2)
        self.assertEqual((self.folder / "tuned.yaml").read_text(), "mine")


if __name__ == "__main__":
    unittest.main()

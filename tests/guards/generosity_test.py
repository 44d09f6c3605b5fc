"""Tests scripts/generosity against counts by hand: the faults found at an exact share of praised performances."""
import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

import numpy as np

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "generosity"
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("generosity", str(SCRIPT))
generosity = importlib.util.module_from_spec(importlib.util.spec_from_loader("generosity", loader))
loader.exec_module(generosity)


class Generosity(unittest.TestCase):
    def setUp(self):
        # Ten right performances with scores 1 to 10; of four wrong ones, two score below 2 and one between 2 and 3.
        self.scores = np.array([*range(1, 11), 0.5, 1.5, 2.5, 9.5], dtype=float)
        self.truth = np.array([1] * 10 + [0] * 4, dtype=float)

    def test_the_threshold_is_where_so_many_are_praised(self):
        self.assertAlmostEqual(generosity.found_at(self.scores, self.truth, 0.9), 0.5)
        self.assertAlmostEqual(generosity.found_at(self.scores, self.truth, 0.8), 0.75)
        self.assertAlmostEqual(generosity.found_at(self.scores, self.truth, 0.85), 0.625, msg="straight between both")
        self.assertAlmostEqual(generosity.found_at(self.scores, self.truth, 0.9, self.scores == 9.5), 0)

    def test_who_says_nothing_finds_what_chance_does(self):
        same = np.ones(14)
        self.assertAlmostEqual(generosity.found_at(same, self.truth, 0.9), 0.1)
        self.assertAlmostEqual(generosity.area(same, self.truth), 0.5)

    def test_conditions_share_the_threshold_of_all_right_ones(self):
        conditions, faults = np.array(["mild"] * 5 + ["bad"] * 9), np.array(["late"] * 10 + ["late", "late", "none", "late"])
        truth = np.array([1] * 10 + [0.5, 0, 0, 0])
        people = [{"m": [self.scores, truth, faults, conditions]}]
        found = generosity.found_by_condition(people, "m", [0], 0.9)  # the threshold is 2
        self.assertAlmostEqual(found["mild"], 1 / 5)
        self.assertAlmostEqual(found["bad"], 2 / 8, msg="grey ones count, those without a fault do not")

    def test_the_area_counts_pairs(self):
        self.assertAlmostEqual(generosity.area(self.scores, self.truth), (10 + 9 + 8 + 1) / 40)


if __name__ == "__main__":
    unittest.main()

"""Tests etude.evaluate: it judges arrays and files as the program judges files."""
import math
import os
import shutil
import unittest
import warnings

from python_case import PythonCase

import etude
from etude.evaluation import _npz
from etude.program import call

NAMES = ["hip_centre", "shoulder_centre", "head", *(f"{side}_{joint}" for side in ("left", "right") for joint in (
    "shoulder", "elbow", "wrist", "hip", "knee", "ankle", "foot"))]
HEIGHTS = [1, 1.5, 1.7, *(1.45, 1.2, 0.95, 0.98, 0.5, 0.1, 0.05) * 2]


def standing(frames, across=0.0):
    """Returns a standing body, `across` metres to the side."""
    sides = [0, 0, 0, *[0.2] * 7, *[-0.2] * 7]
    return [[[x + across, y, 0.1 if "foot" in name else 0.001 * f] for name, x, y in zip(NAMES, sides, HEIGHTS)]
            for f in range(frames)]


class Evaluate(PythonCase):
    def test_arrays_are_judged_to_the_last_digit(self):
        found = standing(20, across=0.0125)
        found[7][2] = [math.nan] * 3
        run = etude.evaluate(standing(20), mine=found, names=NAMES, rate_hz=30, output=self.folder / "run", progress=False)
        row, = run["evaluate"].rows()
        self.assertAlmostEqual(row["mpjpe_unaligned_mm"], 12.5, 12)
        self.assertAlmostEqual(row["mpjpe_root_mm"], 0, 12)
        self.assertAlmostEqual(row["seen_share"], 1 - 1 / (20 * len(NAMES)), 12)

    def test_an_array_that_lies_along_another_axis_is_warned_of(self):
        lying = [[[x, -z, y] for x, y, z in frame] for frame in standing(20)]
        given = {"names": NAMES, "rate_hz": 30, "progress": False}
        with self.assertWarnsRegex(etude.DoubtWarning, "mine, .*: the answer: .*along Z"):
            etude.evaluate(standing(20), mine=lying, output=self.folder / "run", **given)
        with warnings.catch_warnings():
            warnings.simplefilter("error", etude.DoubtWarning)
            etude.evaluate(standing(20), mine=standing(20, across=0.01), output=self.folder / "clean", **given)

    def test_arrays_are_written_nowhere_else_and_over_none(self):
        given = {"truth": standing(3), "names": NAMES, "rate_hz": 30, "output": self.folder / "run", "progress": False}
        with self.assertRaises(ValueError):
            etude.evaluate(**given, **{"../../mine": standing(3)})
        self.assertEqual(list(self.folder.rglob("mine*")), [])
        etude.evaluate(**given, mine=standing(3), overwrite=True)  # replaces the truth that the failed call left
        kept = (self.folder / "run.motions" / "mine.npz").read_bytes()
        with self.assertRaisesRegex(etude.EtudeError, "run already exists; use overwrite=True to replace it"):
            etude.evaluate(**given, mine=standing(3, across=1))
        self.assertEqual((self.folder / "run.motions" / "mine.npz").read_bytes(), kept)

    def test_a_refused_array_leaves_nothing_behind(self):
        given = {"names": NAMES, "rate_hz": 30, "output": self.folder / "run", "progress": False}
        wrong = [(ValueError, "mine must have the shape frames", {"mine": [frame[1:] for frame in standing(3)]}),
                 (TypeError, "mine is None", {"mine": None}),
                 (TypeError, "mine contains values that are not numbers", {"mine": [[[None] * 3] * len(NAMES)]}),
                 (TypeError, "rate_hz is '30'", {"mine": standing(3), "rate_hz": "30"}),
                 (TypeError, "names must be a list", {"mine": standing(3), "names": "abc"})]
        for kind, text, arguments in wrong:
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                etude.evaluate(standing(3), **{**given, **arguments})
        self.assertEqual(list(self.folder.iterdir()), [])
        run = etude.evaluate(standing(3), mine=standing(3, across=0.01), metrics="mpjpe_root_mm", **given)
        self.assertEqual({each.unit for each in run.series() if each.name in NAMES}, {"mm"})

    def test_calls_in_a_row_have_folders_of_their_own(self):
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        for expected in "evaluate-1", "evaluate-2", "evaluate-2":
            run = etude.evaluate(standing(9), mine=standing(9), names=NAMES, rate_hz=30, progress=False)
            self.assertTrue((self.folder / "out" / expected / "cells.jsonl").exists())
            self.assertEqual(len(list(run["evaluate"].rows())), 1)
            if expected == "evaluate-1":
                continue
            shutil.rmtree(self.folder / "out" / "evaluate-2")
            shutil.rmtree(self.folder / "out" / "evaluate-2.motions")
        # A failed call leaves arrays, but no run.
        given = {"truth": standing(9), "mine": standing(9), "names": NAMES, "rate_hz": 30, "progress": False}
        with self.assertRaises(etude.EtudeError):
            etude.evaluate(**given, joints="nobody")
        etude.evaluate(**given)
        self.assertTrue((self.folder / "out" / "evaluate-3" / "cells.jsonl").exists())

    def test_joints_of_any_names_are_judged_by_name(self):
        names = [f"Gelenk {i} ü" for i in range(len(NAMES))]
        run = etude.evaluate(standing(5), mine=standing(5, across=0.01), names=names, rate_hz=60, joints="same",
                             output=self.folder / "same", progress=False)
        row, = run["evaluate"].rows()
        self.assertAlmostEqual(row["mpjpe_unaligned_mm"], 10, 12)
        self.assertNotIn("mpjpe_root_mm", row, "no root is known")

    def test_arrays_are_judged_alone(self):
        high = [[[x, y + 0.3, z] for x, y, z in frame] for frame in standing(20)]
        high[7][2] = [math.nan] * 3
        run = etude.evaluate(alone=True, low=standing(20), high=high, names=NAMES, rate_hz=30, limits="recorded",
                             output=self.folder / "run", progress=False)
        rows = {row["method"]: row for row in run["evaluate"].rows() if row["status"] == "ok"}
        self.assertEqual([rows[name]["floats_share"] for name in ("low", "high")], [0, 1])
        self.assertEqual([rows[name]["within_limits"] for name in ("low", "high")], [1, 0])
        self.assertEqual({file.suffix for file in (self.folder / "run.motions").iterdir()}, {".npz"})

    def test_motions_beyond_the_limits_or_not_judged_are_warned_of(self):
        for name, up in ("good", 0), ("high", 0.3):
            motion = [[[x, y + up, z] for x, y, z in frame] for frame in standing(20)]
            (self.folder / f"{name}.npz").write_bytes(_npz(motion, NAMES, 30, {}, name))
        (self.folder / "bad.npz").write_text("no motion")
        given = {"alone": True, "mine": self.folder, "overwrite": True, "output": self.folder / "run", "progress": False}
        with self.assertWarnsRegex(UserWarning, "1 of 3 motions are not judged: mine, bad: "):
            etude.evaluate(**given)
        with self.assertWarnsRegex(etude.LimitWarning, "1 of 3 motions are beyond the limits: mine, high: "):
            etude.evaluate(limits="recorded", **given)
        (self.folder / "bad.npz").unlink()
        (self.folder / "high.npz").unlink()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            etude.evaluate(limits="recorded", **given)

    def test_arrays_have_the_unit_and_the_axis_that_are_told(self):
        found = [[[100 * x, -100 * z, 100 * y] for x, y, z in frame] for frame in standing(20)]
        run = etude.evaluate(found, mine=found, names=NAMES, rate_hz=30, unit="cm", up="z", output=self.folder / "cm", progress=False)
        row, = run["evaluate"].rows()
        self.assertAlmostEqual(row["floating_mm"], 50, 9, "the toes are 5 cm high")
        self.assertIn("1 unit = 1 cm; turned upright from Z up", row["reason"])

    def test_files_have_the_unit_that_is_told(self):
        for name, across in ("truth", 0), ("mine", 0.01):
            (self.folder / f"{name}.npz").write_bytes(_npz(standing(9, across), NAMES, 30, {}, name))
        for unit, error in (None, 10), ("0.9", 9):
            run = etude.evaluate(self.folder / "truth.npz", mine=self.folder / "mine.npz", unit=unit,
                                 output=self.folder / f"in {unit}", progress=False)
            self.assertAlmostEqual(run["evaluate"]["mpjpe_unaligned_mm"][0], error, 9)

    def test_both_motions_of_a_pair_are_had(self):
        for name, across in ("truth", 0), ("mine", 0.01):
            motion = standing(9, across)
            motion[4][2] = [math.nan] * 3 if across else motion[4][2]
            (self.folder / f"{name}.npz").write_bytes(_npz(motion, NAMES, 30, {}, name))
        call("evaluate", self.folder / "truth.npz", self.folder / "mine.npz", "--keep", "motions", "-o", self.folder / "kept")
        run = etude.load(self.folder / "kept")
        row, = run["evaluate"].rows()
        truth, mine = run.motion(row), run.motion(row, "mine")
        self.assertEqual((mine.name, run.motion(row, "answer").name, mine.rate_hz), ("answer", "answer", 30))
        self.assertEqual(set(mine.joints), set(NAMES))
        self.assertEqual(dict(zip(mine.joints, mine.parents))["left_wrist"], "left_elbow")
        # Each joint's mean error, in millimetres.
        for j, joint in enumerate(mine.joints):
            off = [math.dist(a[j], b[j]) for a, b in zip(truth.positions_m, mine.positions_m) if a[j][0] == a[j][0]
                   and b[j][0] == b[j][0]]
            self.assertEqual(len(off), 8 if joint == "head" else 9)
            self.assertAlmostEqual(1000 * sum(off) / len(off), 10, 6, joint)
        with self.assertRaisesRegex(etude.EtudeError, "there are truth, answer"):
            run.motion(row, "solution")

    def test_an_array_of_another_shape_is_refused_with_its_shape(self):
        with self.assertRaisesRegex(ValueError, "frames × 17 joints .* × 3, not 3 × 16 × 3"):
            etude.evaluate([frame[1:] for frame in standing(3)], mine=standing(3), names=NAMES, rate_hz=30,
                           output=self.folder / "none", progress=False)

    def test_pairs_that_are_not_judged_warn(self):
        for folder, names in ("t", "ab"), ("m", "ac"):
            (self.folder / folder).mkdir()
            for name in names:
                (self.folder / folder / f"{name}.npz").write_bytes(_npz(standing(9), NAMES, 30, {}, name))
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            run = etude.evaluate(self.folder / "t", mine=self.folder / "m", output=self.folder / "two", progress=False)
        said = [f"{warning.category.__name__}: {warning.message}" for warning in told]
        for expected in ("UserWarning: 1 of 2 pairs are not judged: mine, b: the method has no answer",
                         f"DoubtWarning: {self.folder}/m/c.npz: no truth is named 'c'"):
            self.assertTrue(any(text.startswith(expected) for text in said), said)
        self.assertEqual([row["status"] for row in run["evaluate"].rows()], ["ok", "failed"])

    def test_what_is_missing_is_told(self):
        for wrong, arguments in [(TypeError, {"truth": standing(3), "mine": standing(3)}),
                                 (TypeError, {"truth": "a.bvh"}),
                                 (TypeError, {"truth": "a.bvh", "mine": "b.bvh", "alone": True}),
                                 (ValueError, {"truth": standing(3), "mine": standing(3), "names": ["a"], "rate_hz": 30}),
                                 (etude.EtudeError, {"truth": "none.bvh", "mine": "none.trc"})]:
            with self.subTest(arguments=list(arguments)), self.assertRaises(wrong):
                etude.evaluate(**arguments, output=self.folder / "none", progress=False)


if __name__ == "__main__":
    unittest.main()

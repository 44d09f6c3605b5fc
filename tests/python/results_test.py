"""Tests a run as the package reads it, against the run's files and its page's tables."""
import csv
import importlib.util
import json
import math
import shutil
import statistics
import subprocess
import sys
import unittest
from unittest import mock

from python_case import ROOT, SCENARIO, PythonCase, rows_of

import etude


@etude.method(task="ik", name="moody")
def moody(problem):
    raise etude.NoAnswer("not in the mood")


class Results(PythonCase):
    @classmethod
    def setUpClass(cls):
        cls.out = cls.shared_folder() / "run"
        try:
            etude.run(SCENARIO, methods=[moody], output=cls.out, jobs=1, progress=False)
            raise AssertionError("a method without an answer is no error")
        except etude.EtudeError as error:
            cls.error, cls.run_ = error, error.run
        etude.report(cls.run_, video=False, progress=False)
        cls.rows = rows_of(cls.out)

    def test_a_method_that_never_answers_is_an_error_with_the_run(self):
        self.assertEqual(self.error.exit_code, 1)
        self.assertIn("none of the 12 cells of moody has an answer", self.error.text)

    def test_a_table_has_the_values_of_the_rows_and_no_null_column(self):
        self.assertEqual((list(self.run_), len(self.run_), "ik" in self.run_), (["ik"], 1, True))
        table = self.run_["ik"]
        self.assertEqual((len(table), table.task), (48, "ik"))
        for name in table.columns:
            values = [row.get(name) for row in self.rows]
            self.assertEqual(list(table[name]), values, name)
            self.assertFalse(all(value is None for value in values), name)
        everything = {name for row in self.rows for name in row} - {"null_reasons"}
        self.assertEqual(everything, {*table.columns, *table.null_columns,
                                      *[name for name in everything if name.startswith("digest_")]})
        self.assertEqual(list(table.rows())[5]["orientation_error_deg"], self.rows[5]["orientation_error_deg"])
        self.assertEqual(list(table["digest_solution"]), [row.get("digest_solution") for row in self.rows])

    def test_columns_are_typed_and_know_their_metric(self):
        column = self.run_["ik"]["orientation_error_deg"]
        self.assertEqual((column.unit, column.metric.direction), ("deg", "lower"))
        self.assertIn("Angle between", column.definition)
        self.assertIsInstance(self.run_["ik"]["trial"][0], int)
        self.assertEqual(type(self.run_["ik"]["joint_noise_deg"][0]), float)
        self.assertEqual(self.run_["ik"]["method"].unit, "")

    def test_a_missing_value_is_none_with_the_reason_of_its_row(self):
        table = self.run_["ik"]
        moody_cells = [i for i, row in enumerate(self.rows) if row["reason"] and "not in the mood" in row["reason"]]
        self.assertTrue(moody_cells)
        why = table.reasons("orientation_error_deg")
        for i, row in enumerate(self.rows):
            self.assertEqual(why[i] is None, row.get("orientation_error_deg") is not None)
        self.assertIn("not in the mood", why[moody_cells[0]])
        self.assertIsNone(table["orientation_error_deg"][moody_cells[0]])
        self.assertTrue(math.isnan(table["orientation_error_deg"].values[moody_cells[0]]))

    def test_some_cells_are_a_table_too(self):
        table = self.run_["ik"].where(method="adaptive", joint_noise_deg=15)
        wanted = [row for row in self.rows if (row["method"], row["joint_noise_deg"]) == ("adaptive", 15)]
        self.assertEqual([row["cell"] for row in table.rows()], [row["cell"] for row in wanted])
        moody_table = self.run_["ik"].where(method="moody")
        self.assertIn("not in the mood", "".join(filter(None, moody_table.reasons("orientation_error_deg"))))
        # A method that is missing in a part of the table is no mistake, because the whole table has it.
        self.assertEqual(len(table.where(status="crashed").where(method="moody")), 0)

    def test_verdicts_are_those_of_the_page(self):
        with open(self.out / "report/tables/ik-comparisons.csv", newline="") as file:
            page = list(csv.DictReader(file))
        told = self.run_.verdicts()
        self.assertGreater(len(told), 20)
        key = {(each.condition, each.metric, each.baseline, each.method, each.against): each for each in told}
        self.assertEqual(len(key), len(told))
        self.assertEqual(len(page), len(told))
        number = lambda text: float(text) if text else None  # noqa: E731
        for row in page:
            each = key[row["condition"], row["metric"], row["baseline"], row["method"], row["against"]]
            self.assertEqual(each.verdict, row["verdict"])
            self.assertEqual(each.beyond or "", row["beyond_verdict"])
            self.assertEqual(each.pairs, int(row["pairs"]))
            for mine, theirs in ((each.difference, "difference"), (each.ci95_low, "ci95_low"), (each.p_holm, "p_holm")):
                self.assertEqual(mine, number(row[theirs]))

    def test_answers_are_about_success_first(self):
        told = self.run_.answers()
        self.assertEqual({each.against for each in told}, {"baseline", "rival"})
        moody = [each for each in told if each.method == "moody" and each.against == "baseline"]
        self.assertTrue(moody)
        for each in told:
            success = each.details["success"]
            self.assertEqual(success["metric"], "solved_practical")
            if success["verdict"] in ("better", "worse"):
                self.assertEqual((each.decided_by, each.verdict), ("success", success["verdict"]))
            else:
                self.assertNotEqual(each.decided_by, "success")
        # The difference of success, from the rows; a failed cell counts 0.
        solved = {(row["method"], row["joint_noise_deg"], row["trial"]): row.get("solved_practical") or 0
                  for row in self.rows}
        for each in moody:
            level = int(each.condition.split("=")[1])
            differences = [solved["moody", level, trial] - solved[each.baseline, level, trial] for trial in range(6)]
            self.assertAlmostEqual(each.details["success"]["difference"], statistics.mean(differences), places=7)
        self.assertEqual([each for each in told if each.scenario == "ik"], self.run_.answers("ik"))

    def test_pairs_are_the_worlds_behind_a_verdict(self):
        for condition in ("joint_noise_deg=5", "joint_noise_deg=15"):
            pairs = self.run_.pairs("adaptive", "fixed", condition=condition)
            self.assertEqual((len(pairs), pairs.unit, pairs.metric.id), (6, "deg", "orientation_error_deg"))
            self.assertAlmostEqual(statistics.median(pairs.difference), pairs.verdict.difference, places=7)
            self.assertEqual(list(pairs.difference), [m - b for m, b in zip(pairs.method, pairs.baseline)])
        both = self.run_.pairs("moody", "fixed", "position_error_cm")
        self.assertEqual((len(both) + both.only_baseline, both.only_method, both.neither), (12, 0, 0))
        self.assertGreater(both.only_baseline, 0)
        self.assertIsNone(both.verdict)

    def test_a_motion_has_names_a_rate_and_a_unit(self):
        cell = "ik/joint_noise_deg=15/000/adaptive"
        self.assertIn(cell, self.run_.recorded())
        motion = self.run_.motion(cell, "truth")
        told = json.loads((self.out / "recordings" / (cell.replace("/", "~") + ".json")).read_text())["tracks"]
        truth = next(track for track in told if track["name"] == "truth")
        self.assertEqual((motion.rate_hz, motion.unit, len(motion.joints)), (truth["rate_hz"], "m", 20))
        self.assertEqual(motion.joints[0], "hip_centre")
        self.assertEqual([x for joint in motion.positions_m[3] for x in joint], truth["poses"][3])
        self.assertEqual(self.run_.motion(cell, "adaptive").name, "solution")
        self.assertEqual(self.run_.motion(cell, "fixed").cell, "ik/joint_noise_deg=15/000/fixed")

    def test_a_track_comes_before_a_method_of_its_name(self):
        methods = [{**method, "name": name} for method, name in zip(SCENARIO["methods"], ("ours", "truth"))]
        scenario = {**SCENARIO, "methods": methods, "trials": 1, "video": {"compare": ["ours", "truth"], "trials": [0]}}
        run = etude.run(scenario, output=self.folder / "run", jobs=1, progress=False)
        for method in ("ours", "truth"):
            cell = f"ik/joint_noise_deg=15/000/{method}"
            told = json.loads((run.folder / "recordings" / (cell.replace("/", "~") + ".json")).read_text())["tracks"]
            poses = {track["name"]: track["poses"] for track in told}
            for motion, track in ((run.motion(cell), "truth"), (run.motion(cell, "solution"), "solution")):
                self.assertEqual((motion.cell, motion.name), (cell, track))
                self.assertEqual([x for joint in motion.positions_m[-1] for x in joint], poses[track][-1])
            self.assertNotEqual(poses["truth"][-1], poses["solution"][-1])

    def test_series_are_those_of_the_file(self):
        lines = [json.loads(line) for line in (self.out / "series/ik.jsonl").read_text().splitlines()]
        wanted = {line["cell"]: each["values"] for line in lines for each in line["series"]
                  if each["name"] == "position_error_max_cm"}
        told = list(self.run_.series("position_error_max_cm"))
        self.assertEqual({each.cell: list(each.values) for each in told}, wanted)
        self.assertEqual((told[0].unit, told[0].axis), ("cm", "iteration"))
        one = list(self.run_.series("position_error_max_cm", method="fixed", condition="joint_noise_deg=5", trial=2))
        self.assertEqual([each.cell for each in one], ["ik/joint_noise_deg=5/002/fixed"])

    def test_what_is_not_there_is_told_with_what_is(self):
        for ask, says in ((lambda: self.run_["ki"], "there are ik"),
                          (lambda: self.run_["ik"]["orientation_error"], "did you mean 'orientation_error_deg'"),
                          (lambda: self.run_["ik"].where(method="adaptve"), "no method 'adaptve'; did you mean 'adaptive'?"),
                          (lambda: self.run_["ik"].where(joint_noise_deg=16), "no joint_noise_deg '16'; there are 5"),
                          (lambda: self.run_.pairs("adaptive", "fixd"), "no scenario has both"),
                          (lambda: self.run_.pairs("adaptive", "fixed", condition="x=1"), "allowed: joint_noise_deg=5"),
                          (lambda: self.run_.motion("ik/joint_noise_deg=15/001/fixed"), "the scenario's key `video`"),
                          (lambda: list(self.run_.series("mpjpe_mm")), "no curve 'mpjpe_mm'"),
                          (lambda: etude.load(self.folder), "is not a result folder")):
            with self.assertRaises(etude.EtudeError) as raised:
                ask()
            self.assertIn(says, str(raised.exception))

    def test_a_changed_value_is_refused(self):
        copy = self.folder / "copy"
        shutil.copytree(self.out, copy)
        text = (copy / "cells.jsonl").read_text()
        (copy / "cells.jsonl").write_text(text.replace('"status":"ok"', '"status":"failed"', 1))
        with self.assertRaises(etude.EtudeError) as raised:
            etude.load(copy)
        self.assertIn("was changed after the run wrote it", raised.exception.text)
        self.assertEqual(raised.exception.exit_code, 2)
        self.assertEqual(len(etude.load(copy, unsealed=True)["ik"]), 48)

    def test_without_numpy_the_values_are_the_same(self):
        with mock.patch.dict(sys.modules, {"numpy": None}):
            run = etude.load(self.out)
            table = run["ik"]
            self.assertEqual(type(table["iterations"].values).__module__, "array")
            for name in table.columns:
                self.assertEqual(list(table[name]), [row.get(name) for row in self.rows], name)
            self.assertEqual(len(table.where(method="fixed")), 12)
            motion = run.motion("ik/joint_noise_deg=15/000/adaptive")
            self.assertEqual((len(motion.positions_m[0]), len(motion.positions_m[0][0])), (20, 3))

    def test_what_needs_a_module_that_is_not_there_tells_where_it_is_had(self):
        for module, ask in (("pandas", lambda: self.run_["ik"].to_pandas()), ("xarray", lambda: self.run_["ik"].to_xarray()),
                            ("pandas", lambda: self.run_.pairs("adaptive", "fixed").to_pandas())):
            with mock.patch.dict(sys.modules, {module: None}), self.assertRaisesRegex(
                    ModuleNotFoundError, f"pip install {module}, or install Debian's python3-{module}. .*--system-site-packages"):
                ask()
        code = "import sys; sys.modules['matplotlib'] = None; import etude; etude.plot"
        self.assertIn("python3-matplotlib", subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stderr)

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "needs pandas")
    def test_a_frame_has_the_units(self):
        frame = self.run_["ik"].to_pandas()
        self.assertEqual(frame.shape, (48, len(self.run_["ik"].columns)))
        self.assertEqual(frame.attrs["units"]["orientation_error_deg"], "deg")
        self.assertEqual(self.run_.pairs("adaptive", "fixed").to_pandas().shape, (12, 6))

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "needs xarray (scripts/setup --python)")
    def test_a_dataset_has_an_axis_for_conditions_trials_and_methods(self):
        table = self.run_["ik"]
        data = table.to_xarray()
        self.assertEqual(list(data["method"].values), list(dict.fromkeys(table["method"])))
        self.assertEqual(data["joint_noise_deg"].dims, ("condition",))
        self.assertEqual(data["orientation_error_deg"].attrs["units"], "deg")
        found = data["orientation_error_deg"]
        for row in table.rows():
            at = found.sel({axis: row[axis] for axis in found.dims})
            value = row["orientation_error_deg"]
            self.assertTrue(math.isnan(at.item()) if value is None else at.item() == value, row["cell"])
            self.assertEqual(float(at["joint_noise_deg"]), row["joint_noise_deg"])
        part = table.where(method="fixed", trial=1).to_xarray()
        self.assertEqual(dict(part.sizes), {"condition": 2, "trial": 1, "method": 1})

    def test_the_import_loads_nothing_that_is_not_used(self):
        code = "import sys; before = set(sys.modules); import etude; print(*sorted(set(sys.modules) - before))"
        said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
        self.assertIn("etude", said)
        self.assertLess(len(said), 8, said)
        code = "import sys; sys.path.insert(0, 'python'); import etude; etude.load, etude.run, etude.method, etude.serve; " \
               "print([name for name in ('numpy', 'pandas', 'matplotlib') if name in sys.modules])"
        self.assertEqual(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT).stdout,
                         "[]\n")


if __name__ == "__main__":
    unittest.main()

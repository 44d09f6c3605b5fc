"""Tests that figures have the page's values."""
import csv
import importlib.util
import json
import re
import unittest

from python_case import SCENARIO, PythonCase

import etude

BUDGET = {"scenario": "capture", "question": "What does it cost?", "task": "capture", "trials": 2, "duration_s": 0.5,
          "clips": ["builtin:boxing"], "methods": [
              {"name": "marked", "segmenter": "hue", "solver": "gauss-newton"},
              {"name": "true-directions", "segmenter": "hue", "solver": "gauss-newton",
               "oracle": ["directions"]}], "metrics": ["mpjpe_mm"]}


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "needs matplotlib (scripts/setup --python)")
class Plot(PythonCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = etude.run({**SCENARIO, "trials": 12, "video": {}}, output=cls.shared_folder() / "run", jobs=1,
                             progress=False)
        cls.page = etude.report(cls.run_, video=False, progress=False).read_text()

    def test_the_estimation_plot_has_the_page_s_worlds_and_interval(self):
        pairs = self.run_.pairs("adaptive", "fixed", condition="joint_noise_deg=15")
        values, differences = etude.plot.estimation(pairs).axes
        with open(self.run_.folder / "report/tables/ik-comparisons.csv", newline="") as file:
            row = next(row for row in csv.DictReader(file) if (row["condition"], row["metric"], row["method"]) ==
                       ("joint_noise_deg=15", "orientation_error_deg", "adaptive"))
        interval, estimate = (next(line for line in differences.lines if line.get_gid() == name)
                              for name in ("interval", "estimate"))
        self.assertEqual(list(interval.get_ydata()), [float(row["ci95_low"]), float(row["ci95_high"])])
        self.assertEqual(list(estimate.get_ydata()), [float(row["difference"])])
        dots = [y for _, y in differences.collections[0].get_offsets().tolist()]
        self.assertEqual(dots, list(pairs.difference))
        # For each world the page states what is drawn: "trial 3: 12.4 → 0.021°".
        said = re.findall(r"<title>trial (\d+): (\S+) → (\S+)°</title>", self.page)
        left, right = ([y for _, y in dots.get_offsets().tolist()] for dots in values.collections)
        shown = {(str(trial), f"{a:.3g}", f"{b:.3g}") for trial, a, b in zip(pairs.trial, left, right)}
        near = {(trial, f"{float(a.replace(',', '')):.3g}", f"{float(b.replace(',', '')):.3g}") for trial, a, b in said}
        self.assertEqual(len(shown), 12)
        self.assertLessEqual(shown, near)

    def test_shares_are_shown_in_per_cent_as_on_the_page(self):
        pairs = self.run_.pairs("adaptive", "fixed", "solved_practical", condition="joint_noise_deg=15")
        values, differences = etude.plot.estimation(pairs).axes
        self.assertIn(", %", values.get_ylabel())
        self.assertTrue(differences.get_ylabel().endswith("minus fixed, percentage points"))
        said = {line.get_gid(): list(line.get_ydata()) for line in differences.lines}
        told = pairs.verdict.details
        self.assertEqual(said["estimate"], [100 * told["difference"]])
        self.assertEqual(said["interval"], [100 * told["ci95_low"], 100 * told["ci95_high"]])
        self.assertEqual({y for _, y in values.collections[0].get_offsets().tolist()} - {0.0, 100.0}, set())

    def test_curves_are_the_page_s(self):
        island = json.loads(re.search(r'<script type="application/json" id="[^"]*curves">(.*?)</script>', self.page)[1])
        figure = etude.plot.curves(self.run_, "orientation_error_max_deg")
        lines = {line.get_label(): list(line.get_ydata()) for line in figure.axes[0].lines}
        self.assertEqual(len(island["methods"]), 3)
        for method in island["methods"]:
            self.assertEqual(lines[method["name"]][::island["stride"]], method["values"])
        with self.assertRaisesRegex(etude.EtudeError, "no curve 'mpjpe_mm'"):
            etude.plot.curves(self.run_, "mpjpe_mm")

    def test_an_error_budget_is_the_summary_s(self):
        with self.assertRaisesRegex(etude.EtudeError, "no error budget"):
            etude.plot.error_budget(self.run_)
        run = etude.run(BUDGET, output=self.folder / "run", jobs=1, progress=False)
        budget = run.summary["scenarios"][0]["conditions"][0]["error_budgets"][0]
        bars = etude.plot.error_budget(run).axes[0].patches
        self.assertEqual([bars[0].get_width(), bars[-1].get_width()], [budget["total"], budget["rest"]])
        self.assertAlmostEqual(bars[1].get_width(), -budget["shares"][0]["mean"])


if __name__ == "__main__":
    unittest.main()

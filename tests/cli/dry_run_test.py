"""Tests `etude run --dry-run`: it forecasts a run's time and findings, and writes nothing."""

import json
import pathlib
import re
import unittest

from etude_case import EtudeCase

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "scenarios"
SCENARIO = """
scenario: s
question: which?
task: tracking
clips: [{clips}]
duration_s: 0.3
trials: 8
methods: [{{name: a, solver: ccd}}, {{name: b, solver: gauss-newton}}]
metrics: [position_error_cm]
"""


class DryRun(EtudeCase):
    def tell(self, clips):
        file = self.folder / "s.yaml"
        file.write_text(SCENARIO.format(clips=", ".join(clips)))
        told = self.ends(0, "run", file, "--dry-run", "-o", self.out)
        self.assertEqual(list(self.folder.iterdir()), [file])
        return told.stdout

    def test_counts_cells_and_what_could_be_shown(self):
        clips = ["builtin:clap", "builtin:boxing", "builtin:robot", "builtin:sway", "builtin:stretch", "builtin:side_kick"]
        told = self.tell(clips)
        self.assertTrue(told.endswith("The time is an estimate: the costs of s are unknown, so Etude measured their first worlds just now.\n"))
        self.assertIn("1 condition × 8 worlds × 2 methods = 16 cells", told)
        # For 8 pairs, (t(0.975) + t(0.8)) / √8 = 1.15, where t has 7 degrees of freedom; likewise for 6 clips.
        self.assertIn("1 comparison detects a mean difference of at least 1.15 standard deviations of the per-world differences", told)
        self.assertIn("a difference of at least 1.42 standard deviations of the mean differences of 6 clips", told)

    def test_of_a_shard_tells_its_own_cells_and_time(self):
        whole = self.facts("quick/ik", "--trials", 8)
        parts = [self.facts("quick/ik", "--trials", 8, "--shard", f"{i}/3") for i in (1, 2, 3)]
        self.assertEqual((whole["shard"], [part["shard"] for part in parts]), (None, ["1/3", "2/3", "3/3"]))
        self.assertEqual(sum(part["cells"] for part in parts), whole["cells"])
        said = self.etude("run", "quick/ik", "--trials", 8, "--dry-run", "--shard", "2/3").stdout
        self.assertIn(f"Shard 2/3: {parts[1]['cells']} of {whole['cells']} cells.\n{parts[1]['cells']} cells; the run takes about ", said)

    def test_says_that_two_clips_carry_nothing(self):
        self.assertIn("verdicts about other clips: not possible with 2 clips; at least 6 are needed", self.tell(["builtin:clap", "builtin:boxing"]))

    def facts(self, *arguments):
        told = self.ends(0, "run", *arguments, "--dry-run", "--json")
        return json.loads(told.stdout)

    def test_what_shipped_scenarios_cost_is_kept_and_scaled(self):
        kept = {one["work"]: one for one in json.loads((SCENARIOS / "costs.json").read_text())["scenarios"]}
        told = self.facts("quick/ik", "--trials", 5)
        self.assertNotIn("guess", self.etude("run", "quick/ik", "--trials", 5, "--dry-run").stdout)
        one, = told["scenarios"]
        self.assertTrue(one["kept"])
        cost = kept[one["work"]]
        # The forecast multiplies both stored costs, that of a world and that of the run, by the same factor.
        pace = one["world_s"] * one["conditions"] / cost["trial"]
        self.assertAlmostEqual(told["run_s"] * told["workers"], pace * (cost["once"] + 5 * cost["trial"]), 9)

    def test_every_shipped_scenario_has_its_cost(self):
        told = self.etude("list", "scenarios", "--json")
        works = {f"{one['name']}: {one['scenario']}": one["work"] for one in json.loads(told.stdout)["scenarios"]}
        kept = {one["work"] for one in json.loads((SCENARIOS / "costs.json").read_text())["scenarios"]}
        self.assertGreater(len(works), 60)
        self.assertEqual([name for name, work in works.items() if work not in kept], [], "scripts/costs measures them")
        # The control: another number of sweeps has another cost.
        text = (SCENARIOS / "quick" / "ik.yaml").read_text()
        (self.folder / "other.yaml").write_text(text.replace("max_sweeps: 1000", "max_sweeps: 900"))
        other = json.loads(self.etude("list", "scenarios", self.folder, "--json").stdout)["scenarios"][0]
        self.assertNotIn(other["work"], kept)

    def test_units_that_are_kept_are_those_that_are_drawn(self):
        text = (SCENARIOS / "quick" / "transition.yaml").read_text().split("clips:")[1].split("trials:")[0]
        clips = [line.split("#")[0].strip(" -'\n") for line in text.splitlines() if line.strip()]
        kept = self.facts("quick/transition")["scenarios"][0]
        drawn = self.facts("quick/transition", *(word for clip in clips for word in ("--clips", clip)))["scenarios"][0]
        self.assertEqual((kept["kept"], drawn["kept"]), (True, False))
        self.assertEqual(kept["units"], drawn["units"])
        # With fewer trials or another seed, units are counted anew.
        self.assertLessEqual(self.facts("quick/transition", "--trials", 3)["scenarios"][0]["units"], 6)
        self.assertGreater(self.facts("quick/transition", "--seed", 2)["scenarios"][0]["units"], 6)

    def test_what_is_changed_is_measured(self):
        (self.folder / "ik.yaml").write_text((SCENARIOS / "quick" / "ik.yaml").read_text().replace("trials: 60", "trials: 2"))
        self.assertTrue(self.facts(self.folder / "ik.yaml")["scenarios"][0]["kept"])
        text = (self.folder / "ik.yaml").read_text()
        (self.folder / "ik.yaml").write_text(text.replace("max_sweeps: 1000", "max_sweeps: 900"))
        self.assertNotEqual((self.folder / "ik.yaml").read_text(), text)
        told = self.facts(self.folder / "ik.yaml")["scenarios"][0]
        self.assertFalse(told["kept"])
        self.assertGreater(told["world_s"], 0)
        self.assertEqual((told["metric"], told["spread"]), ("orientation_error_deg", None), "two worlds have no spread")

    def test_tells_the_least_difference_in_the_unit_of_the_metric(self):
        spread = self.facts("quick/ik", "--trials", 14)["scenarios"][0]["spread"]
        told = self.etude("run", "quick/ik", "--trials", 14, "--dry-run").stdout
        self.assertIn("of at least 1.36 standard deviations of the per-world differences, about ", told)
        amount, = re.findall(r", about ([\d.]+)° of effector orientation error \(in practice, a difference of 0\.1° or more matters\)", told)
        self.assertAlmostEqual(float(amount), 1.364 * spread, delta=0.01 * spread)

    def test_promises_nothing_where_no_p_can_reach_the_level(self):
        # Success decides ten answers. With n worlds the smallest mid-p is 1 / 2ⁿ, so 1 / 2ⁿ ≤ 0.05 / 10 needs 8 worlds.
        told = self.etude("run", "quick/ik", "--trials", 7, "--dry-run").stdout
        self.assertIn("at least 8 worlds are needed to judge a method better or worse; the run has 7", told)
        self.assertNotIn("standard deviations", told)
        self.assertNotIn("80 %", told)
        self.assertEqual(self.facts("quick/ik", "--trials", 7)["scenarios"][0]["worlds_needed"], 8)
        # The control: 14 worlds are enough for each of 50 comparisons, because 2 / 2ⁿ ≤ 0.05 / 50 needs 11 worlds.
        self.assertNotIn("to judge a method better or worse", self.etude("run", "quick/ik", "--trials", 14, "--dry-run").stdout)
        self.assertIn("at least 11 worlds are needed to judge metric values in 50 ",
                      self.etude("run", "quick/ik", "--trials", 9, "--dry-run").stdout)


if __name__ == "__main__":
    unittest.main()

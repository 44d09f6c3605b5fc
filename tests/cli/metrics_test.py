"""Metrics from outside: in Python they equal ours to the last digit, and a bad one costs its own values alone."""
import json
import pathlib
import subprocess
import unittest

from etude_case import EtudeCase

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/outside-metrics"
TWINS = {"own-mpjpe": ("mpjpe_mm", "mpjpe"), "own-jump": ("jump_cm", "jump"), "own-f1": ("f1", "f_one")}

HEAD = """scenario: s
question: Does it measure?
task: ik
trials: 3
methods: [{name: a, solver: gauss-newton}, {name: b, solver: damped-least-squares}]
"""
# One metric, all manners: told by options.manner.
METRIC = """import json, os, sys
manner, asked = None, 0
for line in sys.stdin:
    told = json.loads(line)
    if told["type"] == "hello":
        manner = told["options"].get("manner", "good")
        reply = {"type": "hello", "protocol": 1, "name": "m", "version": "1"}
    elif told["type"] == "setting":
        reply = {"type": "ready"}
    else:
        problem = told["problem"]
        tracks = {track["name"]: track for track in problem["tracks"]}
        answer = {"value": tracks["solution"]["poses"][-1][0] * 1000}
        if manner == "absent":
            answer = {"value": None, "reason": "the hips hid"}
        if manner == "silent":
            answer = {"value": None}
        if manner == "text":
            answer = {"value": "much"}
        if manner == "falls" and problem["tracks"][0]["poses"]:
            sys.exit("about to fall")
        if manner == "looks":
            answer = {"value": float(len(os.listdir(".")) + 100 * os.path.exists("%s"))}
        reply = {"type": "answer", "id": told["id"], "answer": answer}
    print(json.dumps(reply), flush=True)
"""


def own(name, manner="good", more=""):
    return f"  - {{name: {name}, exec: [python3, FOLDER/m/m.py], options: {{manner: {manner}}}{more}}}\n"


class OwnMetrics(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = cls.shared_folder()
        made = subprocess.run([cls.etude.__globals__["ETUDE"], "run", "examples/outside-metrics/metrics.yaml", "-o",
                               str(cls.shared / "run"), "--jobs", "2"], capture_output=True, text=True, cwd=ROOT)
        assert made.returncode == 0, made.stderr
        cls.rows = [json.loads(line) for line in (cls.shared / "run/cells.jsonl").read_text().splitlines()]

    def scenario(self, metrics, head=HEAD, name="s.yaml"):
        program = self.folder / "m" / "m.py"
        program.parent.mkdir(exist_ok=True)
        program.write_text(METRIC % (self.folder / name))
        return self.write(name, head + "metrics:\n" + metrics.replace("FOLDER", str(self.folder)))

    def refused(self, text, *says, code=2):
        result = self.etude("run", self.write("refused.yaml", text), "-o", self.folder / "refused")
        self.assertEqual(result.returncode, code, result.stderr)
        for each in says:
            self.assertIn(each, result.stderr)
        self.assertFalse((self.folder / "refused").exists())

    def test_in_python_they_equal_ours_to_the_last_digit_in_rows_summary_page_and_gate(self):
        compared = 0
        for row in self.rows:
            ours, twin = TWINS[row["scenario"]]
            self.assertEqual(row[ours], row[twin], row["cell"])
            compared += row[ours] is not None
        self.assertGreater(compared, 20)
        summary = json.loads((self.shared / "run/summary.json").read_text())
        for scenario in summary["scenarios"]:
            ours, twin = TWINS[scenario["name"]]
            self.assertEqual(scenario["headline_metrics"], [ours, twin])
            for method in scenario["conditions"][0]["methods"]:
                told = {metric["id"]: metric for metric in method["metrics"]}
                for key in ("present", "median", "mean"):
                    self.assertEqual(told[ours][key], told[twin][key])
            verdicts = {(c["metric"], c["method"]): c for c in scenario["conditions"][0]["comparisons"]}
            for (metric, method), told in verdicts.items():
                if metric == twin:
                    for key in ("pairs", "difference", "verdict"):
                        self.assertEqual(told[key], verdicts[ours, method][key], (twin, key))
        self.assertEqual(self.etude("report", self.shared / "run", "--no-video").returncode, 0)
        page = (self.shared / "run/report/index.html").read_text()
        for label in ("joint error in Python", "jump in Python", "F1 in Python"):
            self.assertIn(label, page)
        baseline = self.folder / "base.json"
        gate = self.etude("gate", self.shared / "run", "--baseline", baseline, "--update")
        self.assertEqual(gate.returncode, 0, gate.stderr)
        held = self.etude("gate", self.shared / "run", "--baseline", baseline)
        self.assertEqual(held.returncode, 0, held.stdout)
        kept = json.loads(baseline.read_text())
        values = {(each["condition"], each["method"], each["metric"]): each for each in kept["values"]}
        self.assertTrue(all(twin in {key[2] for key in values} for _, twin in TWINS.values()))

    def test_the_same_bytes_for_any_jobs_shards_and_interruptions(self):
        scenario = self.scenario(own("mine", more=", unit: mm, practical: 2") + own("other", "absent"))
        self.run_suite(scenario, "--jobs", 1)
        self.run_suite(scenario, "--jobs", 2, out=self.folder / "two")
        self.assert_same_results(self.out, self.folder / "two")
        parts = [self.folder / f"part{i}" for i in (1, 2)]
        for i, part in enumerate(parts, 1):
            self.assertEqual(self.etude("run", scenario, "--shard", f"{i}/2", "-o", part).returncode, 0)
        merged = self.etude("merge", *parts, "-o", self.folder / "merged")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assert_same_results(self.out, self.folder / "merged")

    def test_it_is_versioned_asked_again_by_replay_and_verify_and_only_where_that_is_allowed(self):
        scenario = self.scenario(own("mine", more=", version: 3"))
        rows = self.run_suite(scenario)
        self.assertEqual(len({row["mine"] for row in rows}), 6)
        manifest = json.loads((self.out / "manifest.json").read_text())
        self.assertEqual([(each["id"], each["version"]) for each in manifest["own_metrics"]], [("mine", 3)])
        for command in (["replay", self.out, "--sample", "2"], ["run", "--from", self.out / "manifest.json", "-o",
                                                               self.folder / "again"]):
            refused = self.etude(*command)
            self.assertEqual(refused.returncode, 2, command)
            self.assertIn("m.py (s/mine)", refused.stderr)
            allowed = self.etude(*command, "--allow-exec")
            self.assertEqual(allowed.returncode, 0, allowed.stderr)
        program = self.folder / "m" / "m.py"
        program.write_text(program.read_text().replace("* 1000", "* 1001"))
        other = self.etude("replay", self.out, "--allow-exec")
        self.assertEqual(other.returncode, 1, other.stdout)
        self.assertIn("mine", other.stdout)
        changed = self.run_suite(self.scenario(own("mine", more=", version: 4")), out=self.folder / "four")
        self.assertEqual(len(changed), 6)
        compared = self.etude("compare", self.out, self.folder / "four")
        self.assertEqual(compared.returncode, 2)
        self.assertIn("version 3 and 4", compared.stderr)

    def test_a_bad_one_costs_its_own_values_alone(self):
        manners = {"absent": "the hips hid", "silent": "null without a 'reason'", "text": '"much" is no number',
                   "falls": "about to fall"}
        scenario = self.scenario("  - iterations\n" + "".join(own(name, name) for name in manners))
        plain = self.run_suite(self.write("plain.yaml", HEAD + "metrics: [iterations]\n"), out=self.folder / "plain")
        rows = self.run_suite(scenario)
        for row, alone in zip(rows, plain):
            for name, why in manners.items():
                self.assertIsNone(row.pop(name))
                self.assertIn(why, row["null_reasons"].pop(name))
            if not row["null_reasons"]:
                del row["null_reasons"]
            self.assertEqual(row, alone)

    def test_it_sees_its_own_folder_and_not_the_scenario(self):
        rows = self.run_suite(self.scenario(own("mine", "looks")))
        self.assertEqual({row["mine"] for row in rows}, {1.0})

    def test_vectors_are_checked_before_the_first_cell(self):
        vector = "{cell: {tracks: [{name: solution, rate_hz: 30, frames: 1, joints_m: {hip_centre: [[0.25, 0, 0]]}}]}, "
        good = self.scenario(own("mine", more=f", vectors: [{vector}expected: 250}}]"))
        self.assertEqual(len(self.run_suite(good)), 6)
        for expected, manner, says in (("249.5", "good", "expected 249.5, found 250"),
                                       ("null", "good", "expected null, found 250"),
                                       ("250", "absent", "expected 250, found null (the hips hid)"),
                                       ("null", "falls", "found null (its program: ")):
            scenario = self.scenario(own("mine", manner, f", vectors: [{vector}expected: {expected}, title: moved}}]"))
            self.refused(pathlib.Path(scenario).read_text(), "metric 'mine', test vector 1 (moved): ", says,
                         "refused.yaml:7:")

    def test_what_cannot_be_is_refused_with_its_place(self):
        program = "exec: [python3, m.py]"
        for metrics, says in ((f"[{{name: iterations, {program}}}]", "a metric 'iterations' of its own"),
                              (f"[{{name: cell, {program}}}]", "'cell' is no name of a metric"),
                              (f"[{{name: a, {program}}}, {{name: a, {program}}}]", "stands here twice"),
                              ("[{name: a}]", "'exec'"), (f"[{{name: a, {program}, colour: red}}]", "'colour'"),
                              (f"[{{name: a, {program}, vectors: [{{cell: {{}}}}]}}]", "a list 'tracks'"),
                              (f"[{{name: a, {program}, files: [nowhere]}}]", "'files' of metric 'a': 'nowhere'")):
            self.refused(HEAD + f"metrics: {metrics}\n", says, "refused.yaml")
        self.refused(f"scenario: s\nquestion: why\ntask: search\nmethods: [{{name: a}}]\nmetrics: [{{name: a, {program}}}]\n",
                     "cells of task search keep no motion")
        self.refused("defaults: {task: ik, methods: [{name: a}]}\nscenarios:\n"
                     f"  - {{scenario: x, question: why, metrics: [{{name: twice, {program}}}]}}\n"
                     f"  - {{scenario: y, question: why, metrics: [{{name: twice, {program}, unit: mm}}]}}\n",
                     "the metric 'twice' is told of in two ways: unit '' and 'mm'", "refused.yaml:4:")

    def test_expectations_and_gates_go_by_it(self):
        expects = "expect: [{metric: mine, of: a, at_most: -1e9}]\ngate: {metrics: [mine]}\n"
        scenario = self.scenario(own("mine") + expects)
        self.run_suite(scenario)
        gate = self.etude("gate", self.out)
        self.assertEqual(gate.returncode, 1, gate.stdout + gate.stderr)
        self.assertIn("mine", gate.stdout)
        baseline = self.folder / "base.json"
        update = self.etude("gate", self.out, "--baseline", baseline, "--update")
        self.assertEqual(json.loads(baseline.read_text())["scenarios"][0]["metrics"], {"mine": 1}, update.stderr)


if __name__ == "__main__":
    unittest.main()

"""Tests metrics in Python: they equal ours to the last digit, and a faulty metric loses only its own values."""
import csv
import json
import pathlib
import subprocess
import unittest

from etude_case import ETUDE, EtudeCase, cells_in_journal, heavy

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/outside-metrics"
TWINS = {"own-mpjpe": ("mpjpe_mm", "mpjpe"), "own-jump": ("jump_cm", "jump"), "own-f1": ("f1", "f_one")}

HEAD = """scenario: s
question: Does it measure?
task: ik
trials: 3
methods: [{name: a, solver: gauss-newton}, {name: b, solver: damped-least-squares}]
"""
FEW = ("--trials", "2")
# One metric with all behaviours; options.manner selects one.
METRIC = """import json, os, sys, time
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
        if manner == "off":
            answer = {"value": max(abs(a - b) for a, b in zip(tracks["solution"]["poses"][-1], tracks["truth"]["poses"][-1]))}
        if manner == "absent":
            answer = {"value": None, "reason": "its program: hips hid"}
        if manner == "silent":
            answer = {"value": None}
        if manner == "text":
            answer = {"value": "much"}
        if manner == "percent":
            answer = {"value": 50}
        if manner in ("huge", "huge_share"):
            answer = {"value": 1e308}
        if manner == "falls" and problem["tracks"][0]["poses"]:
            sys.exit("about to fall")
        if manner == "looks":
            time.sleep(0.2)  # long enough to be killed
            answer = {"value": float(len(os.listdir(".")) + 100 * os.path.exists("%s"))}
        reply = {"type": "answer", "id": told["id"], "answer": answer}
    print(json.dumps(reply), flush=True)
"""


SLOW_METHOD = """import json, sys, time
for line in sys.stdin:
    told = json.loads(line)
    reply = {"type": told["type"] if told["type"] == "hello" else "ready", "protocol": 1, "name": "own", "version": "1"}
    if told["type"] == "problem":
        print("asked", file=sys.stderr, flush=True)
        time.sleep(0.3)
        reply = {"type": "answer", "id": told["id"], "answer": {"angles_deg": told["problem"]["start_angles_deg"]}}
    print(json.dumps(reply), flush=True)
"""


VECTOR = "{cell: {tracks: [{name: solution, rate_hz: 30, frames: 1, joints_m: {hip_centre: [[0.25, 0, 0]]}}]}, "
BAD = {"absent": "its program: hips hid", "silent": "null without a 'reason'", "text": '"much" is neither a number nor null',
       "falls": "about to fall", "percent": "value: 50; allowed, because of the metric's key 'reads': 0 to 1",
       "huge": "value: 1e+308; allowed: -1e100 to 1e100",
       "huge_share": "value: 1e+308; allowed, because of the metric's key 'reads': 0 to 1"}


# The mean distance of the joints of task evaluation, mm; its cells have the files' own joints, and no tracks of ours.
FILES_METRIC = """import json, math, sys
for line in sys.stdin:
    told = json.loads(line)
    reply = {"type": told["type"] if told["type"] == "hello" else "ready", "protocol": 1, "name": "own", "version": "1"}
    if told["type"] == "problem":
        extras = told["problem"]["extras"]
        pairs = [(a[i:i + 3], b[i:i + 3]) for a, b in zip(extras["truth"], extras["answer"]) for i in range(0, len(a), 3)
                 if None not in b[i:i + 3]]
        reply = {"type": "answer", "id": told["id"], "answer": {"value": 1000 * sum(math.dist(a, b) for a, b in pairs) / len(pairs)}}
    print(json.dumps(reply), flush=True)
"""


def own(name, manner="good", more=""):
    return f"  - {{name: {name}, exec: [python3, FOLDER/m/m.py], options: {{manner: {manner}}}{more}}}\n"


def vector(expected, more=""):
    return f", vectors: [{VECTOR}expected: {expected}{more}}}]"


# The metrics of most tests: good ones, one that looks around slowly, and bad ones.
ALL = "  - iterations\n" + own("mine", more=", version: 3, unit: mm, practical: 2" + vector(250)) + own("looks", "looks") + \
      "".join(own(name, name, {"absent": vector("null"), "percent": ", reads: share", "huge_share": ", reads: share"}.get(name, "")) for name in BAD) + \
      "expect: [{metric: mine, of: a, at_most: -1e9}]\ngate: {metrics: [mine]}\n"


class OwnMetrics(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Runs the examples once, and once everything that a metric's program may do."""
        cls.shared = cls.shared_folder()
        (cls.shared / "m").mkdir()
        cls.scenario = cls.shared / "s.yaml"
        (cls.shared / "m/m.py").write_text(METRIC % cls.scenario)
        cls.scenario.write_text(cls.text(ALL))
        cls.whole = cls.shared / "whole"
        cls.rows, cls.told = (cls.run_in_class(*arguments) for arguments in (
            (ROOT / "examples/outside-metrics/metrics.yaml", cls.shared / "run"), (cls.scenario, cls.whole)))

    @classmethod
    def run_in_class(cls, scenario, folder):
        made = subprocess.run([ETUDE, "run", scenario, "-o", folder, "--jobs", "1", *FEW], capture_output=True, text=True, cwd=ROOT)
        assert made.returncode == 0, made.stderr
        return [json.loads(line) for line in (folder / "cells.jsonl").read_text().splitlines()]

    @classmethod
    def text(cls, metrics):
        return HEAD + "metrics:\n" + metrics.replace("FOLDER", str(cls.shared))

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
        self.assertGreater(compared, 10)
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
        self.ends(0, "report", self.shared / "run", "--no-video")
        page = (self.shared / "run/report/index.html").read_text()
        for label in ("joint error in Python", "jump in Python", "F1 in Python"):
            self.assertIn(label, page)
        baseline = self.folder / "base.json"
        self.ends(0, "gate", self.shared / "run", "--baseline", baseline, "--update")
        self.ends(0, "gate", self.shared / "run", "--baseline", baseline)
        kept = json.loads(baseline.read_text())
        values = {(each["condition"], each["method"], each["metric"]): each for each in kept["values"]}
        self.assertTrue(all(twin in {key[2] for key in values} for _, twin in TWINS.values()))

    @heavy
    def test_the_same_bytes_for_any_jobs_shards_and_interruptions(self):
        scenario = self.write("s.yaml", self.text(own("mine", more=", unit: mm") + own("absent", "absent") + own("looks", "looks")))
        self.run_suite(scenario, "--jobs", 1)
        parts = [self.folder / f"part{i}" for i in (1, 2)]
        command = ["run", scenario, "--shard", "1/2", "-o", str(parts[0])]
        self.kill_at(1, "cell", command, parts[0])
        self.assertIn(cells_in_journal(parts[0]), (1, 2, 3))  # four cells in all
        self.ends(0, *command, "--jobs", 2, "--resume")
        self.ends(0, "run", scenario, "--shard", "2/2", "-o", parts[1])
        self.ends(0, "merge", *parts, "-o", self.folder / "merged")
        self.assert_same_results(self.out, self.folder / "merged")

    def kill_at(self, count, kind, command, folder):
        """Kills a run of one worker when its journal has `count` cells of a kind."""
        killed = subprocess.Popen([ETUDE, *map(str, command), "--jobs", "1"], stderr=subprocess.DEVNULL, cwd=ROOT)
        self.wait_for_cells(folder, count, kind=kind)
        killed.kill()
        killed.wait()

    @heavy
    def test_what_is_answered_or_measured_is_neither_asked_nor_measured_again_after_kills(self):
        """Kills runs while methods answer and while metrics measure: each cell is answered and measured once."""
        (self.folder / "own").mkdir()
        (self.folder / "own/own.py").write_text(SLOW_METHOD)
        (self.folder / "m").mkdir()
        (self.folder / "m/m.py").write_text(METRIC % "")
        scenario = self.write("s.yaml", self.text(own("looks", "looks")).replace(str(self.shared), str(self.folder)).replace(
            "{name: b, solver: damped-least-squares}", f"{{name: own, exec: [python3, '{self.folder}/own/own.py']}}"))
        command = ["run", scenario, "-o", self.out, "--resume", "--sync-seconds", "0"]
        self.kill_at(4, "answered", command, self.out)
        self.assertEqual(cells_in_journal(self.out), 0)
        self.assertIn("lacks 6 of 6 cells", self.etude("merge", self.out, "-o", self.folder / "merged").stderr)
        self.kill_at(2, "cell", command, self.out)
        answered = (self.out / "stderr/s~own.txt").read_text().count("asked")
        self.assertIn(answered, (3, 4))  # a kill may interrupt an answer, which is then asked for again
        self.assertEqual(len(self.run_suite(scenario, "--resume", "--jobs", 2)), 6)
        self.assertEqual((self.out / "stderr/s~own.txt").read_text().count("asked"), answered)
        self.run_suite(scenario, out=self.folder / "whole")
        self.assert_same_results(self.out, self.folder / "whole")

    @heavy
    def test_ctrl_c_keeps_what_was_answered(self):
        scenario = self.write("s.yaml", self.text(own("looks", "looks")))
        stopped = subprocess.Popen([ETUDE, "run", scenario, "-o", self.out, "--jobs", "1", "--sync-seconds", "0"],
                                   stderr=subprocess.PIPE, text=True)
        self.wait_for_cells(self.out, 6, kind="answered")
        stopped.send_signal(2)
        said = stopped.communicate()[1]
        self.assertEqual(stopped.returncode, 130, said)
        self.assertIn(f"stopped; 6 finished cells were kept in {self.out};", said)
        self.assertEqual(len(self.run_suite(scenario, "--resume")), 6)

    @heavy
    def test_it_is_versioned_asked_again_by_replay_and_verify_and_only_where_that_is_allowed(self):
        self.assertEqual(len({row["mine"] for row in self.told}), 4)
        manifest = json.loads((self.whole / "manifest.json").read_text())
        versions = {each["id"]: each["version"] for each in manifest["own_metrics"]}
        self.assertEqual(versions, {"mine": 3, "looks": 1, **{name: 1 for name in BAD}})
        for command in (["replay", self.whole, "--sample", "2"],
                        ["run", "--from", self.whole / "manifest.json", "-o", self.folder / "again"]):
            self.assertIn("m.py (s/mine)", self.ends(2, *command).stderr)
        program = self.shared / "m/m.py"
        text = program.read_text()
        self.addCleanup(program.write_text, text)
        program.write_text(text.replace("* 1000", "* 1001"))
        self.assertIn("mine", self.ends(1, "replay", self.whole, "--sample", "2", "--allow-exec").stdout)
        four = self.folder / "four"
        self.assertEqual(len(self.run_suite(self.write("s.yaml", self.text(own("mine", more=", version: 4"))), *FEW, out=four)), 4)
        self.assertIn("version 3 and 4", self.ends(2, "compare", self.whole, four).stderr)
        self.ends(0, "replay", four, "--sample", "2", "--allow-exec")
        self.ends(0, "run", "--from", four / "manifest.json", "-o", self.folder / "again", "--allow-exec")
        self.assert_same_results(four, self.folder / "again")

    def test_a_bad_one_costs_its_own_values_alone(self):
        plain = self.run_suite(self.write("plain.yaml", HEAD + "metrics: [iterations]\n"), *FEW)
        for row, alone in zip(self.told, plain):
            row = {**row, "null_reasons": dict(row["null_reasons"])}
            for name, why in BAD.items():
                self.assertIsNone(row.pop(name))
                self.assertIn(why, row["null_reasons"].pop(name))
            for name in ("mine", "looks"):
                self.assertIsNotNone(row.pop(name))
            if not row["null_reasons"]:
                del row["null_reasons"]
            self.assertEqual(row, alone)

    def test_it_sees_its_own_folder_and_not_the_scenario(self):
        self.assertEqual({row["looks"] for row in self.told}, {1.0})

    @heavy
    def test_vectors_are_checked_before_the_first_cell(self):
        for expected, manner, says in (("249.5", "good", "expected 249.5, found 250"),
                                       ("null", "good", "expected null, found 250"),
                                       ("250", "absent", "expected 250, found null (its program: hips hid)"),
                                       ("null", "falls", "found null (its program: ")):
            self.refused(self.text(own("mine", manner, vector(expected, ", title: moved"))),
                         "metric 'mine', test vector 1 (moved): ", says, "refused.yaml:7:")

    @heavy
    def test_scored_answers_and_secret_worlds_are_measured_like_a_run_s(self):
        scenario, key = self.write("s.yaml", self.text(own("off_m", "off"))), self.folder / "key"
        key.write_text("0123456789abcdef" * 4)
        key.chmod(0o600)
        data, secret = self.folder / "data", ("--seed-file", key)
        self.ends(0, "export", scenario, *secret, "-o", data)
        with open(data / "inputs/index.csv", newline="") as file:
            predictions = [pathlib.Path(line["prediction"]) for line in csv.DictReader(file)]
        for number, prediction in enumerate(predictions):
            truth = json.loads((data / "truth" / prediction.with_suffix("") / "truth.json").read_text())
            (self.folder / "answers" / prediction).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / "answers" / prediction).write_text(
                json.dumps({"angles_deg": [angle + 5 * (number == 2) for angle in truth["angles_deg"]]}))
        score = ["score", data, self.folder / "answers", "-o", self.out, "--name", "told", *secret]
        self.assertIn("m.py (s/off_m)", self.ends(2, *score).stderr)
        self.ends(0, *score, "--allow-exec")
        rows = [json.loads(line) for line in (self.out / "cells.jsonl").read_text().splitlines()]
        told = [row["off_m"] for row in rows if row["method"] == "told"]
        self.assertEqual([value > 0.01 for value in sorted(told)], [False, False, True])
        self.assertLess(sorted(told)[1], 1e-9)
        run = self.run_suite(scenario, *secret, "--reuse-key", out=self.folder / "run")
        self.assertEqual([row for row in rows if row["method"] != "told"], run)
        self.assertTrue(all(row["off_m"] > 0 for row in run))
        self.assertEqual([file for folder in (self.out, self.folder / "run") for file in folder.rglob("*")
                          if file.is_file() and b"0123456789abcdef" in file.read_bytes()], [])

    @heavy
    def test_cells_of_tasks_that_judge_files_are_measured_too(self):
        """The oracle is our own metric: all joints are moved by 10 cm."""
        (self.folder / "m.py").write_text(FILES_METRIC)
        scenario = self.write("files.yaml", "scenario: files\nquestion: Does it measure?\ntask: evaluation\ntruth: ['builtin:acts']\n"
                              "methods: [{name: moved, control: true, moved_cm: 10}]\n"
                              f"metrics: [mpjpe_unaligned_mm, {{name: mine, exec: [python3, {self.folder}/m.py], unit: mm}}]\n")
        row = self.run_suite(scenario, *FEW)[0]
        self.assertAlmostEqual(row["mine"], 100, delta=1e-6)
        self.assertAlmostEqual(row["mine"], row["mpjpe_unaligned_mm"], delta=1e-6)

    def test_own_metrics_of_files_have_the_share_that_the_answer_shows(self):
        (self.folder / "m.py").write_text(FILES_METRIC)
        scenario = self.write("files.yaml", "scenario: files\nquestion: Who hides?\ntask: evaluation\ntruth: ['builtin:acts']\n"
                              "methods: [{name: moved, control: true, moved_cm: 10}, {name: hidden, control: true, hidden_percent: 20}]\n"
                              f"metrics: [mpjpe_unaligned_mm, {{name: mine, exec: [python3, {self.folder}/m.py], unit: mm}}]\n")
        for row in self.run_suite(scenario):
            shares = row["judged"].get("shares", {})
            self.assertEqual(shares.get("mine", 1), row["seen_share"])
            self.assertEqual(row["seen_share"] < 0.9, row["method"] == "hidden")
        comparisons = json.loads((self.out / "summary.json").read_text())["scenarios"][0]["conditions"][0]["comparisons"]
        mine, = [one for one in comparisons if one["metric"] == "mine"]
        self.assertEqual(mine["verdict"], "undecided")
        self.assertIn("not judged alike: “moved” is judged on 100.0 %", mine["why_open"])

    def test_what_cannot_be_is_refused_with_its_place(self):
        program = "exec: [python3, m.py]"
        for metrics, says in ((f"[{{name: iterations, {program}}}]", "'iterations' is the id of a built-in metric"),
                              (f"[{{name: judged, {program}}}]", "'judged' is a key of every row of results"),
                              (f"[{{name: A, {program}}}]", "'A' is not a valid metric name"),
                              (f"[{{name: a, {program}}}, {{name: a, {program}}}]", "is listed twice"),
                              ("[{name: a}]", "'exec'"), (f"[{{name: a, {program}, colour: red}}]", "'colour'"),
                              (f"[{{name: a, {program}, vectors: [{{cell: {{}}}}]}}]", "a list 'tracks'"),
                              (f"[{{name: a, {program}, files: [nowhere]}}]", "'files' of metric 'a': 'nowhere'")):
            self.refused(HEAD + f"metrics: {metrics}\n", says, "refused.yaml")
        self.refused(f"scenario: s\nquestion: why\ntask: pose-distance\nmethods: [{{name: a}}]\nmetrics: [{{name: a, {program}}}]\n",
                     "a scenario of task pose-distance cannot define its own metrics, because cells of this task keep no motion")
        self.refused("defaults: {task: ik, methods: [{name: a}]}\nscenarios:\n"
                     f"  - {{scenario: x, question: why, metrics: [{{name: twice, {program}}}]}}\n"
                     f"  - {{scenario: y, question: why, metrics: [{{name: twice, {program}, unit: mm}}]}}\n",
                     "the metric 'twice' has two different definitions: unit '' and 'mm'", "refused.yaml:4:")

    def test_one_without_any_value_is_told_and_makes_no_baseline(self):
        silent, baseline = self.folder / "silent", self.folder / "silent.json"
        told = self.ends(0, "run", self.write("silent.yaml", self.text(own("absent", "absent"))), "-o", silent, *FEW).stdout
        self.assertIn("your metric absent has no value in any cell", told)
        for arguments in [], ["--baseline", baseline, "--update"]:
            said = self.ends(1, "gate", silent, *arguments).stdout
            self.assertRegex(said, r"none of the \d+ cells with an answer has a value of your metric absent; .*: hips hid")
        self.assertFalse(baseline.exists())

    def test_expectations_and_gates_go_by_it(self):
        gate = self.ends(1, "gate", self.whole)
        self.assertIn("mine", gate.stdout)
        baseline = self.folder / "base.json"
        update = self.etude("gate", self.whole, "--baseline", baseline, "--update")
        self.assertEqual(json.loads(baseline.read_text())["scenarios"][0]["metrics"], {"mine": 3}, update.stderr)


if __name__ == "__main__":
    unittest.main()

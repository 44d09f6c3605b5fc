"""Tests docs/schemas/scenario.schema.json: it accepts the scenarios that the program runs, and rejects those that it
refuses."""
import pathlib
import re
import sys
import unittest

try:
    import jsonschema  # noqa: F401
    import yaml
except ImportError as missing:  # scripts/setup --tests installs both packages
    raise unittest.SkipTest(str(missing))

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tests" / "cli"), str(ROOT / "tests" / "support")]
from etude_case import IK, EtudeCase  # noqa: E402
from json_schema import complaints, load_schema  # noqa: E402

SCHEMA = load_schema("scenario.schema.json")
TRANSITION = "scenario: t\nquestion: why\ntask: transition\nclips: ['builtin:*']\nmethods: [{name: a}]\n"
SEVERAL = """defaults: {task: ik, methods: [{name: a}]}
scenarios:
  - {scenario: one, question: why}
  - {scenario: two, question: why, start: middle, sweep: {max_sweeps: [1, 2]}}
"""


def refused(text):
    return complaints(yaml.safe_load(text), SCHEMA)


def undescribed(text):
    """Returns a file's scenarios and methods without a description in a whole sentence."""
    document = yaml.safe_load(text)
    shared = document.get("defaults", {})
    scenarios = document.get("scenarios", [document])
    methods = shared.get("methods", []) + [method for scenario in scenarios for method in scenario.get("methods", [])]
    described = [(one["scenario"], one) for one in scenarios] + [(one["name"], one) for one in methods]
    return [name for name, one in described if not re.fullmatch(r"[A-Z].{10,}\.", one.get("description", ""))]


class Schema(EtudeCase):
    def test_every_scenario_of_the_repository_is_accepted_and_described(self):
        files = [file for folder in ("quick", "paper", "full") for file in (ROOT / "scenarios" / folder).glob("*.yaml")]
        self.assertGreater(len(files), 15)
        for file in files:
            self.assertEqual(refused(file.read_text()), [], file)
            self.assertEqual(undescribed(file.read_text()), [], file)
        self.assertEqual(undescribed(SEVERAL), ["one", "two", "a"])

    def test_examples_of_the_page_are_accepted(self):
        blocks = re.findall(r"```yaml\n(.*?)```", (ROOT / "docs" / "scenarios.md").read_text(), re.S)
        files = [block for block in blocks if block.startswith("# ")]
        self.assertGreaterEqual(len(files), 4)
        for block in files:
            self.assertEqual(refused(block), [], block)
        pieces = [block for block in blocks if not block.startswith("# ")]
        self.assertGreaterEqual(len(pieces), 7)
        for block in pieces:  # pieces lack the scenario's name, its question, and other keys
            whole = {"scenario": "s", "question": "q", "task": "ik", "methods": [{"name": "a"}], **yaml.safe_load(block)}
            self.assertEqual(complaints(whole, SCHEMA), [], block)

    def test_what_is_right_is_accepted(self):
        for text in (IK, TRANSITION, SEVERAL,
                     IK + "poses: {uniform: 0.2}\n", IK + "poses: 0.2\n", IK + "expect: []\nvideo: {}\n",
                     IK.replace("[2, 5]", "{from: 2, to: 5, count: 3}"),
                     IK.replace("{joint_noise_deg: [2, 5]}", "{together: {joint_noise_deg: [2, 5], poses: [0, 1]}}"),
                     IK.replace("{joint_noise_deg: [2, 5]}", "{start: [middle, stretched]}"),
                     IK + "  - {name: mine, exec: [python3, x.py], options: {any: [1]}, time_s: 2, against: fixed}\n",
                     "include: [shared/ik.yaml]\nscenario: s\nnoise: uniform\n",
                     "defaults: {task: ik, trials: 40}\n",
                     SEVERAL.replace("task: ik, ", "").replace("question: why", "question: why, task: ik")):
            self.assertEqual(refused(text), [], text)

    def test_what_is_wrong_is_marked_and_refused_by_the_program_too(self):
        no_sweep = IK.replace("sweep: {joint_noise_deg: [2, 5]}\n", "")
        cases = [
            IK.replace("task: ik", "task: ki"),
            IK.replace("task: ik\n", ""),
            IK.replace("scenario: ik", "scenario: a/b"),
            IK.replace("question: Does it run?\n", ""),
            IK.replace("trials: 4", "trials: 0"),
            IK.replace("trials: 4", "trials: 1.5"),
            IK.replace("trials: 4", "trails: 4"),
            IK + "threshold: 0.4\n",  # a key of another task
            IK + "joint_map: []\n",
            IK + "limit_set: AMA\n",
            IK + "poses: 2\n",
            IK + "poses: {unifrom: 1}\n",
            IK + "record: [angle_change]\n",
            IK + "metrics: [f1]\n",
            IK + "limits: {time: 5}\n",
            IK + "video: {trials: [0.5]}\n",
            IK + "expect: [{metric: iterations, of: fixed, belw: least-squares}]\n",
            IK + "expect: [{metric: f1, of: fixed, at_most: 1}]\n",
            IK + "gate: {rule: exactly}\n",
            IK + "gate: {time_ratios: [{of: fixed}]}\n",
            IK.replace("joint_noise_deg: [2, 5]", "joint_nose_deg: [2, 5]"),
            IK.replace("[2, 5]", "[2, 500]"),
            IK.replace("[2, 5]", "[]"),
            IK.replace("[2, 5]", "{from: 2, too: 5, count: 3}"),
            IK.replace("sweep: {joint_noise_deg: [2, 5]}", "sweep: {trials: [1, 2]}"),
            IK.replace("{joint_noise_deg: [2, 5]}", "{together: {joint_noise_deg: [2, 5]}}"),
            no_sweep + "start: middle\njoint_noise_deg: 3\n",
            no_sweep + "start: stretched\nposes: 1\n",
            IK.replace("weights: fixed", "wieghts: fixed"),
            IK.replace("weights: fixed", "weights: fixd"),
            IK.replace("solver: ccd, weights: fixed", "weights: fixed"),  # the default solver has no such setting
            IK.replace("solver: ccd, weights: fixed", "solver: ccd, memory: 3"),
            IK.replace("solver: ccd, weights: fixed", "solver: ccd-anderson, memory: 0"),
            IK.replace("{name: fixed, ", "{"),
            IK + "  - {name: mine, exec: []}\n",
            IK + "  - {name: mine, exec: [x], solver: ccd}\n",
            IK + "  - {name: mine, options: {a: 1}}\n",
            TRANSITION.replace("{name: a}", "{name: a, choice: now, threshold: 0.4}"),
            TRANSITION.replace("{name: a}", "{name: a, blend_s: 1}"),
            TRANSITION + "head_bend_deg: -1\n",
            TRANSITION.replace("clips: ['builtin:*']", "clips: builtin:*"),
            SEVERAL.replace("start: middle", "strat: middle"),
            SEVERAL.replace("{scenario: one, ", "{"),
            SEVERAL + "trials: 5\n",
            SEVERAL.replace("task: ik, ", ""),
            "scenarios: []\n",
            "- a list\n",
        ]
        accepted = [text for text in cases if not refused(text)]
        self.assertEqual(accepted, [], "the schema accepts these")
        for text in cases:
            result = self.etude("run", self.write("s.yaml", text), "-o", self.out)
            self.assertEqual(result.returncode, 2, text + result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()

"""Tests that every message of the protocol, every export and every example fits docs/schemas/protocol.schema.json."""
import json
import pathlib
import re
import unittest

import yaml
from etude_case import HEAVY, EtudeCase, heavy

import wire_probe
from json_schema import complaints, load_schema

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROBE, EXAMPLES = ROOT / "tests/support/wire_probe.py", ROOT / "examples/outside-methods"
TALKS = [("ik", "", "ik_dls.py")]
SLOW_TALKS = [("tracking", "", "tracking_dls.py"), ("transition", "", "transition_nearest.py"),
              ("detection", "", "detection_correlation.py"),
              ("coach", "recogniser", "coach_recogniser.py"), ("coach", "policy", "coach_policy.py"),
              ("coach", "learner", "coach_learner.py"), ("ik", "", "ik_lm_numpy.py"), ("transition", "", "transition_arrays_numpy.py"),
              ("capture", "", "capture_triangulation_numpy.py"), ("capture", "segmenter", "capture_segmenter.py")]
EXPORTS = {
    "ik": "task: ik\n",
    "tracking": "task: tracking\nclips: ['builtin:clap']\nduration_s: 0.2\n",
    "transition": "task: transition\nclips: ['builtin:clap', 'builtin:sway']\n",
    "pose-distance": "task: pose-distance\nclips: ['builtin:clap', 'builtin:sway']\npairs: frames\npairs_per_world: 3\n",
    "detection": "task: detection\nclips: ['builtin:clap', 'builtin:sway']\nevents: 2\n",
    "capture": "task: capture\nclips: ['builtin:clap']\nduration_s: 0.1\n",
}


class Wire(EtudeCase):
    def talk(self, task, seat, *command):
        return self.etude("check-method", "--no-fence", "--task", task, *["--seat", seat] * bool(seat), "--",
                          "/usr/bin/python3", PROBE, task, seat or "-", *command)

    def check(self, talks):
        for task, seat, example in talks:
            told = self.talk(task, seat, "/usr/bin/python3", EXAMPLES / example)
            self.assertEqual(told.returncode, 0, f"{example}: {told.stdout}{told.stderr}")
            self.assertIn("9 of 9 checks passed", told.stdout, example)

    def test_every_line_of_a_shipped_example_fits_the_schema(self):
        self.check(TALKS)

    @heavy
    def test_every_line_of_the_other_examples_fits_the_schema(self):
        self.check(SLOW_TALKS)

    def test_a_line_that_does_not_fit_is_told(self):
        bad = self.write("bad.py", "import json, sys\n"
                                   "for line in sys.stdin:\n"
                                   "    told = json.loads(line)\n"
                                   "    reply = {'type': 'ready'}\n"
                                   "    if told['type'] == 'hello':\n"
                                   "        reply = {'type': 'hello', 'protocol': 1, 'name': 'bad', 'version': '1'}\n"
                                   "    if told['type'] == 'problem':\n"
                                   "        reply = {'type': 'answer', 'id': told['id'], 'answer': {'angles_deg': ['0']}}\n"
                                   "    print(json.dumps(reply), flush=True)\n")
        told = self.talk("ik", "", "/usr/bin/python3", bad)
        self.assertNotEqual(told.returncode, 0)
        self.assertIn("answer from_method: /angles_deg/0: '0' is not of type", told.stderr)
        parents = {"type": "setting", "id": "s", "setting": {"joints": ["a", "b"], "parents": [None, 0]}}
        self.assertEqual(len(wire_probe.wrong(parents, "pose-distance", "", "from_etude")), 1, "a parent is a name")
        parents["setting"]["parents"] = [None, "a"]
        self.assertEqual(wire_probe.wrong(parents, "pose-distance", "", "from_etude"), [])
        parents["setting"]["ages"] = []
        self.assertEqual(len(wire_probe.wrong(parents, "pose-distance", "", "from_etude")), 1, "nothing undeclared is sent")

    @heavy
    def test_every_line_to_a_metric_and_its_scenario_fit_the_schema(self):
        text = (ROOT / "examples/outside-metrics/metrics.yaml").read_text()
        self.assertEqual(complaints(yaml.safe_load(text), load_schema("scenario.schema.json")), [])
        probed = re.sub(r"exec: \[python3, (examples/outside-m)", rf"exec: [python3, {PROBE}, metric, '-', /usr/bin/python3, {ROOT}/\1", text)
        probed = probed.replace("metric, '-', /usr/bin/python3, " + str(ROOT) + "/examples/outside-methods",
                                "detection, '-', /usr/bin/python3, " + str(ROOT) + "/examples/outside-methods")
        rows = self.run_suite(self.write("metrics.yaml", probed), "--no-fence", "--trials", 1)
        self.assertEqual(len(rows), 6)
        for name in ("mpjpe", "jump", "f_one"):
            self.assertGreater(sum(row.get(name) is not None for row in rows), 0, name)

    def test_every_export_fits_the_schema(self):
        checked, exports = 0, EXPORTS if HEAVY else {task: EXPORTS[task] for task in ("ik", "pose-distance")}
        for task, text in exports.items():
            scenario = self.write(f"{task}.yaml", f"scenario: {task}\nquestion: q\ntrials: 1\nmethods: [{{name: a}}]\n{text}")
            data = self.folder / f"data-{task}"
            self.ends(0, "export", scenario, "-o", data)
            for path in sorted([*data.glob("inputs/**/setting.json"), *data.glob("inputs/**/problem.json")]):
                found = complaints(json.loads(path.read_text()), wire_probe.payload_schema(task, "", path.stem))
                self.assertEqual([each[:300] for each in found[:3]], [], path)
                checked += 1
        self.assertEqual(checked, 2 * len(exports), "a setting and a problem of every task")


if __name__ == "__main__":
    unittest.main()

"""Tests examples/rivals against replacements that fail at every undocumented call, and against the packages if they
are installed."""
import importlib.util
import pathlib
import re
import unittest

from etude_case import EtudeCase, heavy

ROOT = pathlib.Path(__file__).resolve().parents[2]
RIVALS, STUBS = ROOT / "examples/rivals", ROOT / "tests/cli/rivals_stubs"
PACKAGES = {"pose2sim": "Pose2Sim", "momentum": "pymomentum"}
SCENARIO = """scenario: rivals
question: Do the adapters run?
task: capture
clips: ['builtin:clap']
duration_s: 0.4
trials: 1
methods:
  - {{name: numpy, exec: [python3, {examples}/outside-methods/capture_triangulation_numpy.py], options: {{cutoff_hz: 0}}}}
{methods}metrics: [mpjpe_mm]
"""


class Rivals(EtudeCase):
    def scenario(self, names, *before):
        command = ", ".join(map(str, ("python3", *before)))
        methods = "".join(f"  - {{name: {name}, exec: [{command}, {RIVALS}/capture_{name}.py], files: [{ROOT}/examples, {STUBS}]}}\n"
                          for name in names)
        return self.write("rivals.yaml", SCENARIO.format(examples=ROOT / "examples", methods=methods))

    def mpjpe_mm(self, names, *before):
        rows = self.run_suite(self.scenario(names, *before))
        for row in rows:
            self.assertEqual((row["status"], row["reason"]), ("ok", None), row)
        return {row["method"]: row["mpjpe_mm"] for row in rows}

    @heavy
    def test_every_call_of_the_adapters_is_documented(self):
        errors = self.mpjpe_mm(PACKAGES, STUBS / "with_stubs.py")
        # The triangulation is the same; Pose2Sim's hands, head and spine are placed in another way.
        self.assertLess(abs(errors["pose2sim"] - errors["numpy"]), 0.25 * errors["numpy"], errors)
        self.assertLess(errors["momentum"], 1.1 * errors["numpy"], "bones keep their lengths")

    def test_the_packages_themselves(self):
        there = [name for name, package in PACKAGES.items() if importlib.util.find_spec(package)]
        if not there:
            self.skipTest("neither Pose2Sim nor pymomentum is installed: pip install pose2sim pymomentum-cpu")
        errors = self.mpjpe_mm(there)
        for name in there:
            self.assertLess(errors[name], 2 * errors["numpy"], errors)

    @heavy
    def test_without_the_package_the_method_says_what_to_install(self):
        names = [name for name, package in PACKAGES.items() if not importlib.util.find_spec(package)]
        for row in self.run_suite(self.scenario(names), code=1 if names else 0):
            if row["method"] in names:
                self.assertEqual(row["status"], "unsolved")
                self.assertIn(" is not installed (No module named", row["reason"])

    @heavy
    def test_the_page_runs_the_shipped_scenario(self):
        page = (RIVALS / "README.md").read_text()
        self.assertIn("examples/rivals/rivals.yaml", page)
        scenario = re.sub(r"exec: \[VENV/bin/python3", "exec: [python3", (RIVALS / "rivals.yaml").read_text()).replace(", VENV]", "]")
        self.ends(0, "run", self.write("shipped.yaml", scenario.replace("examples", str(ROOT / "examples"))), "--dry-run")


if __name__ == "__main__":
    unittest.main()

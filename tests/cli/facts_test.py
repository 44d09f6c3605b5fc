"""--json: every command that tells facts tells them to programs, too, by docs/schemas/facts.schema.json."""
import json
import pathlib
import re
import sys
import unittest

from etude_case import IK, EtudeCase

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "support"))
from json_schema import complaints, load_schema  # noqa: E402

SCHEMA = load_schema("facts.schema.json")
COMMANDS = [name for name, entry in SCHEMA["$defs"].items() if "command" in entry.get("properties", {})]
VERSION = re.search(r"project\(etude VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


class Facts(EtudeCase):
    def test_of_every_command_fit_the_schema(self):
        self.scenario, run = self.run_once(IK)
        other, baseline = self.folder / "other", self.folder / "baseline.json"
        self.run_suite(self.scenario, "--seed", 2, out=other)
        self.assertEqual(self.etude("gate", run, "--baseline", baseline, "--update").returncode, 0)
        first = json.loads(baseline.read_text())
        moved = next(line for line in first["values"] if line["metric"] == "position_error_cm")
        moved["values"] = [value + 1 for value in moved["values"]]
        baseline.write_text(json.dumps(first))
        cell = "ik/joint_noise_deg=2/000/fixed"
        calls = {
            "check-method": ["--task", "ik", "--no-fence", "--", "python3", ROOT / "examples/outside-methods/ik_dls.py"],
            "cite": [run],
            "clip grades": ["builtin:clap", "builtin:sway"],
            "clip map": ["builtin:clap"],
            "compare": [run, run],
            "gate": [run, "--baseline", baseline],
            "list clips": [],
            "list methods": [],
            "list scenarios": [ROOT / "scenarios" / "quick"],
            "replay": [run, "--cell", cell, "--baseline", baseline],
            "run --dry-run": [self.scenario],
            "verify": [run, "--sample", 2],
        }
        self.assertEqual(sorted(calls), sorted(COMMANDS))
        told = {}
        for command, arguments in calls.items():
            with self.subTest(command):
                done = self.etude(*command.split(), "--json", *arguments)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(done.stdout.count("\n"), 1)
                told[command] = facts = json.loads(done.stdout)
                self.assertEqual(complaints(facts, {**SCHEMA, "$ref": f"#/$defs/{command}"}), [])
                self.assertEqual((facts["command"], facts["etude"]), (command, VERSION))
                self.assertNotEqual(complaints({**facts, "more": 1}, {**SCHEMA, "$ref": f"#/$defs/{command}"}), [])
        self.assertEqual([move["metric"] for move in told["gate"]["moves"]], ["position_error_cm"])
        now, = [now for then, now in [told["replay"]["cells"][0]["baseline"]["position_error_cm"]] if then == now + 1]
        self.assertGreaterEqual(now, 0)
        self.assertEqual(told["run --dry-run"]["scenarios"][0]["worlds"], 4)
        self.assertEqual(len(told["clip grades"]["similarities"]), 1)

    def test_are_told_by_no_command_without_a_schema(self):
        pages, waiting = {}, [()]
        while waiting:
            words = waiting.pop()
            pages[words] = text = self.etude(*words, "--help").stdout
            listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
            waiting += [(*words, name) for name in re.findall(r"^  (\S+)", listed[1], re.M)] if listed else []
        with_facts = sorted(" ".join(words) for words, text in pages.items() if "facts.schema.json" in text)
        self.assertEqual(with_facts, sorted(name.removesuffix(" --dry-run") for name in COMMANDS))


if __name__ == "__main__":
    unittest.main()

"""Tests --json: every command with findings also prints them as JSON that fits docs/schemas/facts.schema.json."""
import json
import pathlib
import re
import unittest

from etude_case import IK, EtudeCase, commands_in, load_schema

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUTSIDE = ROOT / "examples" / "outside-methods" / "ik_dls.py"
OTHER_TESTS = [test.read_text() for test in pathlib.Path(__file__).parent.glob("*_test.py")]
COMMANDS = [name for name, entry in load_schema("facts.schema.json")["$defs"].items()
            if "command" in entry.get("properties", {})]
VERSION = re.search(r"project\(etude VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


class Facts(EtudeCase):
    def test_of_every_command_fit_the_schema(self):
        self.scenario, run = self.run_once(IK)
        other, baseline = self.folder / "other", self.folder / "baseline.json"
        self.run_suite(self.scenario, "--seed", 2, out=other)
        self.ends(0, "gate", run, "--baseline", baseline, "--update")
        first = json.loads(baseline.read_text())
        moved = next(line for line in first["values"] if line["metric"] == "position_error_cm")
        moved["values"] = [value + 1 for value in moved["values"]]
        baseline.write_text(json.dumps(first))  # so the seal no longer fits
        cell = "ik/joint_noise_deg=2/000/fixed"
        calls = {
            "check-method": ["--task", "ik", "--no-fence", "--json", "--", "python3", OUTSIDE],
            "cite": [run, "--address", "https://example.org/etude"],
            "clip convert": ["builtin:clap", self.folder / "clap.bvh"],
            "clip grades": ["builtin:clap", "builtin:sway"],
            "clip map": ["builtin:clap"],
            "compare": [run, run],
            "gate": [run, "--baseline", baseline, "--unsealed"],
            "list clips": [],
            "list methods": [],
            "list scenarios": [ROOT / "scenarios" / "quick"],
            "replay": [run, "--cell", cell, "--baseline", baseline, "--unsealed"],
            "run": [self.scenario, "-o", self.folder / "told"],
            "run --dry-run": [self.scenario, "--shard", "1/4"],
            "verify": [run, "--sample", 2],
        }
        elsewhere = {name for name in COMMANDS if any(f'facts("{name}"' in test for test in OTHER_TESTS)}
        self.assertEqual(calls.keys() | elsewhere, set(COMMANDS))
        told = {command: self.facts(command, *arguments) for command, arguments in calls.items()}
        self.assertEqual({facts["etude"] for facts in told.values()}, {VERSION})
        self.assertEqual([told[command]["command"] for command in calls], list(calls))
        self.assertEqual([move["metric"] for move in told["gate"]["moves"]], ["position_error_cm"])
        now, = [now for then, now in [told["replay"]["cells"][0]["baseline"]["position_error_cm"]] if then == now + 1]
        self.assertGreaterEqual(now, 0)
        self.assertEqual(told["run --dry-run"]["scenarios"][0]["worlds"], 4)
        self.assertEqual((told["run --dry-run"]["shard"], told["run --dry-run"]["cells"]), ("1/4", 4))
        self.assertEqual((told["run"]["cells"], told["run"]["without_answer"]), (16, []))
        self.assertEqual(told["run"]["failures"], [])
        self.assertEqual(told["run"]["cells_ok"], (self.folder / "told/cells.jsonl").read_text().count('"status":"ok"'))
        self.assertEqual(told["run"]["output"], str(self.folder / "told"))
        self.assertEqual(told["cite"]["address"], "https://example.org/etude")
        self.assertEqual(len(told["clip grades"]["similarities"]), 1)

    def test_are_told_by_no_command_without_a_schema(self):
        pages, waiting = {}, [()]
        while waiting:
            words = waiting.pop()
            pages[words] = text = self.etude(*words, "--help").stdout
            waiting += [(*words, name) for name in commands_in(text)]
        own = {"bridge": "bridge-summary", "clip info": "clip-info", "list metrics": "metrics"}
        schemas = own | {name.removesuffix(" --dry-run"): "facts" for name in COMMANDS}
        named = {" ".join(words): re.search(r"--json.*\n?.*?docs/schemas/([\w-]+)\.schema\.json", text)
                 for words, text in pages.items() if re.search(r"^  --json", text, re.M)}
        self.assertEqual({name: found and found[1] for name, found in named.items()}, schemas)
        for command, schema in own.items():
            self.assertEqual(load_schema(f"{schema}.schema.json")["properties"]["command"], {"const": command})
        listed = json.loads(self.etude("list", "metrics", "--json").stdout)
        self.assertEqual((list(listed)[:2], listed["command"]), (["command", "etude"], "list metrics"))


if __name__ == "__main__":
    unittest.main()

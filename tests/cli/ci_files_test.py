"""The workflow files of docs/ci: they are YAML, and what they call is there."""
import pathlib
import re
import unittest

import yaml
from etude_case import EtudeCase

ROOT = pathlib.Path(__file__).parents[2]
CI = ROOT / "docs" / "ci"


def scripts_in(node):
    """Every shell script of a workflow: GitHub's `run`, GitLab's `…script`."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key == "run" and isinstance(value, str):
                yield value
            elif key in ("script", "before_script", "after_script"):
                yield from value
            else:
                yield from scripts_in(value)
    elif isinstance(node, list):
        for value in node:
            yield from scripts_in(value)


def settings_in(node):
    """SUITE and BASELINE, wherever a workflow sets them."""
    found = {}
    if isinstance(node, dict):
        for key, value in node.items():
            found.update({key: value} if key in ("SUITE", "BASELINE") else settings_in(value))
    return found


class CiFiles(EtudeCase):
    def complaints(self, text):
        """What is wrong with a workflow, and how many calls of etude were checked."""
        workflow = yaml.safe_load(text)
        found, calls = [], 0
        known = self.etude("--help").stdout
        script = "\n".join(scripts_in(workflow)).replace("\\\n", " ")
        for call in re.findall(r"build/release/etude ([^;&|\n]*)", script):
            calls += 1
            command, *words = call.split()
            if not re.search(rf"^  {re.escape(command)} ", known, re.M):
                found.append(f"no command '{command}'")
                continue
            help_text = self.etude(command, "--help").stdout
            found += [f"{command} knows no '{word}'" for word in words
                      if word.startswith("-") and not re.search(rf"^  (-\w,)?{re.escape(word)}\b|^  {re.escape(word)}[ ,]",
                                                                help_text, re.M)]
        for path in re.findall(r"(?<![\w/.])scripts/[\w/-]+", script) + list(settings_in(workflow).values()):
            if not (ROOT / path).exists():
                found.append(f"no such file: {path}")
        for preset in re.findall(r"--preset (\S+)", script):
            if f'"name": "{preset}"' not in (ROOT / "CMakePresets.json").read_text():
                found.append(f"no preset '{preset}'")
        return found, calls

    def test_call_what_is_there(self):
        files = sorted(CI.glob("*.yml"))
        self.assertEqual([path.name for path in files], ["etude-gate.yml", "gitlab-ci.yml"])
        for path in files:
            with self.subTest(path.name):
                text = path.read_text()
                found, calls = self.complaints(text)
                self.assertEqual(found, [])
                self.assertGreaterEqual(calls, 3)
                self.assertEqual(sorted(settings_in(yaml.safe_load(text))), ["BASELINE", "SUITE"])
                for shown in "report/gate.md", "report/gate.xml":
                    self.assertIn(shown, text)

    def test_are_found_wrong_when_they_are(self):
        text = (CI / "etude-gate.yml").read_text()
        for old, new, complaint in [("etude gate out/ci", "etude judge out/ci", "no command 'judge'"),
                                    ("--baseline \"$B", "--base \"$B", "gate knows no '--base'"),
                                    ("-o out/ci", "-O out/ci", "run knows no '-O'"),
                                    ("scripts/setup", "scripts/install", "no such file: scripts/install"),
                                    ("baselines/quick.json", "baselines/slow.json", "no such file: scenarios/baselines/"),
                                    ("preset release", "preset fast", "no preset 'fast'")]:
            with self.subTest(complaint):
                self.assertIn(old, text)
                found, _ = self.complaints(text.replace(old, new))
                self.assertTrue(any(complaint in one for one in found), found)
        with self.assertRaises(yaml.YAMLError):
            self.complaints(text.replace("jobs:", "jobs: ["))


if __name__ == "__main__":
    unittest.main()

"""Tests `etude gate` and `etude compare` as a CI server and a reviewer use them."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

from etude_case import ETUDE, EtudeCase, heavy, ik_scenario
from json_schema import complaints, load_schema

SCENARIO = ik_scenario(trials=12, question="Does the gate see it?", weights="fixed-tuned")
WORSE = SCENARIO.replace("weights: fixed-tuned", "weights: fixed")


EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples/outside-methods"


class Gate(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Makes a run, its baseline and a worse run once; tests copy them."""
        cls.shared = cls.shared_folder()
        for name, text in ("run", SCENARIO), ("worse", WORSE):
            (cls.shared / "ik.yaml").write_text(text)
            made = cls.etude("run", cls.shared / "ik.yaml", "-o", cls.shared / name)
            assert made.returncode == 0, made.stderr
        made = cls.etude("gate", cls.shared / "run", "--baseline", cls.shared / "ik.json", "--update")
        assert made.returncode == 0, made.stderr

    def setUp(self):
        super().setUp()
        self.baseline = self.folder / "baselines" / "ik.json"
        self.now = self.folder / "now"

    def gate(self, folder, *arguments, expect):
        result = self.etude("gate", folder, *arguments)
        self.assertEqual(result.returncode, expect, result.stdout + result.stderr)
        if expect == 2:
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result.stdout + result.stderr

    def make_baseline(self, text=None):
        """Makes a run in `self.out` and its baseline, of SCENARIO or another text."""
        if text:
            self.run_suite(self.write("ik.yaml", text))
            self.gate(self.out, "--baseline", self.baseline, "--update", expect=0)
            return
        shutil.copytree(self.shared / "run", self.out)
        self.baseline.parent.mkdir()
        shutil.copy(self.shared / "ik.json", self.baseline)

    def be_worse(self):
        shutil.copytree(self.shared / "worse", self.now)

    def run_now(self, text, *arguments):
        return self.run_suite(self.write("ik.yaml", text), *arguments, out=self.now)

    def test_a_rerun_passes_to_the_digit(self):
        exact = SCENARIO + "gate: {rule: exact}\n"
        self.make_baseline(exact)
        self.run_now(exact, "--jobs", 1)
        self.assertIn("Gate: pass", self.gate(self.now, "--baseline", self.baseline, expect=0))
        self.assertNotIn("changed", (self.now / "report" / "gate.md").read_text())

    def test_a_regression_fails_and_is_shown_to_people_and_to_ci(self):
        self.make_baseline()
        self.be_worse()
        text = self.gate(self.now, "--baseline", self.baseline, expect=1)
        self.assertRegex(text, r"worse +ik joint_noise_deg=2 +fixed")
        self.assertIn("ik, fixed", text)  # this method's settings changed
        self.assertIn("**worse**", (self.now / "report" / "gate.md").read_text())
        suites = xml.etree.ElementTree.parse(self.now / "report" / "gate.xml").getroot()
        failures = [case.get("name") for case in suites.iter("testcase") if case.find("failure") is not None]
        self.assertEqual(len(failures), int(suites.get("failures")))
        self.assertTrue(failures and all(", fixed: " in name for name in failures), failures)
        # A gate that fails leaves no earlier verdict behind.
        self.ends(2, "gate", self.now, "--baseline", self.folder / "missing.json")
        self.assertEqual([path.name for path in (self.now / "report").iterdir()], [])

    def test_one_digit_of_one_cell_fails_the_exact_rule_only(self):
        for rule, code in ("exact", 1), ("threshold", 0):
            with self.subTest(rule=rule):
                run, baseline = self.folder / rule, self.folder / f"{rule}.json"
                self.run_suite(self.write("ik.yaml", SCENARIO + f"gate: {{rule: {rule}}}\n"), out=run)
                self.gate(run, "--baseline", baseline, "--update", expect=0)
                text = baseline.read_text()
                value = re.search(r'"metric":"position_error_cm","values":\[([^,]+),', text)
                other = repr(float(value.group(1)) * (1 + 1e-14))
                baseline.write_text(text[:value.start(1)] + other + text[value.end(1):])
                self.assertIn("1 of 12", self.gate(run, "--baseline", baseline, "--unsealed", expect=code))

    def test_few_worlds_that_are_far_worse_fail_and_are_named_with_their_replay_command(self):
        self.make_baseline()
        baseline = json.loads(self.baseline.read_text())
        line = next(line for line in baseline["values"] if line["metric"] == "position_error_cm")
        whole = list(line["values"])
        for far, code in (3, 0), (4, 1):
            line["values"] = [value - 5 if trial < far else value for trial, value in enumerate(whole)]
            self.baseline.write_text(json.dumps(baseline))
            text = self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=code)
            self.assertIn(f"{far} far worse", text)
            self.assertIn("too few to fail" if far == 3 else "worse in 4 worlds", text)
            self.assertNotIn("not judged", text)
        commands = re.findall(r"etude replay (\S+) --cell (\S+)", text)
        self.assertEqual(commands, [(str(self.out), f"ik/joint_noise_deg=2/{trial:03}/fixed") for trial in range(4)])
        self.assertIn(commands[0][1], (self.out / "report" / "gate.md").read_text())
        self.assertIn(commands[0][1], (self.out / "report" / "gate.xml").read_text())
        folder, cell = commands[0]
        self.assertIn(f"--cell {cell} --baseline {self.baseline}", text)
        replayed = self.ends(0, "replay", folder, "--cell", cell, "--baseline", self.baseline, "--unsealed")
        self.assertIn(f"  {line['metric']}: {line['values'][0]} in the baseline, {whole[0]} now\n", replayed.stdout)
        self.assertIn(" in the baseline, and now\n", replayed.stdout)
        # JSON names the same worlds.
        facts = json.loads(self.gate(self.out, "--baseline", self.baseline, "--unsealed", "--json", expect=1)
                           .splitlines()[0])
        schema = load_schema("facts.schema.json") | {"$ref": "#/$defs/gate"}
        self.assertEqual(complaints(facts, schema), [])
        self.assertEqual([world["cell"] for world in facts["far_worse_worlds"]], [cell for _, cell in commands])
        for trial, world in enumerate(facts["far_worse_worlds"]):
            self.assertEqual((world["before"], world["after"]), (line["values"][trial], whole[trial]))
            self.assertEqual((world["metric"], world["fails"]), (line["metric"], True))
            self.assertIn(world["replay"] + "\n", text)

    def test_a_baseline_or_run_of_another_version_is_told(self):
        self.make_baseline()
        self.assertNotIn("Versions of Etude differ", self.gate(self.out, "--baseline", self.baseline, expect=0))
        self.assertNotIn("Versions of Etude differ", self.etude("compare", self.out, self.out).stdout)
        text = self.baseline.read_text()
        self.baseline.write_text(re.sub('"etude":"[^"]+"', '"etude":"0.3.9"', text, count=1))
        self.assertIn("Versions of Etude differ: the baseline was made by 0.3.9, the run by ",
                      self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=0))
        told = self.gate(self.out, "--baseline", self.baseline, "--unsealed", "--json", expect=0)
        self.assertEqual(json.loads(told.splitlines()[0])["baseline_made_by"], "0.3.9")
        shutil.copytree(self.out, self.now)
        manifest = self.now / "manifest.json"
        manifest.write_text(re.sub('"etude": ?"[^"]+"', '"etude":"0.3.9"', manifest.read_text(), count=1))
        said = self.etude("compare", self.now, self.out, "--unsealed")
        self.assertIn("Versions of Etude differ: A was made by 0.3.9, B by ", said.stdout, said.stderr)
        facts = json.loads(self.etude("compare", self.now, self.out, "--unsealed", "--json").stdout)
        self.assertEqual(facts["a_made_by"], "0.3.9")

    def test_far_worse_worlds_of_a_tail_rule_that_is_off_are_named_as_not_judged(self):
        self.make_baseline(SCENARIO + "gate: {tail: {worlds: 0, lost: 0}}\n")
        baseline = json.loads(self.baseline.read_text())
        line = next(line for line in baseline["values"] if line["metric"] == "position_error_cm")
        line["values"][:4] = [value - 5 for value in line["values"][:4]]
        self.baseline.write_text(json.dumps(baseline))
        text = self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=0)
        self.assertIn("4 far worse", text)
        self.assertIn("not judged, because the scenario turned off the tail rule:\n", text)
        self.assertNotIn("too few to fail", text + (self.out / "report" / "gate.md").read_text())

    def test_an_update_shows_what_moved_and_is_the_new_standard(self):
        self.make_baseline()
        before = self.baseline.read_text().splitlines()
        self.be_worse()
        text = self.gate(self.now, "--baseline", self.baseline, "--update", expect=0)
        self.assertRegex(text, r"worse +ik joint_noise_deg=2 +fixed")
        after = self.baseline.read_text().splitlines()
        self.assertEqual(len(before), len(after))
        moved = [line for old, line in zip(before, after) if old != line]
        self.assertTrue(all('"fixed"' in line for line in moved if not line.startswith('"seal"')), moved)
        self.gate(self.now, "--baseline", self.baseline, expect=0)

    def test_a_baseline_that_was_edited_is_refused_by_its_seal(self):
        """Before baselines had seals, each of these edits passed as "4 better, 8 same"."""
        self.make_baseline()
        whole = self.baseline.read_text()
        self.assertNotIn("unsealed", self.gate(self.out, "--baseline", self.baseline, expect=0))
        number = re.search(r'"metric":"position_error_cm","values":\[([^,]+),', whole)
        for edited in (whole[:number.start(1)] + "99.5" + whole[number.end(1):], whole.replace('"cells":"o', '"cells":"u', 1)):
            self.assertNotEqual(edited, whole)
            self.baseline.write_text(edited)
            told = self.gate(self.out, "--baseline", self.baseline, expect=2)
            self.assertIn(f"{self.baseline}: the seal does not match, so this baseline was changed after gate --update wrote it", told)
            told = self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=0)
            self.assertIn("etude: read unsealed: ", told)
        # A baseline without its seal is refused. A baseline of an older schema has no seal, and is read only with
        # --unsealed; --update gives it a seal.
        self.baseline.write_text(re.sub(r',\n"seal":"\w+"', "", whole))
        self.assertIn("a baseline of schema 2 lacks its 'seal'", self.gate(self.out, "--baseline", self.baseline, expect=2))
        self.baseline.write_text(re.sub(r',\n"seal":"\w+"', "", whole).replace('"schema":2', '"schema":1'))
        self.assertIn("an older version of etude wrote this baseline without a seal", self.gate(self.out, "--baseline", self.baseline, expect=2))
        self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=0)
        self.gate(self.out, "--baseline", self.baseline, "--update", expect=0)
        self.assertEqual(self.baseline.read_text(), whole)
        # Another JSON layout is the same baseline.
        self.baseline.write_text(json.dumps(json.loads(whole), indent=1))
        self.assertNotIn("unsealed", self.gate(self.out, "--baseline", self.baseline, expect=0))

    def test_two_updates_at_once_leave_a_whole_baseline(self):
        self.make_baseline()
        whole = self.baseline.read_bytes()
        updates = [subprocess.Popen([ETUDE, "gate", self.out, "--baseline", self.baseline, "--update"],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for _ in range(4)]
        for update in updates:
            self.assertEqual((update.communicate()[1], update.returncode), ("", 0))
        self.assertEqual(self.baseline.read_bytes(), whole)
        self.assertEqual([path.name for path in self.baseline.parent.iterdir()], ["ik.json"])

    def run_program(self, program):
        """Runs `program` beside a built-in method; returns the exit code and the run's folder."""
        own = f"  - {{name: own, exec: [python3, {self.write('own.py', program)}]}}\n"
        return self.etude("run", self.write("own.yaml", SCENARIO + own), "-o", self.now)

    @heavy
    def test_a_method_without_an_answer_fails_and_makes_no_baseline(self):
        ran = self.run_program("import etude\n\n@etude.method(task='ik')\ndef own(problem):\n"
                               "    raise ValueError('math domain error')\n\netude.serve(own)\n")
        self.assertEqual(ran.returncode, 1, ran.stderr)
        self.assertIn("24 × failed: ended with exit code 1; its last words: 'ValueError", ran.stdout)
        text = self.gate(self.now, expect=1)
        self.assertIn("ik: none of the 24 cells of own has an answer; the first cell is ik/joint_noise_deg=2/000/own; 24 × "
                      "failed: ended with exit code 1; its last words: 'ValueError: math domain error'", text)
        self.assertIn("Gate: regression", text)
        self.assertIn("none of the 24", (self.now / "report" / "gate.md").read_text())
        self.assertIn("none of the 24", (self.now / "report" / "gate.xml").read_text())
        text = self.gate(self.now, "--baseline", self.baseline, "--update", expect=1)
        self.assertIn("No baseline was written. No later run could be worse", text)
        self.assertFalse(self.baseline.exists())

    def test_a_method_that_answers_no_answer_everywhere_has_none(self):
        ran = self.run_program(
            "import json, sys\n\nsaid = {'hello': {'type': 'hello', 'protocol': 1, 'name': 'x', 'version': '1'},\n"
            "        'setting': {'type': 'ready'}, 'problem': {'type': 'no_answer', 'reason': 'no way'}}\n"
            "for line in sys.stdin:\n    message = json.loads(line)\n    answer = said.get(message['type'])\n"
            "    if answer:\n        print(json.dumps({**answer, **({'id': message['id']} if 'id' in message else {})}), flush=True)\n")
        self.assertEqual(ran.returncode, 1, ran.stderr)
        self.assertIn("ik: none of the 24 cells of own has an answer", ran.stdout)
        self.assertIn("24 × unsolved: gave no answer: 'no way'", self.gate(self.now, expect=1))
        self.ends(0, "report", self.now, "--no-video")
        self.assertIn("24 without an answer", (self.now / "report" / "summary.md").read_text())

    @heavy
    def test_a_reversed_answer_is_said_first_and_last(self):
        solver = (EXAMPLES / "ik_dls.py").read_text()
        suite = ("scenario: ik\nquestion: Is mine better?\ntask: ik\ntrials: 12\nmax_sweeps: 1000\njoint_noise_deg: 15\n"
                 "stop_at: practical\nmethods:\n  - {name: fixed, solver: ccd, weights: fixed}\n  - {name: own, exec: [python3, %s]}\n")
        degrees = "[math.degrees(a) for a in angles]"
        self.assertIn(degrees, solver)
        worse = solver.replace(degrees, f"[1.5 * d for d in {degrees}]")  # no cell of it is solved
        for text, folder, code in (solver, self.out, 0), (worse, self.now, 1):
            self.ends(code, "run", self.write("own.yaml", suite % self.write("own.py", text)), "-o", folder)
        self.gate(self.out, "--baseline", self.baseline, "--update", expect=0)
        reversed_answer = "ik: own against fixed: better before, now worse"
        lines = self.gate(self.now, "--baseline", self.baseline, expect=1).splitlines()
        self.assertEqual([lines[0], lines[1].strip(), lines[-1]],
                         ["Verdicts that became worse:", reversed_answer, f"Gate: regression: {reversed_answer}"])
        # The control: the unchanged run passes.
        self.assertTrue(self.gate(self.out, "--baseline", self.baseline, expect=0).endswith("Gate: pass\n"))

    def test_a_method_that_never_replies_is_a_fault_of_the_set_up_and_no_regression(self):
        ran = self.run_program("raise ModuleNotFoundError('no numpy here')\n")
        self.assertEqual(ran.returncode, 3, ran.stderr)
        self.assertIn("this machine: method own of ik: in its start: ended with exit code 1; its last words: "
                      "'ModuleNotFoundError: no numpy here'", ran.stderr)
        self.assertFalse(self.now.exists(), "nothing is run")

    @heavy
    def test_a_method_s_own_exception_is_its_failure_and_not_the_machine_s(self):
        solver = (EXAMPLES / "ik_dls.py").read_text()
        self.assertEqual(self.run_program(solver).returncode, 0)
        self.gate(self.now, "--baseline", self.baseline, "--update", expect=0)
        shutil.rmtree(self.now)
        head = "def answer(tree, problem):\n"
        self.assertIn(head, solver)
        raises = solver.replace(head, head + "    if sum(map(ord, str(problem))) % 2:\n        raise ValueError('no')\n")
        self.assertEqual(self.run_program(raises).returncode, 0)
        text = self.gate(self.now, "--baseline", self.baseline, expect=1)
        self.assertNotIn("depends on the machine", text)
        self.assertIn(f"etude replay {self.now} --allow-exec --cell ik/", text)
        facts = json.loads(self.gate(self.now, "--baseline", self.baseline, "--json", expect=1).splitlines()[0])
        failed = [world for world in facts["far_worse_worlds"] if world["status_after"] != "ok"]
        rows = {row["cell"]: row for row in map(json.loads, (self.now / "cells.jsonl").read_text().splitlines())}
        self.assertTrue(failed)
        for world in failed:
            self.assertEqual(world["reason"], rows[world["cell"]]["reason"])

    def test_an_unmet_expectation_fails_without_a_baseline(self):
        self.make_baseline()
        said = self.gate(self.out, expect=0)
        self.assertIn("nothing was compared, because there is no baseline: the scenarios have no expectations", said)
        self.assertIn("Gate: pass, without a baseline (--baseline FILE --update writes a baseline)", said)
        self.run_now(SCENARIO + "expect: [{metric: iterations, of: fixed, at_most: 0}]\n")
        self.assertIn("unmet: ik: ", self.gate(self.now, expect=1))

    def test_a_run_without_all_its_rows_is_incomplete(self):
        self.make_baseline()
        cells = self.out / "cells.jsonl"
        lines = cells.read_text().splitlines(keepends=True)
        cells.write_text("".join(lines[:-3]))
        self.assertIn("was changed after the run wrote it", self.gate(self.out, "--baseline", self.baseline, expect=2))
        text = self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=3)
        self.assertIn("3 of 48 rows are missing", text)
        before = self.baseline.read_text()
        self.gate(self.out, "--baseline", self.baseline, "--update", "--unsealed", expect=3)
        self.assertEqual(self.baseline.read_text(), before)
        cells.write_text("".join(lines))
        self.gate(self.out, "--baseline", self.baseline, expect=0)
        (self.out / "journal.jsonl").write_text("")
        self.assertIn("the run was interrupted or is still running, because the file journal.jsonl exists", self.gate(self.out, "--baseline", self.baseline, expect=3))

    def test_cells_ended_by_the_machine_are_no_regression(self):
        self.make_baseline()
        cells = self.out / "cells.jsonl"
        rows = [json.loads(line) for line in cells.read_text().splitlines()]
        rows[5].update(status="timeout", reason="300 s")
        cells.write_text("".join(json.dumps(row) + "\n" for row in rows))
        text = self.gate(self.out, "--baseline", self.baseline, "--unsealed", expect=3)
        self.assertIn("1 × status timeout, a status that depends on the machine", text)
        self.assertNotIn("worse", text)

    def test_bad_input_is_told_in_one_line(self):
        self.assertIn("no such folder", self.gate(self.folder / "none", expect=2))
        self.make_baseline()
        whole = self.baseline.read_text()
        self.assertIn("does not exist; --update writes this baseline from the run", self.gate(self.out, "--baseline", self.folder / "none.json", expect=2))
        for broken in "", "{}", whole[:len(whole) // 2], whole.replace('"schema":2', '"schema":7'), \
                whole.replace('"seed":1', '"seed":1,"seed":1'), whole.replace('"trials":12', '"trials":null'), \
                re.sub('"cells":"[a-z]+"', '"cells":"' + 12 * "f" + '"', whole), \
                re.sub(r'"values":\[[^,]+,', '"values":[null,', whole, count=1):
            self.baseline.write_text(broken)
            self.assertIn(str(self.baseline), self.gate(self.out, "--baseline", self.baseline, expect=2))
            # A file that is not a baseline is not overwritten.
            self.gate(self.out, "--baseline", self.baseline, "--update", expect=2)
            self.assertEqual(self.baseline.read_text(), broken)
        self.baseline.write_text(whole)
        self.run_now(SCENARIO, "--seed", 2, "--trials", 11)
        text = self.gate(self.now, "--baseline", self.baseline, expect=2)
        self.assertIn("ik: the seed was 1 and is 2; ik: the number of trials was 12 and is 11", text)

    def test_comparing_two_runs_lists_what_only_one_holds(self):
        self.make_baseline()
        self.run_now(SCENARIO.replace("[2, 5]", "[2, 7]"))
        same = self.ends(0, "compare", self.out, self.out)
        self.assertRegex(same.stdout, r"^\d+ comparisons: \d+ same\nAll verdicts are about these worlds only, and not about other worlds.\n$")
        result = self.ends(0, "compare", self.out, self.now)
        self.assertIn("Only in A:\n  ik, joint_noise_deg=5, fixed\n  ik, joint_noise_deg=5, least-squares", result.stdout)
        self.assertIn("Only in B:\n  ik, joint_noise_deg=7, fixed\n", result.stdout)
        self.assertEqual(self.etude("compare", self.out, self.folder / "none").returncode, 2)

    def test_comparing_two_runs_without_a_common_world_is_refused(self):
        self.make_baseline()
        for scenario, seed, why in [(SCENARIO, 2, ": ik: the seed was 1 and is 2"), (SCENARIO.replace("scenario: ik", "scenario: ki"), 1, "")]:
            self.run_now(scenario, "--seed", seed, "--overwrite")
            for more in [], ["--json"]:
                self.refusal("compare", self.out, self.now, *more, says="have no world in common that can be compared" + why)

    @heavy
    def test_the_gate_measures_itself(self):
        repetitions = 200
        result = self.ends(0, "gate", "--self-test", "--repetitions", repetitions)
        print(result.stdout)

        def share(line):
            match = re.search(re.escape(line) + r": +(\d+) of (\d+) ", result.stdout)
            self.assertIsNotNone(match, result.stdout)
            self.assertGreaterEqual(int(match.group(2)), repetitions)
            return int(match.group(1)) / int(match.group(2))

        self.assertEqual(share("reruns with the same seed, rule `exact`"), 0)
        self.assertEqual(share("worse by 4 × the difference that matters"), 1)
        self.assertEqual(share("reruns with the same seed, tail rule"), 0)
        self.assertEqual(share("worse in 5 of 30 worlds by 40 × the difference that matters"), 1)
        self.assertEqual(share("lost in 1 of 30 worlds"), 1)
        self.assertGreaterEqual(share("within-30-deg in place of reference"), 0.8)
        self.assertLessEqual(share("gates between two seeds"), 0.05)
        self.assertGreaterEqual(share("worse by 2 × the difference that matters"), 0.8)


if __name__ == "__main__":
    unittest.main()

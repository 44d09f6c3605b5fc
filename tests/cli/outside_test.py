"""Tests outside methods in a run: a good one is a method like any other; a hostile one gets rows and harms nothing
else."""
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time
import unittest

from etude_case import ETUDE, IK, EtudeCase, heavy

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOSTILE = ROOT / "tests/bench/outside/hostile.py"
BROWSER = ROOT / "tests/bench/outside/in_a_browser.py"
EXAMPLES = ROOT / "examples/outside-methods"

LIMITS = "limits: {time_s: 20, memory_mb: 300}\n"
REASONS = {
    "crashes": ("crashed", "ended with signal 11 (Segmentation fault); its last words: 'about to fall'"),
    "hangs": ("timeout", "took longer than 0.5 s"),
    "prints_garbage": ("bad_output", "wrote something that is not JSON: 'loading model \\x1b[1m100%\\x1b[0m'"),
    "answers_nan": ("bad_output", "its message contains NaN, which is not JSON; allowed: finite numbers"),
    "eats_memory": ("out_of_memory", "held more than 300 MB of memory"),
}


def outside(name, *command, more=""):
    words = ", ".join(f"'{word}'" for word in command)
    return f"  - {{name: {name}, exec: [python3, {words}]{more}}}\n"


def soon(happens, limit_s=30):
    """Waits until `happens` returns true."""
    end = time.monotonic() + limit_s
    while not happens() and time.monotonic() < end:
        time.sleep(0.02)
    return bool(happens())


class OutsideMethods(EtudeCase):
    @heavy
    def test_hostile_methods_become_rows_and_nothing_else_suffers(self):
        good = outside("good", EXAMPLES / "ik_dls.py")
        hostile = "".join(outside(name, HOSTILE, name, more=", time_s: 0.5" if name == "hangs" else "")
                          for name in REASONS)
        alone = self.run_suite(self.write("alone.yaml", IK + good + LIMITS), out=self.folder / "alone")
        among = self.run_suite(self.write("among.yaml", IK + hostile + good + LIMITS), "--jobs", 2, code=1)
        for name, (status, reason) in REASONS.items():
            rows = [row for row in among if row["method"] == name]
            self.assertEqual(len(rows), 8)
            for row in rows:
                self.assertEqual(row["status"], status, row)
                self.assertTrue(row["reason"].startswith(reason), row["reason"])
                self.assertEqual(row["solved_practical"], 0, "a failure stays in the denominator")
                self.assertIsNone(row["position_error_cm"])
        self.assertIn("about to fall", (self.out / "stderr" / "ik~crashes.txt").read_text())
        self.assertEqual([row for row in among if row["method"] not in REASONS], alone)
        self.assertEqual({row["status"] for row in alone if row["method"] == "good"}, {"ok"})

    def test_what_a_method_writes_after_its_answer_fails_the_same_rows_for_any_number_of_workers(self):
        chats, ends = "chats_after_its_answer", "ends_after_its_answer"
        suite = self.write("ik.yaml", IK + "".join(outside(name, HOSTILE, name) for name in (chats, ends)) + LIMITS)
        reasons = {chats: "after its reply: wrote something that is not JSON: 'done'",
                   ends: "after its reply: ended with exit code 0"}
        for jobs in 1, 3:
            rows = self.run_suite(suite, "--jobs", jobs, out=self.folder / str(jobs), code=1)
            for name, reason in reasons.items():
                self.assertEqual([row["reason"] for row in rows if row["method"] == name], [reason] * 8)
        self.assert_same_results(self.folder / "1", self.folder / "3")

    def test_a_method_that_fails_in_some_worlds_is_named_with_its_share(self):
        head = "def answer(tree, problem):\n"
        fails = "    asked = globals()['asked'] = globals().get('asked', 0) + 1\n    if asked % 4 == 2:\n        raise ValueError('no')\n"
        solver = (EXAMPLES / "ik_dls.py").read_text()
        self.assertIn(head, solver)
        program = self.write("fails.py", solver.replace(head, head + fails))
        scenario = self.write("ik.yaml", IK.replace("trials: 4", "trials: 3") + outside("mine", program) + LIMITS)
        told = self.facts("run", scenario, "-o", self.out, "--jobs", 1)
        rows = [json.loads(line) for line in (self.out / "cells.jsonl").read_text().splitlines()]
        failed = [row for row in rows if row["method"] == "mine" and row["status"] != "ok"]
        self.assertTrue(0 < len(failed) < 6, failed)
        self.assertEqual(sum(one["cells"] for one in told["failures"]), len(failed))
        self.assertEqual({(one["scenario"], one["method"], one["of"]) for one in told["failures"]}, {("ik", "mine", 6)})
        self.assertEqual({one["status"] for one in told["failures"]}, {row["status"] for row in failed})
        self.assertIn(told["failures"][0]["reason"].removeprefix("for example: "), {row["reason"] for row in failed})
        said = self.etude("run", scenario, "-o", self.out, "--jobs", 1, "--overwrite").stdout
        first = told["failures"][0]
        self.assertIn(f"\nCells without an answer:\n  {first['status']}: {first['cells']} of 6 cells of mine in ik: "
                      f"{first['reason']}\n", said)
        self.assertNotIn("Methods without an answer", said)

    def test_a_log_of_a_long_first_cell_is_not_silent(self):
        sleeps = self.write("sleeps.py", "import time, etude\n@etude.method(task='ik')\ndef sleeps(problem):\n"
                                         "    time.sleep(5)\n    return problem.start_angles_deg\netude.serve(sleeps)\n")
        one = IK.replace("trials: 4\nsweep: {joint_noise_deg: [2, 5]}", "trials: 1").replace(
            "  - {name: fixed, solver: ccd, weights: fixed}\n  - {name: least-squares, solver: damped-least-squares}\n", "")
        told = self.ends(1, "run", self.write("long.yaml", one + outside("sleeps", sleeps)), "-o", self.out)
        self.assertRegex(told.stderr, r"  0 %  0/1 cells, 0 ok, 0 s\n  0 %  0/1 cells, 0 ok, [1-9] s\n")

    def test_answers_of_the_wrong_shape_say_where(self):
        wrong = {"short": ('{"angles_deg": [1, 2]}', "angles_deg: "), "other": ('{"angle": 3}', "angle")}
        methods = "".join(outside(name, HOSTILE, "is_good", answer) for name, (answer, _) in wrong.items())
        for row in self.run_suite(self.write("wrong.yaml", IK + methods), code=1):
            if row["method"] in wrong:
                self.assertEqual(row["status"], "bad_output")
                self.assertIn(wrong[row["method"]][1], row["reason"])

    @heavy
    def test_a_fence_changes_no_result_and_is_told_of(self):
        suite = self.write("suite.yaml", IK + outside("good", EXAMPLES / "ik_dls.py") + outside("crashes", HOSTILE, "crashes"))
        self.run_suite(suite, "--jobs", 2, code=1)
        open_air = self.folder / "no-fence"
        self.run_suite(suite, "--no-fence", out=open_air, code=1)
        self.assert_same_results(self.out, open_air)
        self.assertRegex(json.loads((self.out / "host.json").read_text())["fence"], r"^(bubblewrap \d|none \()")
        self.assertEqual(json.loads((open_air / "host.json").read_text())["fence"], "none (not asked for)")

    def test_without_bubblewrap_methods_run_in_no_fence_and_that_is_said(self):
        suite = self.write("suite.yaml", IK + f"  - {{name: good, exec: [{sys.executable}, {EXAMPLES / 'ik_dls.py'}]}}\n")
        nothing = self.folder / "bin"
        nothing.mkdir()
        refused = nothing / "bwrap"
        for script, words in ((None, "bubblewrap is not installed"),
                              ("#!/bin/sh\necho bwrap: No permissions to create new namespace >&2\nexit 1\n",
                               "bwrap: No permissions to create new namespace")):
            if script:
                refused.write_text(script)
                refused.chmod(0o755)
                (nothing / "sh").symlink_to("/bin/sh")
            run = subprocess.run([ETUDE, "run", suite, "-o", self.out, "--overwrite"], capture_output=True, text=True,
                                 env=os.environ | {"PATH": str(nothing)})
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn(f"outside methods ran without a sandbox (fence): none ({words})", run.stderr)
            self.assertEqual(json.loads((self.out / "host.json").read_text())["fence"], f"none ({words})")

    @heavy
    def test_programs_that_a_manifest_a_run_or_a_pack_names_need_leave(self):
        mark = self.folder / "started"
        program = self.folder / "method.sh"
        program.write_text(f"#!/bin/sh\necho started >>{mark}\nread hello\n"
                           """echo '{"type":"hello","protocol":1,"name":"n","version":"1"}'\n"""
                           "read setting\necho out of luck >&2\nexit 1\n")
        program.chmod(0o755)
        cell = "ik/joint_noise_deg=2/000/mine"
        self.run_suite(self.write("suite.yaml", IK + f"  - {{name: mine, exec: [{program}, --fast]}}\n"), "--no-fence", code=1)
        self.assertTrue(mark.exists())
        mark.unlink()
        pack = self.folder / "cell.etude"
        self.ends(0, "replay", self.out, "--cell", cell, "--pack", pack)
        for words in (["run", "--from", self.out / "manifest.json", "-o", self.folder / "again"],
                      ["run", "--dry-run", "--from", self.out / "manifest.json"],
                      ["replay", self.out, "--sample", "1"], ["replay", pack]):
            self.refusal(*words, leaves=mark,
                         says=f"a run would start programs, but --allow-exec is missing: {program} --fast (ik/mine)")
        self.ends(0, "replay", pack, "--allow-exec", "--no-fence")
        self.assertTrue(mark.exists())
        self.assertIn("its last words: 'out of luck'", (self.out / "cells.jsonl").read_text())
        self.ends(0, "replay", self.out, "--cell", cell, "--allow-exec", "--no-fence")

    @heavy
    def test_a_model_trained_on_exported_sessions_knows_people_whom_it_never_saw(self):
        example, model = EXAMPLES / "detection_kernel_numpy.py", self.folder / "rival.npz"
        suite = self.write("suite.yaml", "scenario: rivals\nquestion: Right?\ntask: detection\nclips: [builtin:clap, builtin:side_kick]\n"
                           "people: expert\nevents: 10\nseverity: 1\ntwo_faults: 0\nfaults: [wrong_move, skipped]\ntrials: 3\nmethods:\n"
                           + outside("rival", example, model) + "metrics: [roc_auc, f1]\n")
        data = self.folder / "data"
        self.ends(0, "export", suite, "-o", data, "--seed", 2)
        python = ["/usr/bin/python3", example, "train"]
        trained = subprocess.run([*python, data, "-o", model], capture_output=True, text=True)
        self.assertEqual(trained.returncode, 0, trained.stderr)
        self.assertIn("3 sessions, 30 performances", trained.stdout)
        for row in self.run_suite(suite, "--seed", 3):
            self.assertGreater(row["roc_auc"], 0.95, "another move and standing still are easily told")
            self.assertGreater(row["f1"], 0.7)
        nothing = subprocess.run([*python, self.folder, "-o", model], capture_output=True, text=True)
        self.assertEqual(nothing.returncode, 1)
        self.assertIn("right and wrong performances are needed", nothing.stderr)

    def radians(self):
        """Returns the example solver, changed to answer in radians instead of degrees."""
        text = (EXAMPLES / "ik_dls.py").read_text()
        for file in EXAMPLES.glob("*.py"):
            shutil.copy(file, self.folder)
        return self.write("ik_radians.py", text.replace("math.degrees(a) for", "a for"))

    def test_check_method_tells_what_a_method_does_wrong(self):
        for command, code, words in [
                ([EXAMPLES / "ik_dls.py"], 0, "9 of 9 checks passed"),
                ([HOSTILE, "crashes"], 1, "FAILED  gives answers that can be scored: crashed: ended with signal 11"),
                ([self.radians()], 1, "FAILED  solves the problems that a simple method solves: the program solves none of 3 problems; the built-in method damped-least-squares "
                 "solves 3; if its angles are read as radians, they solve 3, so convert the angles to degrees"),
                ([HOSTILE, "answers_twice", json.dumps({"angles_deg": [0] * 29})], 1, "FAILED  answers every question once")]:
            result = self.etude("check-method", "--task", "ik", "--", "python3", *command)
            self.assertEqual(result.returncode, code, result.stdout + result.stderr)
            self.assertIn(words, result.stdout)
        self.ends(2, "check-method", "--task", "ki", "--", "true")
        self.ends(2, "check-method", "--task", "ik", "--", "no-such-program")

    @unittest.skipUnless(shutil.which("node"), "needs Node")
    @heavy
    def test_node_runs_inside_the_fence(self):
        result = self.ends(0, "check-method", "--task", "coach", "--seat", "policy", "--",
                            "node", EXAMPLES / "coach_policy.mjs")
        self.assertIn("9 of 9 checks passed", result.stdout)

    @unittest.skipUnless(shutil.which("node"), "needs Node")
    def test_the_policy_in_javascript_is_the_one_in_python(self):
        dice = random.Random(1)
        asked = [{"type": "hello", "protocol": 1, "options": {}}, {"type": "setting", "setting": {}}]
        for session in range(3):
            asked.append({"type": "begin", "begin": {}, "id": str(session)})
            for number in range(60):
                verdicts = [{"move": dice.choice("abc"), "verdict": dice.choice(["wrong", "wrong", "right"])}
                            for _ in range(dice.randrange(3))]
                asked.append({"type": "step", "id": str(session), "number": number, "step": {"verdicts": verdicts}})
        told = "".join(json.dumps(message) + "\n" for message in asked)
        answers = []
        for program in (["python3", EXAMPLES / "coach_policy.py"], ["node", EXAMPLES / "coach_policy.mjs"]):
            said = subprocess.run(program, input=told, capture_output=True, text=True, check=True,
                                  env={**os.environ, "PYTHONPATH": str(ROOT / "python")}).stdout
            answers.append([json.loads(line) for line in said.splitlines()][1:])  # without the method's name
        self.assertEqual(*answers)
        self.assertEqual({message["answer"]["correct"] for message in answers[0] if "answer" in message}, {True, False})

    @unittest.skipUnless(shutil.which("chromium"), "needs Chromium")
    @heavy
    def test_a_browser_runs_inside_the_fence(self):
        one = IK.replace("trials: 4\nsweep: {joint_noise_deg: [2, 5]}", "trials: 1")
        rows = self.run_suite(self.write("suite.yaml", one + outside("browser", BROWSER, more=f", files: ['{BROWSER.parent}', '{EXAMPLES}', /etc/chromium.d]") +
                                         "limits: {time_s: 60, memory_mb: 4096}\n"))
        found = [row for row in rows if row["method"] == "browser"]
        self.assertEqual([row["status"] for row in found], ["unsolved"], found)
        self.assertLess(found[0]["hidden_angle_change_deg"], 1e-9, "the page answers with the start pose")

    def test_no_process_is_left_behind(self):
        path = self.write("hang.yaml", IK + outside("hangs", HOSTILE, "hangs", "{}", self.folder))
        run = subprocess.Popen([ETUDE, "run", path, "-o", self.out], stderr=subprocess.DEVNULL)
        mark = str(self.folder).encode()

        def marked():
            found = []
            for process in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
                try:
                    words = process.read_bytes()
                except OSError:
                    continue  # the process has just ended
                if b"hostile.py" in words and mark in words:
                    found.append(process)
            return found

        self.assertTrue(soon(marked), "the method was never started")
        run.kill()
        run.wait()
        self.assertTrue(soon(lambda: not marked()), "the method outlived the run")


if __name__ == "__main__":
    unittest.main()

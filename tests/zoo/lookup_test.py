"""Tests a method that brings its own copy of Etude (lookup.py). With plain seeds it finds the worlds and answers the
truth; with secret seeds it finds nothing, in any task and seat. In tracking it also recognises the frames of the
public clip: in open worlds it answers their truth; in secret worlds our own solver is nearer to the truth.
ETUDE_LOOKUP_TASKS selects tasks. Other methods carry problems from condition to condition or from run to run, or get
the truth from a metric."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ETUDE = pathlib.Path(os.environ["ETUDE"])
PYTHON = "/usr/bin/python3"
LOOKUP = pathlib.Path(__file__).with_name("lookup.py")
SEED = "2"
# Seats in which a method's first message does not tell the world. A coach's is the same in every world; a transition's
# request has public clips and a frame, but no measured number.
TOLD_NOTHING_AT_FIRST = ["coach/policy", "coach/learner", "transition"]

# By task and seat: a scenario's keys after its name, and its method's keys.
TASKS = {
    "ik": ("trials: 3\nsweep: {joint_noise_deg: [2, 5]}\n", ""),
    "tracking": ("trials: 2\nclips: ['builtin:boxing']\nduration_s: 0.5\n", ""),
    "transition": ("trials: 2\nclips: ['builtin:*']\n", ""),
    "detection": ("trials: 2\nclips: ['builtin:*']\nevents: 4\nsweep: {noise: [1, 2]}\n", ""),
    "coach/recogniser": ("trials: 1\nsweep: {noise: [1, 2]}\n", ", seat: recogniser"),
    "coach/policy": ("trials: 1\n", ", seat: policy"),
    "coach/learner": ("trials: 1\n", ", seat: learner"),
    "capture": ("trials: 1\nclips: ['builtin:boxing']\nduration_s: 0.1\n", ""),
    "capture/segmenter": ("trials: 1\nclips: ['builtin:boxing']\nduration_s: 0.1\n", ", seat: segmenter"),
}


class Lookup(unittest.TestCase):
    longMessage = True

    def setUp(self):
        if "none" in subprocess.run([ETUDE, "check-method", "--task", "ik", "--", "false"], capture_output=True,
                                    text=True).stdout.splitlines()[0]:
            self.skipTest("no fence here")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lookup-"))
        self.addCleanup(shutil.rmtree, self.folder, True)

    def run_against(self, name, text, *options, den=(), is_refused=False):
        """Runs the scenario `text`, where DEN is an attacker's folder with its files; returns the rows and its
        output."""
        place = self.folder / name
        (place / "den").mkdir(parents=True)
        shutil.copy(LOOKUP, place / "den")
        for file, content in dict(den).items():
            (place / "den" / file).write_text(content)
        with open(place / "den/memory", "wb") as memory:
            memory.truncate(4 * (1 << 15) * os.sysconf("SC_PAGE_SIZE"))  # a sparse file, of which no page is in memory
        (place / "in").mkdir()
        scenario, out = place / "in/lookup.yaml", place / "in/run"
        scenario.write_text(text.replace("DEN", str(place / "den")))
        run = subprocess.run([ETUDE, "run", scenario, "-o", out, "--jobs", "1", *map(str, options)], capture_output=True,
                             text=True, timeout=600, cwd=place)
        self.assertEqual(run.returncode == 2, is_refused, run.stderr)
        if is_refused:
            return [], run.stderr
        said = "".join(log.read_text() for log in sorted((out / "stderr").glob("*")))
        self.assertNotIn("Traceback", said, "an attacker that fell finds nothing")
        return [json.loads(line) for line in (out / "cells.jsonl").read_text().splitlines()], said

    def carrier(self, sweep, noises):
        return (f"scenario: lookup\nquestion: Does it add up?\ntask: ik\ntrials: 3\nposes: {{uniform: 0.5}}\n{sweep}\nmethods:\n"
                f"  - {{name: own, exec: [{PYTHON}, DEN/lookup.py, carry, {noises}]}}\n")

    def run_carrier(self, text):
        """Runs a method in secret worlds that remembers the problems of earlier conditions in pages of the kernel's
        cache. Runs it anew if the kernel has dropped such pages. Returns the rows and what the method said."""
        for attempt in range(5):
            rows, said = self.run_against(f"secret-{attempt}", text, "--seed-file", self.key())
            if "no memory" in said:
                self.skipTest("the kernel does not tell which pages it holds")
            if re.findall(r"remembers (\d) worlds", said) == ["0", "3", "6"]:
                return rows, said
        self.fail(f"the method did not remember all problems: {said}")

    def test_what_one_condition_asked_tells_nothing_of_the_next(self):
        text = self.carrier("sweep: {joint_noise_deg: [2, 3, 4]}", "2, 3, 4")
        later = lambda rows: [row["hidden_angle_error_deg"] for row in rows if row["joint_noise_deg"] != 2]
        # The method remembers all earlier problems, but none helps it.
        rows, said = self.run_carrier(text)
        self.assertNotIn("a world that was met before", said)
        self.assertGreater(min(later(rows)), 0.1)
        # The control: with a plain seed, the conditions share their random numbers, so the remembered problems help.
        rows, said = self.run_against("plain", text)
        self.assertEqual(len(later(rows)), 6)
        self.assertLess(max(later(rows)), 1e-9, said)

    def test_a_key_that_was_used_is_refused_since_two_runs_tell_their_truth_together(self):
        key = self.key()
        rows, said = self.run_against("first", self.carrier("joint_noise_deg: 2", "2"), "--seed-file", key)
        self.assertGreater(min(row["hidden_angle_error_deg"] for row in rows), 0.1)
        notes = {"notes.json": "[" + re.search("^NOTES (.*)$", said, re.M)[1] + "]"}
        text = self.carrier("joint_noise_deg: 3", "2, 3")
        _, refused = self.run_against("second", text, "--seed-file", key, den=notes, is_refused=True)
        self.assertIn("was used before: 'etude run' with 'lookup' wrote into", refused)
        # The control: the attack that the refusal prevents.
        rows, said = self.run_against("asked-for", text, "--seed-file", key, "--reuse-key", den=notes)
        self.assertLess(max(row["hidden_angle_error_deg"] for row in rows), 1e-9, said)

    def test_a_metric_tells_a_method_nothing(self):
        told = f"exec: [{PYTHON}, DEN/lookup.py"
        text = ("scenario: lookup\nquestion: Who tells?\ntask: detection\ntrials: 3\nclips: ['builtin:*']\nevents: 4\n"
                f"methods:\n  - {{name: ours}}\n  - {{name: own, {told}, listen]}}\n"
                f"metrics: [f1, {{name: lives, {told}, tell]}}]\n")
        rows, said = self.run_against("told", text, "--seed-file", self.key())
        self.assertNotIn("a metric told", said)
        self.assertEqual({row["lives"] for row in rows}, {0}, "methods have ended when metrics are asked")
        self.assertLess(max(row["f1"] for row in rows if row["method"] == "own"), 1)

    def release(self, task, *options):
        """Returns the attacker's findings and its rows."""
        keys, method = TASKS[task]
        den = pathlib.Path(tempfile.mkdtemp(prefix="attacker-", dir=self.folder))
        shutil.copy(LOOKUP, den)
        for name in ("etude", "etude_program"):
            shutil.copy(ETUDE.with_name(name), den / name)
        head = f"scenario: lookup\nquestion: Can it be looked up?\ntask: {task.split('/')[0]}\n{keys}methods:\n"
        words = lambda *more: ", ".join(f"'{word}'" for word in (PYTHON, *more))
        own = head
        if task == "tracking":
            own = head.replace("trials: 2", "trials: 60")  # whole takes of the clip
            head += "  - {name: ours}\n"
        (den / "own.txt").write_text(own + f"  - {{name: own, exec: [{words('DEN/lookup.py', 'spy', 'KNOWN')}]{method}}}\n")
        place = pathlib.Path(tempfile.mkdtemp(prefix="lookup-secret-", dir=self.folder))
        scenario, out = place / "lookup.yaml", place / "lookup-run"
        scenario.write_text(head + f"  - {{name: own, exec: [{words(den / 'lookup.py', den, '1', SEED)}]{method}, time_s: 300}}\n")
        run = subprocess.run([ETUDE, "run", scenario, "-o", out, "--jobs", "1", *options], capture_output=True, text=True,
                             timeout=600, cwd=place)
        self.assertLess(run.returncode, 2, run.stderr)
        logs = "".join(log.read_text() for log in (out / "stderr").glob("*")) if (out / "stderr").exists() else ""
        self.assertNotIn("own copy:", logs)
        self.assertNotIn("Traceback", logs, "an attacker that fell finds nothing")
        rows = [json.loads(line) for line in (out / "cells.jsonl").read_text().splitlines()]
        return re.findall("^LOOKUP (.*)$", logs, re.M), rows

    def key(self):
        file = self.folder / "key"
        file.write_bytes(os.urandom(32))
        file.chmod(0o600)
        return file

    def error_of(self, rows, method):
        errors = [row["mpjpe_mm"] for row in rows if row["method"] == method]
        self.assertEqual(len(errors), 2)
        return sum(errors) / len(errors)

    def test_of_a_plain_seed_the_truth_is_found(self):
        found, rows = self.release("ik", "--seed", SEED)
        self.assertEqual(len([one for one in found if one.startswith("the world of p")]), len(rows))
        self.assertIn("another setting in the same process", found)
        self.assertEqual({one for one in found if not one.startswith("the world of p")}, {"another setting in the same process"})
        for row in rows:
            self.assertLess(row["hidden_angle_error_deg"], 1e-9)

    def test_of_a_secret_one_nothing_is_found(self):
        for task in os.environ.get("ETUDE_LOOKUP_TASKS", " ".join(TASKS)).split():
            with self.subTest(task):
                found, rows = self.release(task, "--seed-file", self.key())
                self.assertEqual(found, [])
                self.assertGreater(len(rows), 0)
                for row in rows if task == "ik" else []:
                    self.assertGreater(row["hidden_angle_error_deg"], 1)
                if task == "tracking":
                    self.assertGreater(self.error_of(rows, "own"), self.error_of(rows, "ours"))

    def test_of_a_plain_seed_every_task_is_found(self):
        for task in os.environ.get("ETUDE_LOOKUP_TASKS", " ".join(TASKS)).split():
            if task in TOLD_NOTHING_AT_FIRST:
                continue
            with self.subTest(task):
                found, rows = self.release(task, "--seed", SEED)
                self.assertGreaterEqual(len([one for one in found if one.startswith("the world of p")]), 1)
                if task == "tracking":
                    self.assertLess(self.error_of(rows, "own"), 1e-6)


if __name__ == "__main__":
    unittest.main()

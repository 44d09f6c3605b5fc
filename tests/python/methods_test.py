"""Tests methods in Python: the dataclasses, sending by source, runs, errors, interruption, scoring."""
import importlib.util
import io
import json
import math
import os
import signal
import subprocess
import sys
import time

from python_case import ETUDE, ROOT, SCENARIO, PythonCase, rows_of

import etude
from etude import commands, conversation, messages, problems, shipping

sys.path.insert(0, str(ROOT / "examples/outside-methods"))
OFFSET = 0.0


def nudge(angles):
    return [angle + OFFSET for angle in angles]


def make(kept, scale):
    """Returns methods that use variables of their surroundings."""
    count = 0

    @etude.method(task="ik")
    def appends(problem):
        kept.append(problem)
        return problem.start_angles_deg

    @etude.method(task="ik")
    def counts(problem):
        nonlocal count
        count += 1
        return problem.start_angles_deg

    @etude.method(task="ik")
    def scales(problem):
        return [scale * angle for angle in nudge(problem.start_angles_deg)]

    return appends, counts, scales


class Shapes(PythonCase):
    def test_the_dataclasses_are_those_of_the_schema(self):
        spec = importlib.util.spec_from_file_location("make_problems", ROOT / "python/make_problems.py")
        maker = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(maker)
        self.assertEqual((ROOT / "python/etude/problems.py").read_text(), maker.write_all(),
                         "run python/make_problems.py")
        for task, seats in conversation.TASKS.items():
            for seat in seats:
                spec = conversation.Spec(task, seat, "x", "1", {}, None, [], False)
                self.assertTrue(all(conversation._class_names(spec)[:3]), (task, seat))

    def test_a_message_is_read_and_turned_back_and_passes_over_what_it_does_not_know(self):
        told = {"from": 2, "to": 0, "request_frame": 7, "max_wait_s": 1.5}
        problem = problems.TransitionProblem.of({**told, "later": {"x": 1}})
        self.assertEqual((problem.from_, problem["from"], problem.to_json()), (2, 2, told))
        step = problems.CoachRecogniserStep.of({"pose": [0.0] * 60, "states": "t" * 20, "body_seen": True,
                                                "ask": {"move": None}})
        self.assertIn("ask", step)
        self.assertIsNone(step.ask.move)
        self.assertNotIn("spotted", problems.CoachRecogniserAnswer(asked=0.5).to_json())
        with self.assertRaises(KeyError):
            problem["form"]

    def test_a_decorator_refuses_what_cannot_be_asked(self):
        for arguments, says in (({"task": "kinematics"}, "no task"), ({"task": "ik", "seat": "policy"}, "no seat"),
                                ({"task": "coach", "seat": "policy"}, "no step")):
            with self.assertRaisesRegex(ValueError, says):
                etude.method(**arguments)(lambda problem: None)

    def test_a_conversation(self):
        @etude.method(task="pose-distance", name="zero", version="2")
        class Zero:
            def __init__(self, options):
                self.far = options["far"]

            def answer(self, problem):
                if len(problem.pairs) > 1:
                    raise etude.NoAnswer("too many")
                return problems.PoseDistanceAnswer([self.far], [True])

        pair = {"a": [0] * 60, "b": [0] * 60}
        lines = [{"type": "hello", "protocol": 1, "task": "pose-distance", "options": {"far": 3}},
                 {"type": "setting", "id": "s", "setting": {"joints": [], "parents": []}},
                 {"type": "problem", "id": "p1", "problem": {"pairs": [pair]}},
                 {"type": "problem", "id": "p2", "problem": {"pairs": [pair, pair]}}]
        said = io.StringIO()
        etude.serve(Zero, map(json.dumps, lines), said)
        self.assertEqual([json.loads(line) for line in said.getvalue().splitlines()],
                         [{"type": "hello", "protocol": 1, "name": "zero", "version": "2"}, {"type": "ready"},
                          {"type": "answer", "id": "p1", "answer": {"distances": [3], "alike": [True]}},
                          {"type": "no_answer", "id": "p2", "reason": "too many"}])
        with self.assertRaisesRegex(SystemExit, "is a method of task 'pose-distance'"):
            etude.serve(Zero, [json.dumps({**lines[0], "task": "ik"})], io.StringIO())


class Shipped(PythonCase):
    def test_a_number_that_is_not_finite_is_a_text_in_the_reply(self):
        written = messages.to_json_text({"answer": {"angles_deg": [1.5, math.nan, (-math.inf, 2)], "ok": True, "none": None}})
        self.assertEqual(json.loads(written),
                         {"answer": {"angles_deg": [1.5, "nan", ["-inf", 2]], "ok": True, "none": None}})

    def test_what_cannot_be_sent_is_refused_with_the_reason(self):
        opened = open(os.devnull)
        self.addCleanup(opened.close)

        @etude.method(task="ik")
        def reads(problem):
            return opened.read()

        @etude.method(task="ik")
        def misses(problem):
            return not_there  # noqa: F821

        appends, counts, _ = make([], 1.0)
        lambdas = etude.method(task="ik")(lambda problem: problem.start_angles_deg)
        for method, says in ((reads, "uses 'opened', of type TextIOWrapper"), (appends, "uses 'kept', a list"),
                             (counts, "nonlocal 'count'.*remember it in a class"),
                             (misses, "'not_there', which is not def"),
                             (lambdas, "is a lambda")):
            with self.assertRaisesRegex(ValueError, says):
                shipping.ship(method)
        with self.assertRaisesRegex(TypeError, "write @etude.method"):
            shipping.ship(nudge)

    def test_the_same_method_is_the_same_entry(self):
        first, second, other = (shipping.ship(make([], scale)[2]) for scale in (1.0, 1.0, 0.5))
        self.assertEqual(first, second)
        self.assertNotEqual(first["exec"], other["exec"])


# Code as in a notebook: a __main__ without a file, whose source is in the line cache.
NOTEBOOK = """import etude
import ik_dls as solver

SCALE = 1.0

class Kept:
    def __init__(self, setting, options):
        self.tree = solver.prepare(setting.to_json(), options)

@etude.method(task="ik", name="in-notebook", options={"max_steps": 7})
class Mine(Kept):
    def answer(self, problem):
        return solver.answer(self.tree, problem) if SCALE else None
"""
IN_NOTEBOOK = """import json, linecache, sys
source = sys.argv[1]
linecache.cache["<cell>"] = (len(source), None, source.splitlines(keepends=True), "<cell>")
exec(compile(source, "<cell>", "exec"))
from etude import shipping
print(json.dumps(shipping.ship(Mine)))
"""


@etude.metric("first_m", unit="m", vectors=[
    ({"tracks": [{"name": "solution", "rate_hz": 30, "frames": 1, "joints_m": {"hip_centre": [[2, 0, 0]]}}]}, 3.0)])
def first_m(cell):
    return cell.motion("solution")[-1][0][0] + shift


shift = 1.0


class Metrics(PythonCase):
    def test_a_metric_of_python_is_a_column_with_its_unit_and_its_headline_stays(self):
        run = etude.run({**SCENARIO, "video": {"trials": [0, 1, 2, 3, 4, 5]}}, metrics=[first_m], progress=False,
                        output=self.folder / "run")
        column = run["ik"]["first_m"]
        self.assertEqual((column.unit, column.metric.version, column.metric.direction), ("m", 1, "lower"))
        self.assertEqual(run.summary["scenarios"][0]["headline_metrics"], [*SCENARIO["metrics"], "first_m"])
        table = run["ik"]
        for cell, value in zip(table["cell"], column):
            self.assertEqual(float(run.motion(cell, cell.rpartition("/")[2]).positions_m[-1][0][0]) + 1, value)
        self.assertEqual(len(run.pairs("adaptive", "fixed", "first_m").difference), 12)

    def test_a_vector_that_fails_ends_the_run_before_it_begins(self):
        wrong = etude.metric("first_m", unit="m", vectors=[
            {"cell": {"tracks": [{"name": "solution", "rate_hz": 30, "frames": 1}]}, "expected": 2.5}])(first_m)
        self.addCleanup(etude.metric("first_m", unit="m"), first_m)
        with self.assertRaisesRegex(etude.EtudeError, "expected 2.5, found 1") as told:
            etude.run(SCENARIO, metrics=[wrong], progress=False, output=self.folder / "run")
        self.assertEqual(told.exception.exit_code, 2)

    def test_lists_of_scenarios_keep_theirs_and_what_cannot_be_sent_is_refused(self):
        entry = {"name": "mine", "exec": ["x"]}
        added = '{"name": "mine", "exec": ["x"]}'
        for text, then in (("a: 1\nmetrics: [x, y]\nb: 2\n", f"a: 1\nmetrics: [x, y, {added}]\nb: 2\n"),
                           ("metrics: [x,\n  y]\n", f"metrics: [x,\n  y, {added}]\n"),
                           ("a: 1\n", f"a: 1\nmetrics: [{added}]\n")):
            self.assertEqual(commands._with_metrics("s.yaml", text, [entry]), then)
        with self.assertRaisesRegex(etude.EtudeError, "can only be added to one list"):
            commands._with_metrics("s.yaml", "metrics:\n  - x\n", [entry])
        kept = []

        @etude.metric("sums")
        def sums(cell):
            kept.append(cell)
            return len(kept)

        with self.assertRaisesRegex(ValueError, "metric 'sums' uses 'kept', a list"):
            shipping.ship(sums)
        self.assertNotEqual(shipping.ship(first_m)["exec"][1].split("/")[-3], "methods")
        with self.assertRaisesRegex(TypeError, "is not a metric"):
            etude.run(SCENARIO, metrics=[make([], 1.0)[2]], output=self.folder / "run")


class Runs(PythonCase):
    @classmethod
    def setUpClass(cls):
        """Runs every kind of method once; one of them raises in every cell."""
        import ik_dls
        examples = str(ROOT / "examples/outside-methods")
        path = os.environ["PYTHONPATH"] + ":" + examples
        told = subprocess.run([sys.executable, "-c", IN_NOTEBOOK, NOTEBOOK], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": path})
        assert told.returncode == 0, told.stderr
        ik_dls.DampedLeastSquares.__etude__.options = {"max_steps": 7}
        shown = [examples]
        python = shipping._interpreter(shown)  # the same version: since 3.12, sums of floats differ in the last digits
        program = {"name": "program", "exec": [python, f"{examples}/ik_dls.py"], "files": shown,
                   "options": {"max_steps": 7}}
        cls.shared, cls.seen = cls.shared_folder(), []
        cls.scenario = cls.shared / "ik.yaml"
        cls.scenario.write_text(IN_LINES)
        try:
            etude.run(cls.scenario, output=cls.shared / "out", jobs=1, progress=lambda *at: cls.seen.append(at),
                      methods=[ik_dls.DampedLeastSquares, program, json.loads(told.stdout), make([], 1.0)[2], raises])
        except etude.EtudeError as error:
            cls.error = error
        cls.run_ = cls.error.run

    def test_a_method_of_a_notebook_a_module_and_a_program_give_the_same_rows(self):
        of = {}
        for row in rows_of(self.run_.folder):
            of.setdefault(row["method"], []).append({key: value for key, value in row.items()
                                                     if key not in ("cell", "method")})
        self.assertEqual(of["ik-dls-python"], of["program"])
        self.assertEqual(of["in-notebook"], of["program"])
        self.assertGreater(max(row["iterations"] for row in of["program"]), 0)
        self.assertEqual([row["iterations"] for row in of["scales"]], [None] * 4)

    def test_a_method_without_an_answer_is_an_exception_that_holds_the_run(self):
        self.assertEqual(self.error.exit_code, 1)
        self.assertIn("ValueError: math domain error", self.error.text)
        self.assertEqual(self.run_["ik"].where(method="raises")["status"][0], "failed")

    def test_progress_is_told(self):
        self.assertEqual(self.seen[-1], (24, 24))

    def test_an_error_has_its_place_its_text_and_its_exit_code(self):
        bad = self.folder / "bad.yaml"
        bad.write_text(json.dumps(SCENARIO).replace('"ccd"', '"cdc"', 1))
        with self.assertRaises(etude.EtudeError) as raised:
            etude.run(bad, output=self.folder / "out", progress=False)
        self.assertRegex(raised.exception.place, r"bad\.yaml:1:\d+$")
        self.assertIn("did you mean 'ccd'", raised.exception.text)
        self.assertEqual(raised.exception.exit_code, 2)
        self.assertFalse((self.folder / "out").exists())
        with self.assertRaisesRegex(etude.EtudeError, "overwrite=True replaces it, output= chooses another folder"):
            etude.run(SCENARIO, output=self.run_.folder, progress=False)
        with self.assertRaisesRegex(etude.EtudeError, "the scenario's tasks are ik"):
            etude.run(SCENARIO, methods=[etude.method(task="pose-distance")(_later)], output=self.folder / "out")
        with self.assertRaisesRegex(etude.EtudeError, "is not a program"):
            etude.find_program(self.folder / "none")

    def test_an_interrupt_ends_a_run_resumably(self):
        slow = {**SCENARIO, "trials": 400, "max_sweeps": 1000, "video": {}}
        (self.folder / "slow.yaml").write_text(json.dumps(slow))
        code = "import sys, etude\n" \
               "try: etude.run(sys.argv[1], output=sys.argv[2], jobs=1, progress=False)\n" \
               "except KeyboardInterrupt as said: print('interrupted:', said)"
        child = subprocess.Popen([sys.executable, "-c", code, self.folder / "slow.yaml", self.folder / "slow"],
                                 stdout=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 600
        journal = self.folder / "slow" / "journal.jsonl"
        while not (journal.exists() and journal.read_bytes().count(b"\n") > 3):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        child.send_signal(signal.SIGINT)
        said, _ = child.communicate(timeout=600)
        self.assertIn("interrupted: etude: ", said)
        self.assertIn("--resume", said)
        with self.assertRaisesRegex(etude.EtudeError, "the run did not finish"):
            etude.load(self.folder / "slow")

    def test_methods_go_to_the_end_of_a_scenario_s_list(self):
        text = "task: ik\nmethods:\n  - {name: a}   # one\n  - name: b\n    solver: ccd\n\n# more\ntrials: 2\n"
        entry = {"name": "mine"}
        self.assertEqual(commands._with_methods("x", text, [entry]),
                         text.replace("ccd\n", 'ccd\n  - {"name": "mine"}\n'))
        flush = "methods:\n- {name: a}\n- {name: b}"
        self.assertEqual(commands._with_methods("x", flush, [entry]), flush + '\n- {"name": "mine"}\n')
        for text, says in (("methods: [{name: a}]\n", "with one line per entry"), ("include: x\nmethods:\n  - {}\n", "includes")):
            with self.assertRaisesRegex(etude.EtudeError, says):
                commands._with_methods("x", text, [entry])

    def test_scored_here_in_batches_a_method_has_the_rows_that_a_run_gives_it(self):
        subprocess.run([ETUDE, "export", self.scenario, "-o", self.folder / "data"], check=True, capture_output=True)
        asked = []

        @etude.method(task="ik", name="mine", batch=True)
        def mine(problems):
            asked.append(len(problems))
            return [problem.start_angles_deg for problem in problems]

        with self.assertWarnsRegex(UserWarning, "^0 of 4 cells ok"):
            scored = etude.score(self.folder / "data", mine, self.folder / "scored", alone=True, jobs=1, progress=False)
        self.assertEqual(asked, [2, 2])
        ours, theirs = (each["ik"].where(method=name) for each, name in ((scored, "mine"), (self.run_, "scales")))
        self.assertEqual(list(ours["orientation_error_deg"]), list(theirs["orientation_error_deg"]))

    def test_gate_and_compare_tell_what_the_program_tells(self):
        judged = etude.gate(self.run_)
        self.assertFalse(judged)
        self.assertIn("none of the 4 cells of raises", judged.text)
        self.assertIn(" comparisons: ", etude.compare(self.run_, self.run_))


IN_LINES = """scenario: ik
question: Does it run?
task: ik
trials: 2
sweep: {joint_noise_deg: [5, 15]}
methods:
  - {name: other, solver: damped-least-squares}
metrics: [orientation_error_deg]
"""


@etude.method(task="ik")
def raises(problem):
    raise ValueError("math domain error")


def _later(problem):
    return []


if __name__ == "__main__":
    import unittest
    unittest.main()

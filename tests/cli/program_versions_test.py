"""Tests that a run never mixes answers of two versions of an outside program: the manifest names each program's version
and files, and whatever joins cells of two versions is refused, with both."""
import ctypes
import json
import pathlib
import unittest

from etude_case import HEAVY, IK, EtudeCase, heavy

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOSTILE = ROOT / "tests/bench/outside/hostile.py"
SOLVER = """import etude
from helper import TURN

@etude.method(task="ik", name="our-solver", version="1.0")
def solve(problem):
    return [TURN * angle for angle in problem.start_angles_deg]

etude.serve(solve)
"""
ANSWER = json.dumps({"angles_deg": [0] * 29})
METRIC = """import json, sys
for line in sys.stdin:
    told = json.loads(line)
    reply = {"type": "ready"}
    if told["type"] == "hello":
        reply = {"type": "hello", "protocol": 1, "name": "our-metric", "version": "1"}
    if told["type"] == "problem":
        reply = {"type": "answer", "id": told["id"], "answer": {"value": 1}}
    print(json.dumps(reply), flush=True)
"""


def digest(data):
    xxh3 = ctypes.CDLL("libxxhash.so.0").XXH3_64bits
    xxh3.restype, xxh3.argtypes = ctypes.c_uint64, [ctypes.c_char_p, ctypes.c_size_t]
    return f"{xxh3(data, len(data)):016x}"


class ProgramVersions(EtudeCase):
    def setUp(self):
        super().setUp()
        (self.folder / "ours").mkdir()
        (self.folder / "data").mkdir()
        self.write("ours/solver.py", SOLVER)
        self.write("ours/helper.py", "TURN = 1\n")
        self.write("ours/measure.py", METRIC)
        self.write("data/weights.bin", "1 2 3")
        self.scenario = self.write("suite.yaml", IK + f"""  - {{name: mine, exec: [python3, {self.folder}/ours/solver.py]}}
  - {{name: listed, exec: [python3, {HOSTILE}, is_good, '{ANSWER}'], files: [{HOSTILE.parent}, {self.folder}/data]}}
metrics: [position_error_cm, {{name: rate, exec: [python3, {self.folder}/ours/measure.py]}}]
""")
        self.shards = [self.folder / "1", self.folder / "2"]

    def run_shard(self, number, *more):
        return self.etude("run", self.scenario, "--shard", f"{number}/2", "-o", self.shards[number - 1], "--no-fence", *more)

    def programs(self, folder):
        return json.loads((folder / "manifest.json").read_text())["scenarios"][0]["programs"]

    def run_shards(self):
        for number in (1, 2):
            self.assertEqual(self.run_shard(number).returncode, 0)

    def test_a_change_in_a_package_beside_a_script_is_seen(self):
        for kept in "ours/parts/__pycache__", "ours/pages":
            (self.folder / kept).mkdir(parents=True)
            self.write(f"{kept}/a.txt", "no module")
        self.write("ours/parts/turn.py", "TURN = 1\n")
        self.write("ours/solver.py", SOLVER.replace("from helper", "from parts.turn"))
        self.assertEqual(self.run_shard(1).returncode, 0)
        self.write("ours/pages/a.txt", "changed")
        self.assertEqual(self.run_shard(1, "--resume").returncode, 0)
        self.write("ours/parts/turn.py", "TURN = -1\n")
        said = self.run_shard(1, "--resume")
        self.assertEqual(said.returncode, 2)
        self.assertIn(f"programs.mine.files.{self.folder}/ours/parts/turn.py was ", said.stderr)

    @heavy
    def test_whatever_changes_in_a_program_is_refused_with_both_versions(self):
        self.run_shards()
        self.ends(0, "merge", *self.shards, "-o", self.out)  # the control: nothing has changed
        told = self.programs(self.out)
        self.assertEqual({name: one["greeting"] for name, one in told.items()},
                         {"mine": "our-solver 1.0", "listed": "hostile 1.0", "metric rate": "our-metric 1"})
        for name, text in (("ours/solver.py", SOLVER), ("ours/helper.py", "TURN = 1\n")):
            self.assertEqual(told["mine"]["files"][str(self.folder / name)], digest(text.encode()))
        changes = {
            "ours/solver.py": (SOLVER.replace("1.0", "2.0"), 'programs.mine.greeting was "our-solver 1.0" and is "our-solver 2.0"'),
            "ours/helper.py": ("TURN = -1\n", f"programs.mine.files.{self.folder}/ours/helper.py was "),
            "ours/measure.py": (METRIC.replace('"value": 1', '"value": 2'), "programs.metric rate.files."),
            "data/weights.bin": ("1 2 4", f"programs.listed.files.{self.folder}/data/weights.bin was "),
        }
        for name, (text, words) in list(changes.items())[:None if HEAVY else 1]:
            with self.subTest(name):
                before = (self.folder / name).read_text()
                self.assertNotEqual(before, text)
                self.write(name, text)
                said = self.run_shard(2, "--resume")
                self.assertEqual(said.returncode, 2)
                self.assertIn("this run used other versions of outside programs: ", said.stderr)
                self.assertIn(words, said.stderr)
                self.assertIn("--overwrite replaces the old run", said.stderr)
                self.assertEqual(self.run_shard(2, "--overwrite").returncode, 0)
                mixed = self.folder / "mixed"
                self.refusal("merge", *self.shards, "-o", mixed, leaves=mixed,
                             says=[f"{self.shards[1]}: used different versions of outside programs than the shards before it: ", words])
                again = self.folder / "again"
                self.refusal("run", "--from", self.out / "manifest.json", "-o", again, "--allow-exec", "--no-fence",
                             leaves=again, says=[words, "run its scenario instead"])
                self.assertIn(words, self.ends(1, "verify", self.out, "--allow-exec", "--no-fence").stdout)
                self.write(name, before)
                self.assertEqual(self.run_shard(2, "--overwrite").returncode, 0)
        self.ends(0, "merge", *self.shards, "-o", self.out, "--overwrite")
        self.ends(0, "verify", self.out, "--allow-exec", "--no-fence")
        # Neither a result below a listed folder nor a cache of Python is part of a program.
        (self.folder / "data/out").mkdir()
        self.write("data/out/manifest.json", "{}")
        (self.folder / "data/__pycache__").mkdir()
        self.write("data/__pycache__/a.pyc", "cache")
        self.assertEqual(self.run_shard(2, "--resume").returncode, 0)

    @staticmethod
    def forget_programs(folder):
        """Makes a shard's folder look like one of a version that did not record programs."""
        manifest, journal = folder / "manifest.json", folder / "journal.jsonl"
        told = json.loads(manifest.read_text())
        del told["scenarios"][0]["programs"]
        old = digest(manifest.read_bytes())
        manifest.write_text(json.dumps(told, separators=(",", ":"), ensure_ascii=False) + "\n")
        if not journal.exists():
            return
        lines = journal.read_text().splitlines(keepends=True)
        head = lines[0].replace(old, digest(manifest.read_bytes())).split(',"sum":')[0]
        lines[:2] = [f'{head},"sum":"{digest(head.encode())}"}}\n'] * 2
        journal.write_text("".join(lines))

    @heavy
    def test_a_run_that_recorded_no_programs_is_refused_or_read_with_the_reason(self):
        self.run_shards()
        self.ends(0, "merge", *self.shards, "-o", self.out)
        for folder in (*self.shards, self.out):
            self.forget_programs(folder)
        reason = "the etude of that run did not record the versions"
        self.refusal("merge", *self.shards, "-o", self.folder / "mixed", says=reason, leaves=self.folder / "mixed")
        said = self.run_shard(2, "--resume")
        self.assertEqual(said.returncode, 2)
        self.assertIn(reason, said.stderr)
        self.refusal("run", "--from", self.out / "manifest.json", "-o", self.folder / "again", "--allow-exec",
                     "--no-fence", says=reason, leaves=self.folder / "again")
        read = self.etude("verify", self.out, "--allow-exec", "--no-fence").stdout
        self.assertIn("except the versions of its programs, which the etude of that run did not record", read)
        self.assertNotIn("differs  manifest.json", read)

    @heavy
    def test_every_kind_of_program_is_named(self):
        kinds = {
            "coach": ("task: coach\nclips: ['builtin:clap', 'builtin:sway']\nsession_s: 10\n", ", seat: policy"),
            "detection": ("task: detection\nclips: ['builtin:clap', 'builtin:sway']\nevents: 2\n", ""),
            "pose-distance": ("task: pose-distance\nclips: ['builtin:clap', 'builtin:sway']\npairs: frames\npairs_per_world: 3\n", ""),
            "capture": ("task: capture\nclips: ['builtin:clap']\nduration_s: 0.1\n", ", seat: segmenter"),
        }
        for name, (text, seat) in kinds.items():
            with self.subTest(name):
                file = self.write(f"{name}.yaml", f"scenario: s\nquestion: Which?\n{text}trials: 1\nmethods:\n"
                                                  f"  - {{name: own, exec: [python3, {HOSTILE}, is_good]{seat}}}\n")
                out = self.folder / name
                said = self.etude("run", file, "-o", out)
                self.assertIn(said.returncode, (0, 1), said.stderr)
                told = self.programs(out)["own"]
                self.assertEqual(told["greeting"], "hostile 1.0")
                self.assertEqual(told["files"][str(HOSTILE)], digest(HOSTILE.read_bytes()))

    def test_a_run_without_programs_names_none(self):
        self.run_suite(self.write("ik.yaml", IK))
        self.assertNotIn("programs", (self.out / "manifest.json").read_text())

    @heavy
    def test_a_misspelt_program_is_bad_input_wherever_it_is_named(self):
        for exec_words, words in ((f"[python3, {self.folder}/ours/slover.py]", f"there is no file '{self.folder}/ours/slover.py'; "
                                   f"did you mean '{self.folder}/ours/solver.py'?"),
                                  (f"[{self.folder}/ours/slover]", f"there is no file '{self.folder}/ours/slover'")):
            file = self.write("typo.yaml", IK + f"  - {{name: mine, exec: {exec_words}}}\n")
            column = 1 + f"  - {{name: mine, exec: {exec_words}".index(str(self.folder))
            for more in (["-o", self.out], ["--dry-run"]):
                said = self.refusal("run", file, *more, leaves=self.out, says=[words])
                self.assertIn(f"{file}:9:{column}: ", said)
        said = self.refusal("check-method", "--task", "ik", "--", "python3", self.folder / "ours/slover.py", says="slover.py")
        self.assertNotIn("ours/ours", said)
        # The control: the text after -c, and a file that a program may itself make, are not taken for misspelt scripts.
        self.ends(1, "check-method", "--task", "ik", "--", "python3", "-c", "print(1) # x.py")
        self.assertEqual(self.etude("run", self.scenario, "--dry-run", "--no-fence").returncode, 0)

    @heavy
    def test_a_program_that_cannot_start_ends_a_run_and_a_dry_run_before_anything_runs(self):
        file = self.write("dies.yaml", IK + f"  - {{name: mine, exec: [python3, {self.write('dies.py', 'import no_such_module')}]}}\n")
        for more in (["-o", self.out], ["--dry-run"]):
            said = self.ends(3, "run", file, *more)
            self.assertIn("this machine: method mine of ik: in its start: ended with exit code 1; its last words: "
                          "'ModuleNotFoundError: No module named 'no_such_module''", said.stderr)
            self.assertNotIn("--resume", said.stderr)
            self.assertFalse(self.out.exists())

    def test_a_changed_scenario_is_refused_with_its_first_changed_line_and_the_cure(self):
        first = self.folder / "1"
        self.assertEqual(self.run_shard(1).returncode, 0)
        path = pathlib.Path(self.scenario)
        line = next(i for i, text in enumerate(path.read_text().splitlines(), 1) if "name: mine" in text)
        path.write_text(path.read_text().replace("/ours/solver.py]}", f"/ours/solver.py], files: [{self.folder}/ours]}}"))
        said = self.run_shard(1, "--resume")
        self.assertEqual(said.returncode, 2)
        self.assertRegex(said.stderr, rf'belongs to another run: .*suite\.yaml, line {line}, was "?…".*/ours/solver\.py\]}}" '
                                      rf'and is …".*/ours/solver\.py\], files: \[')
        self.assertIn("; --resume continues only the same run; --overwrite replaces the old run, -o chooses another folder", said.stderr)
        self.assertNotIn("scenarios[0].digest", said.stderr)
        self.assertEqual(self.run_shard(1, "--overwrite").returncode, 0)
        self.assertTrue((first / "host.json").exists())

    @heavy
    def test_a_finished_shard_is_called_finished(self):
        self.assertEqual(self.run_shard(1).returncode, 0)
        said = self.run_shard(1)
        self.assertEqual(said.returncode, 2)
        self.assertIn("already contains the finished shard 1/2; 'etude merge' makes one run of all shards, --overwrite", said.stderr)


if __name__ == "__main__":
    unittest.main()

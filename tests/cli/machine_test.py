"""Tests faults of this machine during a run. They are reported as the machine's faults, never as a method's answer:
the run is refused before the first cell, or a cell is not run. Also tests file systems without locks, and kills of
any process."""
import json
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import unittest

from etude_case import ETUDE, HEAVY, IK, EtudeCase, heavy

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "attack"))
import damage  # noqa: E402
import kills  # noqa: E402

CAPTURE = """scenario: c
question: Does it run?
task: capture
clips: ['builtin:clap']
duration_s: 0.1
trials: 1
methods: [{name: plain}]
"""
# Answers with the frame of the request. At its first answer it makes a file in the folder that it is given, if it can.
METHOD = """import json, os, shutil, sys
for line in sys.stdin:
    message = json.loads(line)
    if message["type"] == "hello":
        reply = {"type": "hello", "protocol": 1, "name": "m", "version": "1"}
    elif message["type"] == "setting":
        reply = {"type": "ready"}
    else:
        reply = {"type": "answer", "id": message["id"],
                 "answer": {"leave_frame": message["problem"]["request_frame"], "enter_frame": 0}}
        for folder in sys.argv[1:]:
            if os.access(folder, os.W_OK) and os.path.isdir(folder):
                shutil.rmtree(folder)
                open(folder, "w").close()
    print(json.dumps(reply), flush=True)
"""
MB = 1 << 20
PYTHON = "/usr/bin/python3"  # a fence shows the system's files
LIBRARIES = [path for name in ("libOSMesa.so.8", "libEGL.so.1")
             if os.path.exists(path := f"/usr/lib/x86_64-linux-gnu/{name}")]  # each of them can draw


def limit(kind, value):
    return lambda: resource.setrlimit(kind, (value, value))


class Machine(EtudeCase):
    def setUp(self):
        super().setUp()
        self.method = self.folder / "method.py"
        self.method.write_text(METHOD)
        self.outside = self.cut_scenario("builtin:clap", "builtin:sway", trials=2, more=(
            f"  - {{name: outside, exec: [{PYTHON}, {self.method}]}}\nsweep: {{wait_s: [1, 3]}}\n"))
        self.capture = self.write("c.yaml", CAPTURE)

    def run_here(self, *arguments, environment=None, before=None, wrapped=(), **more):
        return subprocess.run([*wrapped, ETUDE, "run", *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              env=os.environ | (environment or {}), preexec_fn=before, **more)

    def least_space(self):
        """Returns the least address space in which the program prints its first line, in steps of 4 MB."""
        starts = lambda space: subprocess.run([ETUDE, "--version"], capture_output=True,
                                              preexec_fn=limit(resource.RLIMIT_AS, space)).returncode == 0
        return next(space for space in range(64 * MB, 1024 * MB, 4 * MB) if starts(space))

    @heavy
    def test_whatever_the_address_space_it_ends_with_a_sentence(self):
        least, more, codes = self.least_space(), 0, []
        while 0 not in codes and more < 1024 * MB:
            run = self.run_here(self.outside, "-o", self.out, "--overwrite", before=limit(resource.RLIMIT_AS, least + int(more)))
            codes.append(run.returncode)
            self.assertIn(run.returncode, (0, 3), f"{more / MB:.0f} MB more: {run.stderr}")
            more = more * 1.3 or MB
        self.assertEqual(set(codes), {0, 3})

    @heavy
    def test_a_capture_whose_memory_ends_is_not_run_and_resuming_runs_it(self):
        """Earlier, such cells became rows `out_of_memory`, which --resume kept."""
        whole, codes = self.folder / "whole", []
        self.run_suite(self.capture, out=whole)
        for space in range(256, 512, 8) if HEAVY else (300,):
            shutil.rmtree(self.out, ignore_errors=True)
            ended = self.run_here(self.capture, "-o", self.out, before=limit(resource.RLIMIT_AS, space * MB))
            codes.append(ended.returncode)
            self.assertIn(ended.returncode, (0, 3), ended.stderr)
            if "not run" in ended.stderr:
                self.assertRegex(ended.stderr, "the machine's memory ran out before the worker held the 4096 MB that the scenario allows|could not continue")
                self.assertFalse((self.out / "cells.jsonl").exists())
            self.run_suite(self.capture, "--resume")
            self.assert_same_results(whole, self.out)
        self.assertIn(3, codes)

    @heavy
    def test_the_manifest_is_the_same_in_any_address_space(self):
        """Earlier, the manifest lacked LLVM in a small address space, so --resume reported changed libraries."""
        whole, codes = self.folder / "whole", []
        self.run_suite(self.capture, out=whole)
        for space in range(256, 768, 16) if HEAVY else (320, 640):
            ended = self.run_here(self.capture, "-o", self.out, "--overwrite", before=limit(resource.RLIMIT_AS, space * MB))
            codes.append(ended.returncode)
            if ended.returncode == 0:
                self.assertEqual((self.out / "manifest.json").read_bytes(), (whole / "manifest.json").read_bytes())
        self.assertEqual(set(codes), {0, 3})

    @heavy
    def test_a_small_stack_is_made_larger_or_told(self):
        scenario = self.write("ik.yaml", IK)
        for kib in (64, 256):
            refused = self.run_here(scenario, "-o", self.out, before=limit(resource.RLIMIT_STACK, kib << 10))
            self.assertEqual((refused.returncode, refused.stderr.count("\n")), (3, 1), refused.stderr)
            self.assertIn(f"this machine: the stack size is limited to {kib} KiB; Etude needs at least 1024 KiB (set it with `ulimit -s`)", refused.stderr)
        self.assertFalse(self.out.exists())
        hard = resource.getrlimit(resource.RLIMIT_STACK)[1]
        larger = self.run_here(self.capture, "-o", self.out,
                               before=lambda: resource.setrlimit(resource.RLIMIT_STACK, (64 << 10, hard)))
        self.assertEqual(larger.returncode, 0, larger.stderr)

    @unittest.skipUnless(shutil.which("strace"), "needs strace")
    @heavy
    def test_a_write_that_fails_hangs_nobody_and_is_no_answer(self):
        scenario, whole = self.write("ik.yaml", IK + "limits: {time_s: 30}\n"), self.folder / "whole"
        self.run_suite(scenario, out=whole)
        codes = []
        for number in range(1, 41) if HEAVY else (2, 4):
            ended = self.run_here(scenario, "-o", self.out, "--overwrite", "--jobs", "1", wrapped=[
                "strace", "-f", "-o", "/dev/null", "-e", "trace=write", "-e", f"inject=write:error=EIO:when={number}"])
            codes.append(ended.returncode)
            self.assertIn(ended.returncode, (0, 3), f"write {number}: {ended.stderr}")
            self.run_suite(scenario, "--resume")
            self.assert_same_results(whole, self.out)
        self.assertIn(3, codes)

    @heavy
    def test_what_the_machine_refuses_is_refused_with_its_cause_and_nothing_is_written(self):
        (self.folder / "file").touch()
        (self.folder / "relative").mkdir()
        nobody = {"user": 65534} if os.getuid() == 0 else {}  # root's processes are not limited
        self.folder.chmod(0o777)
        settings = [
            ("TMPDIR is not there", self.outside, "not a folder for temporary files", {"environment": {"TMPDIR": "/nonexistent"}}),
            ("TMPDIR is a file", self.outside, "not a folder for temporary files",
             {"environment": {"TMPDIR": str(self.folder / "file")}}),
            ("TMPDIR cannot be written", self.outside, "TMPDIR=/proc: cannot create temporary files in this folder",
             {"environment": {"TMPDIR": "/proc"}}),
            ("TMPDIR is relative", self.outside, "begins with /", {"environment": {"TMPDIR": "relative"}, "cwd": self.folder}),
            ("TMPDIR is full", self.outside, "File too large", {"before": limit(resource.RLIMIT_FSIZE, 0)}),
            ("few processes", self.outside, "Resource temporarily unavailable",
             {"before": limit(resource.RLIMIT_NPROC, 1), **nobody}),
            ("few files", self.outside, "Too many open files", {"before": limit(resource.RLIMIT_NOFILE, 8)}),
            ("little address space", self.outside, "", {"before": limit(resource.RLIMIT_AS, self.least_space())}),
            ("little address space to draw in", self.capture, "cannot render: ", {"before": limit(resource.RLIMIT_AS, 256 * MB)}),
            ("no renderer", self.capture, "EGL cannot be loaded",
             {"wrapped": ["bwrap", "--dev-bind", "/", "/",
                          *(word for library in LIBRARIES for word in ("--ro-bind", "/dev/null", os.path.realpath(library)))]}),
            ("no OSMesa", self.capture, "OSMesa cannot be loaded",
             {"environment": {"ETUDE_GL": "osmesa"},
              "wrapped": ["bwrap", "--dev-bind", "/", "/", "--ro-bind", "/dev/null", os.path.realpath(LIBRARIES[0])]}),
            ("no program", self.outside, "method outside of scenario t cannot be run: ", {}),
        ]
        for name, scenario, cause, how in settings:
            with self.subTest(name):
                if name == "no program":
                    scenario = self.write("none.yaml", pathlib.Path(scenario).read_text().replace(PYTHON, "no-such"))
                if name == "no OSMesa" and "OSMesa" not in LIBRARIES[0]:
                    continue
                refused = self.run_here(scenario, "-o", self.out, **how)
                self.assertEqual(refused.returncode, 3, refused.stderr)
                self.assertIn(cause, refused.stderr)
                self.assertIn("etude: this machine: ", refused.stderr)
                self.assertNotIn("etude-temporary", refused.stderr)
                self.assertFalse(self.out.exists())
        self.run_suite(self.outside)  # the control

    @heavy
    def test_gl_is_reached_as_it_is_told_and_the_manifest_tells_how(self):
        wrong = self.run_here(self.capture, "-o", self.out, environment={"ETUDE_GL": "glx"})
        self.assertEqual(wrong.returncode, 2)
        self.assertEqual("etude: the environment variable ETUDE_GL: found 'glx'; allowed: osmesa, egl\n", wrong.stderr)
        self.assertFalse(self.out.exists())
        cells, ways = set(), {"libOSMesa": "osmesa", "libEGL": "egl"}
        for library in LIBRARIES:
            way = ways[pathlib.Path(library).name.split(".")[0]]
            ran = self.run_here(self.capture, "-o", self.folder / way, environment={"ETUDE_GL": way})
            self.assertEqual(ran.returncode, 0, ran.stderr)
            scenario = json.loads((self.folder / way / "manifest.json").read_text())["scenarios"][0]
            self.assertRegex(scenario["platform"].lower(), f"mesa [0-9.]+.*, by {way}$")
            cells.add((self.folder / way / "cells.jsonl").read_bytes())
        self.assertEqual(len(cells), 1, "the ways draw other pixels")

    @heavy
    def test_what_it_refuses_in_mid_run_is_not_run_and_resuming_runs_it(self):
        folder = self.folder / "temporary"
        folder.mkdir()
        whole = self.folder / "whole"
        scenario = self.write("taken.yaml", pathlib.Path(self.outside).read_text().replace(
            str(self.method), f"{self.method}, {folder}"))
        self.run_suite(scenario, out=whole)
        taken = self.run_here(scenario, "-o", self.out, "--jobs", "1", "--no-fence", environment={"TMPDIR": str(folder)})
        self.assertEqual(taken.returncode, 3, taken.stderr)
        self.assertRegex(taken.stderr, r"etude: this machine: .*; cells not run: [1-3]; finished cells are kept; --resume")
        self.assertFalse((self.out / "cells.jsonl").exists())
        folder.unlink()  # `exec` names it, so as a file it would belong to the program
        folder.mkdir()
        self.run_suite(scenario, "--resume")
        self.assert_same_results(whole, self.out)

    @heavy
    @unittest.skipUnless(shutil.which("strace"), "needs strace")
    def test_where_there_are_no_locks_a_run_goes_on_and_says_so(self):
        scenario, whole = self.write("ik.yaml", IK), self.folder / "whole"
        self.run_suite(scenario, out=whole)
        errors = [("ENOLCK", "No locks available"), ("ENOSYS", "Function not implemented"),
                  ("EOPNOTSUPP", "Operation not supported"), ("EIO", "Input/output error")]
        for error, words in errors if HEAVY else errors[:1]:
            run = self.run_here(scenario, "-o", self.out, "--overwrite", wrapped=[
                "strace", "-f", "-o", "/dev/null", "-e", "trace=flock", "-e", f"inject=flock:error={error}"])
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn(f"{self.out}: could not be locked ({words})", run.stderr)
            self.assert_same_results(whole, self.out)
            self.assertFalse((self.out / "lock").exists())
        held = self.run_here(scenario, "-o", self.out, "--overwrite", wrapped=[
            "strace", "-f", "-o", "/dev/null", "-e", "trace=flock", "-e", "inject=flock:error=EAGAIN"])
        self.assertEqual(held.returncode, 2)
        self.assertIn("another run is writing into this folder", held.stderr)

    def test_nobody_but_a_run_locks_its_folder(self):
        """A method that sees another run's folder could lock every file that it can open there."""
        many = IK.replace("trials: 4", "trials: 3000")
        first = subprocess.Popen([ETUDE, "run", self.write("many.yaml", many), "-o", self.out], stderr=subprocess.DEVNULL)
        self.wait_for_cells(self.out)
        lock = self.out / "lock"
        script = f"exec 9<{lock} && echo opened; exec 9>>{lock} && echo opened"
        seen = subprocess.run(["bwrap", "--unshare-user", "--ro-bind", "/", "/", "--cap-drop", "ALL", "sh", "-c", script],
                              capture_output=True, text=True)
        held = self.etude("run", self.folder / "many.yaml", "-o", self.out, "--resume")
        first.kill()
        first.wait()
        self.assertEqual(seen.stdout, "")
        self.assertEqual(held.returncode, 2)
        self.assertIn("another run is writing into this folder", held.stderr)

    def test_a_kill_of_anybody_leaves_nobody(self):
        dice = random.Random(1)
        for number in range(10):
            targets = kills.TARGETS[number % len(kills.TARGETS)]
            left, _ = kills.kill_once(ETUDE, targets, dice.uniform(0, 0.05), at_fence=number % 2 == 1)
            self.assertEqual(left, {}, targets)

    @heavy
    def test_a_damaged_file_is_refused_or_read_aright(self):
        made = damage.Damage(ETUDE, self.folder)
        rounds = [made.round(number) for number in (*range(11), 753)]  # 753 changes a key of host.json
        self.assertEqual([entry for entry in rounds if entry["wrong"]], [])
        self.assertIn(2, {entry["exit"] for entry in rounds})


if __name__ == "__main__":
    unittest.main()

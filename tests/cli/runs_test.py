"""Tests runs as users start them: every cell has its row, and the number of workers changes only the time."""
import json
import os
import signal
import subprocess
import unittest

from etude_case import ETUDE, IK, EtudeCase, cells_in_journal, heavy


def children_of(pid):
    with open(f"/proc/{pid}/task/{pid}/children") as file:
        return [int(child) for child in file.read().split()]


class Runs(EtudeCase):
    def test_every_cell_has_its_row_in_canonical_order(self):
        rows = self.run_suite(self.write("ik.yaml", IK))
        wanted = [f"ik/joint_noise_deg={noise}/{trial:03}/{method}"
                  for noise in (2, 5) for trial in range(4) for method in ("fixed", "least-squares")]
        self.assertEqual([row["cell"] for row in rows], wanted)
        self.assertLessEqual({row["status"] for row in rows}, {"ok", "unsolved"})
        self.assertFalse((self.out / "journal.jsonl").exists())

    def test_the_number_of_workers_changes_no_byte(self):
        path = self.write("ik.yaml", IK)
        folders = [self.folder / f"jobs-{jobs}" for jobs in (1, 3)]
        for jobs, folder in zip((1, 3), folders):
            self.run_suite(path, "--jobs", jobs, out=folder)
        self.assert_same_results(*folders)

    @heavy
    def test_functions_that_the_processor_chooses_change_no_byte(self):
        scenario = self.cut_scenario("builtin:sway", "/usr/share/assimp/models/BVH/01_03.bvh", trials=2)
        # glibc's sin and exp differ in the last bit on processors with fused multiply-add.
        tunables = {"any": None, "plain": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4", "no-avx": "glibc.cpu.hwcaps=-AVX2"}
        for name, value in tunables.items():
            environment = {key: text for key, text in os.environ.items() if key != "GLIBC_TUNABLES"}
            if value is not None:
                environment["GLIBC_TUNABLES"] = value
            for arguments in (["run", scenario, "-o", self.folder / name],
                              ["clip", "convert", "/usr/share/assimp/models/BVH/01_03.bvh", self.folder / f"{name}.csv"]):
                subprocess.run([ETUDE, *map(str, arguments)], env=environment, check=True, capture_output=True)
        for name in ("plain", "no-avx"):
            self.assert_same_results(self.folder / "any", self.folder / name)
            self.assertEqual((self.folder / "any.csv").read_bytes(), (self.folder / f"{name}.csv").read_bytes())

    @heavy
    def test_no_variable_of_a_shell_changes_a_byte_or_stops_the_program(self):
        scenario = self.write("c.yaml", """scenario: c
question: Does it run?
task: capture
clips: ['builtin:sway']
duration_s: 0.1
trials: 1
methods: [{name: hue}]
""")
        self.run_suite(scenario, out=self.folder / "plain")
        shell = dict(os.environ, LP_PERF="no_blend,no_tex", LP_NATIVE_VECTOR_WIDTH="512", GALLIUM_DRIVER="softpipe",
                     GALLIUM_OVERRIDE_CPU_CAPS="avx512", LC_ALL="tr_TR.UTF-8")
        subprocess.run([ETUDE, "run", scenario, "-o", self.folder / "shell"], env=shell, check=True, capture_output=True)
        self.assert_same_results(self.folder / "plain", self.folder / "shell")

    def test_another_seed_gives_other_worlds_and_the_control_differs(self):
        path = self.write("ik.yaml", IK)
        one = self.run_suite(path, out=self.folder / "one")
        two = self.run_suite(path, "--seed", 2, out=self.folder / "two")
        self.assertNotEqual([row["digest_world"] for row in one], [row["digest_world"] for row in two])

    def test_a_new_value_in_a_sweep_changes_no_other_world(self):
        before = self.run_suite(self.write("ik.yaml", IK), out=self.folder / "before")
        after = self.run_suite(self.write("ik.yaml", IK.replace("[2, 5]", "[2, 3, 5]")), out=self.folder / "after")
        kept = [row for row in after if row["joint_noise_deg"] != 3]
        self.assertEqual(before, kept)

    def test_a_worker_that_dies_takes_only_its_cell_with_it(self):
        # Cells are long, because a worker killed between two cells loses none.
        path = self.write("ik.yaml", IK.replace("trials: 4", "trials: 10\nmax_sweeps: 10000"))
        run = subprocess.Popen([ETUDE, "run", path, "--jobs", "2", "-o", self.out], stderr=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL)
        self.wait_for_cells(self.out)
        os.kill(children_of(run.pid)[0], signal.SIGABRT)  # as a failed assertion would
        self.assertEqual(run.wait(timeout=120), 0)
        rows = [row for row in (self.out / "cells.jsonl").read_text().splitlines()]
        self.assertEqual(len(rows), 10 * 2 * 2)
        crashed = [row for row in rows if '"crashed"' in row]
        self.assertIn(len(crashed), (1, 2))  # the worker's cell, or both cells of a world that it was making
        self.assertIn("signal 6 (Aborted)", crashed[0])

    def test_two_runs_never_share_a_folder(self):
        path = self.write("ik.yaml", IK.replace("trials: 4", "trials: 100000"))
        first = subprocess.Popen([ETUDE, "run", path, "-o", self.out], stderr=subprocess.DEVNULL)
        self.wait_for_cells(self.out)
        second = self.etude("run", path, "-o", self.out, "--overwrite")
        first.send_signal(signal.SIGTERM)
        self.assertEqual(first.wait(timeout=600), 130)
        self.assertEqual(second.returncode, 2)
        self.assertIn("another run is writing into this folder", second.stderr)
        self.assertIn("this run was interrupted or is still running", self.ends(2, "report", self.out).stderr)

    def test_a_byte_copy_of_a_clip_is_left_out_and_told(self):
        clips = self.folder / "clips"
        clips.mkdir()
        for name, move in ("a", "clap"), ("c", "boxing"):
            self.ends(0, "clip", "convert", f"builtin:{move}", clips / f"{name}.bvh")
        (clips / "b.bvh").write_bytes((clips / "a.bvh").read_bytes())
        scenario = self.write("t.yaml", f"scenario: t\nquestion: q?\ntask: tracking\nclips: ['{clips}/*.bvh']\ntrials: 4\n"
                                        "methods: [{name: a, solver: damped-least-squares}]\n")
        self.assertIn(f"b.bvh: is left out: is a byte copy of '{clips}/a.bvh'", self.ends(0, "run", scenario, "--dry-run").stderr)
        told = self.ends(0, "run", scenario, "-o", self.out, "--json")
        self.assertIn(f"b.bvh: was left out: is a byte copy of '{clips}/a.bvh'", told.stderr)
        left_out = json.loads(told.stdout)["left_out"]
        self.assertEqual([line.partition(": ")[0] for line in left_out], [f"{clips}/b.bvh"])
        self.assertEqual(self.facts("run", scenario, "-o", self.out, "--resume")["left_out"], left_out)
        setup, = json.loads((self.out / "manifest.json").read_text())["scenarios"]
        self.assertEqual([one["clip"] for one in setup["refused"]], [f"{clips}/b.bvh"])
        self.assertEqual(len(setup["loaded_clips"]), 2)
        self.ends(0, "verify", self.out)
        # Without a copy, the manifest keeps the pattern.
        (clips / "b.bvh").unlink()
        self.ends(0, "run", scenario, "-o", self.folder / "whole")
        setup, = json.loads((self.folder / "whole" / "manifest.json").read_text())["scenarios"]
        self.assertNotIn("refused", setup)
        self.assertEqual(len(setup["loaded_clips"]), 2)
        # If no clip can be read, the first reason is the cause, not the copy.
        for name in "abc":
            (clips / f"{name}.bvh").write_text("no motion")
        self.assertRegex(self.ends(2, "run", scenario, "--skip-refused", "-o", self.folder / "none").stderr,
                         "none of 1 clips can be read; the first: .*a.bvh:1")

    def test_nobody_listening_does_not_end_a_run(self):
        path = self.write("ik.yaml", IK)
        run = subprocess.Popen([ETUDE, "run", path, "-o", self.out], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        run.stderr.close()
        self.assertEqual(run.wait(timeout=600), 0)
        self.assertTrue((self.out / "cells.jsonl").exists())

    def test_closed_standard_streams_do_no_harm(self):
        path = self.write("ik.yaml", IK)
        script = 'exec "$0" run "$1" -o "$2" <&- >&- 2>&-'
        self.assertEqual(subprocess.run(["sh", "-c", script, ETUDE, path, self.out], timeout=600).returncode, 0)
        self.assertTrue((self.out / "cells.jsonl").exists())
        rows = subprocess.run(["sh", "-c", 'exec "$0" rows "$1" >&-', ETUDE, self.out], stderr=subprocess.PIPE, text=True)
        self.assertEqual(rows.returncode, 2)
        self.assertIn("standard output: was closed", rows.stderr)

    def test_a_condition_without_measurements_is_one_line_with_the_reason(self):
        clip = "/usr/share/assimp/models/BVH/01_01.bvh"
        out = self.etude("run", "scenarios/quick/detection.yaml", "--trials", 1, "--clips", clip, "-o", self.out).stdout
        self.assertIn("skipped: ", out)
        self.assertNotRegex(out, r"noise=1, turn_deg=0  +(?!skipped)\S", "no table")

    def test_ctrl_c_keeps_the_journal(self):
        path = self.write("ik.yaml", IK.replace("trials: 4", "trials: 100000"))
        run = subprocess.Popen([ETUDE, "run", path, "-o", self.out], stderr=subprocess.DEVNULL)
        self.wait_for_cells(self.out)
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(timeout=600), 130)
        self.assertGreater(cells_in_journal(self.out), 0)
        self.assertFalse((self.out / "cells.jsonl").exists())

    def test_a_run_is_not_overwritten_unasked(self):
        path = self.write("ik.yaml", IK)
        self.run_suite(path)
        self.assertIn("already contains a run", self.ends(2, "run", path, "-o", self.out).stderr)
        self.run_suite(path, "--overwrite")

    def test_rows_and_a_packed_cell_replace_no_file_unasked(self):
        rows = self.run_suite(self.write("ik.yaml", IK))
        text, pack = self.folder / "rows.jsonl", self.folder / "cell.etude"
        for words, file in ((["rows", self.out, "-o", text], text),
                            (["replay", self.out, "--cell", rows[0]["cell"], "--pack", pack], pack)):
            file.write_text("mine")
            self.assertIn("already exists; use --overwrite to replace this file", self.ends(2, *words).stderr)
            self.assertEqual(file.read_text(), "mine")
            self.assertIn(f"written: {file}\n", self.ends(0, *words, "--overwrite").stdout)
        self.assertEqual(text.read_bytes(), (self.out / "cells.jsonl").read_bytes())
        self.ends(0, "replay", pack)

    def test_lists_what_a_scenario_can_name(self):
        for what, words in {"methods": "capture", "metrics": "position_error_cm", "clips": "builtin:clap",
                            "scenarios": "quick/ik ", "recordings": "transition_frames"}.items():
            self.assertIn(words, self.ends(0, "list", what).stdout)


if __name__ == "__main__":
    unittest.main()

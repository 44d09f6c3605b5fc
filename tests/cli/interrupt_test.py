"""Tests Ctrl-C at any moment: one line is printed, the exit code is 130, and no file is incomplete. Also tests the
progress of long work."""
import os
import pathlib
import pty
import re
import signal
import subprocess
import time
import unittest

from etude_case import ETUDE, IK, EtudeCase, heavy

WALK = "/usr/share/assimp/models/BVH/01_01.bvh"
AT_ONCE = "etude: stopped; no partial result was kept\n"


# One world whose pictures take minutes.
LONG_TAKE = """scenario: long
question: Does it end?
task: capture
clips: [builtin:boxing]
duration_s: 20
trials: 1
methods: [{name: fixed, segmenter: hue, calibration: dlt, solver: ccd, weights: fixed}]
"""


class Interrupts(EtudeCase):
    def interrupt(self, arguments, is_begun, sent=signal.SIGINT):
        """Interrupts the program once `is_begun` is true; returns its output."""
        program = subprocess.Popen([ETUDE, *map(str, arguments)], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 600
        while not is_begun(program):
            self.assertIsNone(program.poll(), "it came to its end before it could be interrupted")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)
        program.send_signal(sent)
        said = program.communicate(timeout=600)[1]
        self.assertEqual(program.returncode, 130, said)
        return said

    def left(self):
        """Returns the unfinished files in the scratch folder."""
        return [path for path in self.folder.rglob("*") if ".partial" in path.name]

    def test_work_that_leaves_nothing_ends_at_once(self):
        def listens(program):
            status = pathlib.Path(f"/proc/{program.pid}/status").read_text()
            return int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16) >> (signal.SIGTERM - 1) & 1

        model = self.folder / "learnt.yaml"
        for arguments in (["train", "builtin:*", "-o", model, "--recogniser"], ["coach", "groove", "--stream", "-"],
                          ["gate", "--self-test"]):
            for sent in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(arguments=arguments, sent=sent):
                    self.assertEqual(self.interrupt(arguments, listens, sent), AT_ONCE)
        self.assertEqual(list(self.folder.iterdir()), [])

    @heavy
    def test_a_film_that_is_interrupted_leaves_nothing_and_an_old_page_as_it_was(self):
        self.run_suite(self.write("ik.yaml", IK + "video: {compare: [fixed, least-squares], trials: [1]}\n"))
        page, video = self.out / "report" / "index.html", self.out / "video"

        def is_filming(_):
            return list(video.glob("*.partial.mp4")) if video.exists() else []

        self.assertIn("stopped; Etude wrote the tables, but not the page", self.interrupt(["report", self.out], is_filming))
        self.assertFalse(page.exists())
        self.assertEqual((self.left(), list(video.iterdir())), ([], []))
        self.ends(0, "report", self.out)
        before = page.read_bytes(), (video / "convergence.mp4").read_bytes()
        self.interrupt(["report", self.out], is_filming)
        self.assertEqual(before, (page.read_bytes(), (video / "convergence.mp4").read_bytes()))
        self.assertEqual(self.left(), [])

    @heavy
    def test_a_clip_s_film_likewise(self):
        film = self.folder / "clip.mp4"
        said = self.interrupt(["clip", "render", WALK, "-o", film], lambda _: self.left())
        self.assertEqual(said, "etude: stopped; no files are kept\n")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_export_likewise(self):
        many = self.write("many.yaml", IK.replace("trials: 4", "trials: 3000"))
        self.interrupt(["export", many, "-o", self.out], lambda _: self.left())
        self.assertEqual([path.name for path in self.folder.iterdir()], ["many.yaml"])

    @heavy
    def test_an_export_ends_at_once_also_amid_a_world(self):
        long = self.write("long.yaml", LONG_TAKE)
        sent_at = []

        def renders(_):
            began = self.left()
            time.sleep(0.5)  # the world's pictures take much longer than this
            sent_at.append(time.monotonic())
            return began

        self.interrupt(["export", long, "--depth", "-o", self.out], renders)
        self.assertLess(time.monotonic() - sent_at[-1], 5, "the first signal ends it")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["long.yaml"])

    @heavy
    def test_a_replay_says_that_it_was_stopped(self):
        many = self.write("many.yaml", IK.replace("trials: 4", "trials: 300"))
        self.run_suite(many)

        def works(program):
            return pathlib.Path(f"/proc/{program.pid}/task/{program.pid}/children").read_text()

        self.assertEqual(self.interrupt(["replay", self.out], works), "etude: stopped; the remaining cells were not run again\n")

    @heavy
    def test_a_run_interrupted_in_its_last_writing_goes_on_to_the_same_bytes(self):
        many = self.write("many.yaml", IK.replace("trials: 4", "trials: 1500").replace("ccd, weights: fixed", "gauss-newton")
                          .replace("damped-least-squares", "gauss-newton"))
        whole = self.folder / "whole"
        self.run_suite(many, out=whole)
        said = self.interrupt(["run", many, "-o", self.out], lambda _: (self.out / "cells.partial.jsonl").exists())
        self.assertIn(f"stopped; 6000 finished cells were kept in {self.out};", said)
        self.assertFalse((self.out / "cells.jsonl").exists())
        self.run_suite(many, "--resume")
        self.assert_same_results(whole, self.out)

    def test_on_a_terminal_long_work_tells_how_far_it_is(self):
        terminal, program_s = pty.openpty()
        report = subprocess.Popen([ETUDE, "clip", "render", WALK, "--trim", "0:4", "--size", "360x360", "-o",
                                   self.folder / "clip.mp4"],
                                  stdout=subprocess.DEVNULL, stderr=program_s)
        os.close(program_s)
        said = b""
        try:
            while chunk := os.read(terminal, 4096):
                said += chunk
        except OSError:  # a closed terminal raises OSError
            pass
        os.close(terminal)
        self.assertEqual(report.wait(timeout=600), 0)
        self.assertRegex(said.decode(), r"\[#+\.+\] \d+/\d+ frames of clip.mp4")
        self.assertRegex(said.decode(), r"\[#{32}\] (\d+)/\1 frames of clip.mp4\r?\n")


if __name__ == "__main__":
    unittest.main()

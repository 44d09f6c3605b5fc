"""Tests that no command follows a link in a folder filled by somebody else: none writes or reads through it, or
reveals its target."""
import os
import pathlib
import shutil
import unittest

from etude_case import IK, EtudeCase, heavy, ik_scenario

SCENARIO = ik_scenario(trials=2) + "video: {compare: [fixed, least-squares], trials: [1]}\n"


class Links(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario, cls.whole = cls.run_once(SCENARIO)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.whole, self.out)
        self.home = self.folder / "home"  # the user's home; the run is a stranger's
        self.home.mkdir()
        (self.home / "key").write_text("secret\n")

    def refuse(self, link, *arguments):
        done = self.ends(2, *arguments)
        self.assertIn(f"{link}: this is a link, and Etude does not follow links inside this folder", done.stderr)
        self.assertNotIn("secret", done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def assert_home_untouched(self):
        self.assertEqual([path.name for path in self.home.iterdir()], ["key"])
        self.assertEqual((self.home / "key").read_text(), "secret\n")

    def test_a_pipe_in_the_place_of_a_lock_is_not_waited_for(self):
        scenario = self.write("ik.yaml", SCENARIO)
        (self.out / "lock").unlink(missing_ok=True)
        os.mkfifo(self.out / "lock")
        for words in (["--overwrite"], ["--resume"]):
            self.assertIn(f"{self.out}/lock: is no file", self.ends(2, "run", scenario, "-o", self.out, *words).stderr)
        self.assertTrue((self.out / "cells.jsonl").exists())

    def test_are_not_written_through(self):
        for part, commands in [("report", [["report", "--no-video"], ["gate"], ["verify", "--sample", 0]]),
                               ("report/tables", [["report", "--no-video"]]),
                               ("report/index.html", [["report", "--no-video"]]),
                               ("report/gate.md", [["gate"]]),
                               ("report/tables/ik.csv", [["report", "--no-video"]]),
                               ("video", [["report"]]),
                               ("video/convergence.mp4", [["report"]])]:
            link = self.out / part
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(self.home / "key" if link.suffix else self.home)
            for command, *more in commands:
                with self.subTest(linked=part, command=command):
                    self.refuse(link, command, self.out, *more)
                    self.assert_home_untouched()
                    beside = [path for name in ("report", "video") for path in (self.out / name).rglob("*")
                              if not (self.out / name).is_symlink() and path.is_file() and not path.is_symlink()]
                    self.assertEqual(beside, [], "nothing half-written")
            link.unlink()
            for name in "report", "video":
                shutil.rmtree(self.out / name, ignore_errors=True)

    def test_are_not_read_through(self):
        recording = sorted((self.out / "recordings").iterdir())[0].relative_to(self.out)
        readers = [["report", "--no-video"], ["compare", self.whole], ["replay", "--sample", 1], ["rows"]]
        for part in ["manifest.json", "host.json", "summary.json", "cells.jsonl", "timings.jsonl", "series",
                     "series/ik.jsonl", "recordings", recording]:
            link, kept = self.out / part, self.folder / "kept"
            link.rename(kept)
            link.symlink_to(kept)  # the content is valid, but not ours to read
            for command, *more in [["gate"], *(readers if part == "cells.jsonl" else [])]:
                with self.subTest(linked=str(part), command=command):
                    self.refuse(link, command, self.out, *more, "--unsealed")
            if part == "cells.jsonl":
                self.refuse(link, "verify", self.out, "--sample", 0)
            link.unlink()
            kept.rename(link)
        self.ends(0, "gate", self.out)

    def test_in_recordings_are_no_clips(self):
        recording = sorted((self.out / "recordings").iterdir())[0]
        recording.rename(self.folder / "kept")
        recording.symlink_to(self.folder / "kept")
        cell = recording.stem.replace("~", "/")
        self.refuse(recording, "clip", "info", f"{self.out}#{cell}")

    def test_that_a_user_names_are_the_users_word(self):
        (self.folder / "mine").symlink_to(self.out)
        self.ends(0, "report", self.folder / "mine", "--no-video")
        self.assertTrue((self.out / "report" / "index.html").exists())

    def test_that_are_pipes_are_not_waited_for(self):
        (self.out / "summary.json").unlink()
        os.mkfifo(self.out / "summary.json")
        self.assertIn("summary.json: is no file", self.ends(2, "gate", self.out, "--unsealed").stderr)

    def test_in_a_shard_are_neither_gone_on_with_nor_merged(self):
        scenario, shard = self.write("t.yaml", IK), self.folder / "1"
        for i in 1, 2:
            self.ends(0, "run", scenario, "--shard", f"{i}/2", "-o", self.folder / str(i))
        journal, kept = shard / "journal.jsonl", self.folder / "kept"
        lines = journal.read_text().splitlines(keepends=True)
        for text in "".join(lines), "".join(lines[:-3]):  # complete; and with cells still to run
            journal.unlink()
            kept.write_text(text)
            journal.symlink_to(kept)
            self.refuse(journal, "run", scenario, "--shard", "1/2", "--resume", "-o", shard)
            self.refuse(journal, "merge", shard, self.folder / "2", "-o", self.folder / "merged")
            self.assertEqual(kept.read_text(), text)

    @heavy
    def test_take_no_last_words_of_programs(self):
        program = self.write("method.py", """import sys
input()
print('{"type": "hello", "protocol": 1, "name": "m", "version": "1"}', flush=True)
print("words", file=sys.stderr)
""")
        text = IK + f"  - {{name: mine, exec: [python3, {program}]}}\n"
        scenario, shard = self.write("t.yaml", text), self.folder / "1"
        run = ["run", scenario, "--shard", "1/2", "-o", shard]
        self.etude(*run)
        self.assertTrue((shard / "stderr" / "ik~mine.txt").exists())
        journal = shard / "journal.jsonl"
        journal.write_text("".join(journal.read_text().splitlines(keepends=True)[:-4]))
        shutil.rmtree(shard / "stderr")
        (shard / "stderr").symlink_to(self.home)
        self.etude(*run, "--resume")
        self.assert_home_untouched()

    def test_are_no_answers(self):
        scenario, data, answers = self.write("t.yaml", IK), self.folder / "data", self.folder / "answers"
        self.ends(0, "export", scenario, "-o", data)
        for link in pathlib.Path.symlink_to, pathlib.Path.hardlink_to:
            with self.subTest(link.__name__):
                for truth in sorted((data / "truth").rglob("truth.json")):
                    answer = answers / truth.parent.relative_to(data / "truth").with_suffix(".json")
                    answer.parent.mkdir(parents=True, exist_ok=True)
                    link(answer, truth)
                done = self.ends(2, "score", data, answers, "-o", self.folder / "scored")
                self.assertIn("ik/joint_noise_deg=2/000.json is a link; allowed: regular files that are not links",
                              done.stderr)
                self.assertFalse((self.folder / "scored").exists())
                shutil.rmtree(answers)
        (answers / "ik").mkdir(parents=True)
        (answers / "ik" / "joint_noise_deg=2").symlink_to(data / "truth" / "ik" / "joint_noise_deg=2")
        done = self.ends(2, "score", data, answers, "-o", self.folder / "scored", "--allow-missing")
        self.assertIn("ik/joint_noise_deg=2 is a link; allowed: regular files", done.stderr)


if __name__ == "__main__":
    unittest.main()

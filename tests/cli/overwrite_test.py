"""Tests `run --overwrite` while others read the run: the new run replaces the old one as a whole, and a reader sees
one of the two."""
import contextlib
import itertools
import os
import random
import shutil
import subprocess
import threading
import time
import unittest

from etude_case import ETUDE, HEAVY, EtudeCase, ik_scenario

ROUNDS = 60 if HEAVY else 2
READERS = [["report", "OUT", "--no-video"], ["rows", "OUT"], ["gate", "OUT"], ["compare", "OUT", "OUT"]]


class Overwriting(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Makes two runs that differ in every row, once; keeps their scenarios and rows."""
        cls.shared = cls.shared_folder()
        cls.scenarios, cls.rows = [], []
        for noise in (3, 4):
            scenario = cls.shared / f"{noise}.yaml"
            scenario.write_text(ik_scenario(trials=4).replace("[2, 5]", f"[{noise}]"))
            made = cls.etude("run", scenario, "-o", cls.shared / str(noise))
            assert made.returncode == 0, made.stderr
            cls.scenarios.append(scenario)
            cls.rows.append((cls.shared / str(noise) / "cells.jsonl").read_text())

    def overwrite(self, scenario):
        return subprocess.Popen([ETUDE, "run", scenario, "-o", self.out, "--overwrite", "--jobs", "1"],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def read_on(self, run):
        """Reads the run with one reader after the other until `run` ends; checks that each read one of the runs, or
        none."""
        for words in itertools.cycle(READERS):
            if run.poll() is not None:
                return
            reader = self.etude(*(self.out if word == "OUT" else word for word in words))
            complaints = [line for line in reader.stderr.splitlines() if line.startswith("etude: ")]
            self.assertIn(reader.returncode, (0, 2, 3), f"{words[0]}: {reader.stderr}")
            if words[0] != "gate":  # gate prints that a run is incomplete
                self.assertEqual(len(complaints), int(reader.returncode != 0), f"{words[0]}: {reader.stderr}")
            if words[0] == "rows" and reader.returncode == 0:
                self.assertIn(reader.stdout, self.rows)
            self.read += 1

    def write_on(self, stop):
        """Writes report files into the run, one after the other, whatever is there."""
        for number in itertools.count():
            if stop.is_set():
                return
            try:
                (self.out / "report").mkdir(exist_ok=True)
                (self.out / "report" / f"{number % 100}.html").touch()
            except FileNotFoundError:
                pass  # the run was replaced meanwhile
            time.sleep(0.0002)

    def test_a_run_takes_anothers_place_while_others_read_it(self):
        self.read, stop = 0, threading.Event()
        shutil.copytree(self.shared / "3", self.out)
        writer = threading.Thread(target=self.write_on, args=[stop])
        writer.start()
        self.addCleanup(writer.join)
        self.addCleanup(stop.set)
        for number in range(ROUNDS):
            scenario, rows = self.scenarios[1 - number % 2], self.rows[1 - number % 2]
            run = self.overwrite(scenario)
            self.read_on(run)
            self.assertEqual(run.returncode, 0, run.stderr.read())
            run.stderr.close()
            self.assertEqual(self.etude("rows", self.out).stdout, rows)
            self.assertEqual([path.name for path in self.folder.iterdir()], ["out"])
        print(f"{ROUNDS} runs replaced, read {self.read} times meanwhile")

    def files(self):
        """Returns the run's files as (name, inode, time); the time is needed because inodes are reused."""
        found = set()
        for name in os.listdir(self.out) if self.out.exists() else []:
            with contextlib.suppress(FileNotFoundError):
                status = os.stat(self.out / name)
                found.add((name, status.st_ino, status.st_mtime_ns))
        return found

    def test_killed_while_it_replaces_a_run_it_leaves_the_old_one_whole_or_nothing_of_it(self):
        dice, whole = random.Random(1), 0
        for number in range(ROUNDS):
            shutil.rmtree(self.out, ignore_errors=True)
            shutil.copytree(self.shared / "3", self.out)
            old = self.files()
            run = self.overwrite(self.scenarios[1])
            while self.files() >= old and run.poll() is None:
                time.sleep(0.0002)
            time.sleep(dice.choice([0, 0, 0.001, 0.01, 0.1]))
            run.kill()
            run.wait()
            run.stderr.close()
            self.assertIn(self.files() & old, (old, set()))
            whole += self.files() >= old
        # The next run removes what a killed run has moved aside.
        self.run_suite(self.scenarios[0], "--overwrite")
        self.run_suite(self.scenarios[1], "--overwrite")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["out"])
        print(f"{ROUNDS} kills, {whole} times the old run is there")


if __name__ == "__main__":
    unittest.main()

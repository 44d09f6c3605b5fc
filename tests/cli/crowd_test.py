"""Tests `etude crowd`: it tracks a crowd, reports on it, and films it."""
import json
import re
import subprocess
import unittest

from etude_case import EtudeCase, heavy

FEW = ("--characters", "12", "--seconds", "0.2")


class Crowd(EtudeCase):
    def test_it_tells_how_many_meet_their_targets_and_how_long_frames_take(self):
        result = self.ends(0, "crowd", *FEW)
        lines = result.stdout.splitlines()
        self.assertEqual(len(lines), 3, result.stdout)
        self.assertIn("12 characters, 12 frames at 60 Hz", lines[0])
        met = float(re.match(r"([\d.]+) % of all poses reach their targets", lines[1])[1])
        self.assertGreater(met, 50)
        self.assertLessEqual(met, 100)
        times = [float(time) for time in re.findall(r"(?:median|p99|largest) ([\d.]+)", lines[2])]
        self.assertEqual(times, sorted(times))
        self.assertEqual(self.etude("crowd", *FEW).stdout.splitlines()[1], lines[1], "the same crowd again")
        other = self.etude("crowd", *FEW, "--seed", "2").stdout.splitlines()
        self.assertNotEqual(other[1], lines[1], "other dice, other motions")

    def test_tells_programs_the_same(self):
        told = self.facts("crowd", *FEW)
        self.assertEqual((told["characters"], told["frames"], told["rate_hz"]), (12, 12, 60))
        self.assertGreater(told["met_share"], .5)
        self.assertLessEqual(told["median_ms"], told["largest_ms"])

    @heavy
    def test_the_film_has_every_second_frame_of_sixty_a_second_and_the_same_bytes_whoever_draws(self):
        films = []
        for name, jobs in (("a.mp4", "1"), ("b.mp4", "3")):
            self.ends(0, "crowd", *FEW, "-o", self.folder / name, "--jobs", jobs)
            films.append((self.folder / name).read_bytes())
        self.assertEqual(films[0], films[1])
        probe = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-show_entries",
                                "stream=width,height,r_frame_rate,nb_frames", self.folder / "a.mp4"],
                               capture_output=True, text=True, timeout=600, check=True)
        stream = json.loads(probe.stdout)["streams"][0]
        self.assertEqual((stream["width"], stream["height"], stream["r_frame_rate"], stream["nb_frames"]),
                         (1280, 720, "30/1", "6"))
        self.assertEqual(self.etude("crowd", *FEW, "-o", self.folder / "a.mp4").returncode, 2, "a file that is there")
        self.assertEqual((self.folder / "a.mp4").read_bytes(), films[0])

    @heavy
    def test_a_film_lasts_as_long_as_the_motion_at_rates_that_do_not_divide(self):
        # 45 Hz gives 22.5 frames a second of film: every second frame.
        film = self.folder / "45.mp4"
        self.ends(0, "crowd", "--characters", "2", "--seconds", "0.4", "--rate", "45", "-o", film)
        probe = subprocess.run(["ffprobe", "-v", "error", "-of", "csv=p=0", "-show_entries", "stream=r_frame_rate,nb_frames", film],
                               capture_output=True, text=True, timeout=600, check=True)
        self.assertEqual(probe.stdout.strip(), "45/2,9")

    def test_refuses_in_one_line(self):
        for arguments, says in ((("--characters", "0"), "--characters"),
                                (("--seconds", "0.05"), "--seconds: 0.05 s at 60 Hz give 3 frames; allowed: 4 frames or more"),
                                (("--seconds", "nan"), "--seconds"),
                                (("-o", self.folder / "crowd.gif"), "has the wrong ending; allowed: .mp4")):
            self.refusal("crowd", *arguments, says=says)
        self.assertFalse((self.folder / "crowd.gif").exists())


if __name__ == "__main__":
    unittest.main()

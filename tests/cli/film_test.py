"""Tests the film of two solvers that `etude report` makes."""
import base64
import json
import shutil
import subprocess
import unittest

from etude_case import IK, EtudeCase, heavy

FILMED = IK + "video: {compare: [fixed, least-squares], trials: [1]}\n"


class Film(EtudeCase):
    def film(self, folder):
        self.ends(0, "report", folder)
        return (folder / "video" / "convergence.mp4").read_bytes()

    @heavy
    def test_two_solvers_settle_in_a_film_of_six_to_ten_seconds(self):
        self.run_suite(self.write("ik.yaml", FILMED))
        film = self.film(self.out)
        page = (self.out / "report" / "index.html").read_text()
        self.assertIn("data:video/mp4;base64," + base64.b64encode(film).decode(), page)
        self.assertIn("joint_noise_deg=2, trial 1, the first world that kept recordings of both", page)
        probe = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-show_entries",
                                "stream=width,height,r_frame_rate,nb_frames", self.out / "video" / "convergence.mp4"],
                               capture_output=True, text=True, timeout=600, check=True)
        stream = json.loads(probe.stdout)["streams"][0]
        self.assertEqual((stream["width"], stream["height"], stream["r_frame_rate"]), (1280, 720, "30/1"))
        self.assertIn(int(stream["nb_frames"]), range(6 * 30, 10 * 30 + 1))
        shutil.rmtree(self.out / "video")
        self.assertEqual(self.film(self.out), film)

    def test_without_recordings_of_two_the_page_says_why(self):
        self.run_suite(self.write("ik.yaml", FILMED.replace("fixed, least-squares]", "fixed]")))
        self.ends(0, "report", self.out)
        self.assertIn("this run kept recordings of only one method; two in the same world are needed", (self.out / "report" / "index.html").read_text())
        self.assertFalse((self.out / "video").exists())


if __name__ == "__main__":
    unittest.main()

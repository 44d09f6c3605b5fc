"""Tests `etude sensor stats` and `fit`: the statistics of recordings, and a fitted sensor in a scenario."""
import math
import random
import unittest

from etude_case import EtudeCase, heavy

SCENARIO = """scenario: sensed
question: Is the sensor file used?
task: detection
clips: ['builtin:clap', 'builtin:sway']
events: 2
sensor: {}
occluder: {}
trials: 2
methods:
  - {{name: fixed, filter: none, weights: fixed}}
"""


def kinect_and_targets(seconds=8):
    """Returns a body with swinging joints, by a Kinect (30 Hz, metres, with errors) and by 17 targets (60 Hz,
    millimetres)."""
    dice = random.Random(1)
    joint_of_target = [9, 5, 8, 4, 1, 16, 12, 8, 4, 11, 7, 19, 15, 0, 3, 17, 13]

    def place(joint, t):
        return (0.05 * joint - 0.6 + 0.1 * math.sin(2 * t + joint), 0.04 * joint + 0.1 * math.cos(1.5 * t + joint),
                2.5 + 0.02 * joint + 0.05 * math.sin(t + 2 * joint))

    kinect = [" ".join(" ".join(f"{x + dice.gauss(0, 0.01):.6f}" for x in place(joint, k / 30)) + " 0 0 0 1"
                       for joint in range(25)) for k in range(30 * seconds)]
    # Several joints share a target, but each swings in its own way; the difference counts as their error.
    targets = [" ".join(" ".join(f"{1000 * x:.3f}" for x in place(joint, k / 60)) + " 0 0 0 1"
                        for joint in joint_of_target) for k in range(60 * seconds)]
    return "\n".join(kinect) + "\n", "\n".join(targets) + "\n"


class Sensor(EtudeCase):
    def setUp(self):
        super().setUp()
        kinect, targets = kinect_and_targets()
        (self.folder / "kinect.txt").write_text(kinect)
        (self.folder / "targets.txt").write_text(targets)

    def sensor(self, *arguments, code=0):
        result = self.etude("sensor", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def test_tells_recordings_by_themselves_and_against_a_reference(self):
        alone = self.sensor("stats", self.folder / "kinect.txt").stdout
        self.assertIn("240 frames at 30 Hz, 8.0 s; 0.0 % of the joint positions are missing", alone)
        self.assertRegex(alone, r"error of hands +mm +-\n")
        beside = self.sensor("stats", self.folder / "kinect.txt", "--reference", self.folder / "targets.txt",
                             "--simulate", "v1", "--worlds", "2").stdout
        self.assertIn("480 frames at 60 Hz", beside)
        self.assertRegex(beside, r"error of hands +mm +\d+\.\d\d +\d+\.\d\d +x\d")
        self.assertRegex(beside, r"\d+ of \d+ statistics differ from the recording's by at most 30 %")

    def test_tells_programs_the_same(self):
        kinect, reference = self.folder / "kinect.txt", self.folder / "targets.txt"
        alone = self.facts("sensor stats", kinect)
        self.assertEqual([(one["frames"], one["missing_share"]) for one in alone["recordings"]], [(240, 0)])
        self.assertEqual((alone["match"], alone["agreement"]), (None, None))
        beside = self.facts("sensor stats", kinect, "--reference", reference, "--simulate", "v1", "--worlds", "2")
        self.assertEqual([column["column"] for column in beside["columns"]], ["real", "simulated", "+-"])
        self.assertGreaterEqual(beside["agreement"]["compared"], beside["agreement"]["within"])

    @heavy
    def test_writes_a_sensor_that_a_scenario_uses(self):
        file = self.folder / "sensor.yaml"
        fit = self.facts("sensor fit", self.folder / "kinect.txt", "--reference", self.folder / "targets.txt", "-o", file,
                         "--worlds", "2", "--steps", "2")
        self.assertEqual([check["of"] for check in fit["checks"]], ["real", "second half", "first half"])
        self.assertIn("# Fitted by `etude sensor fit` to 8.0 s", file.read_text())
        digests = {}
        for sensor, occluder in (("v2", "none"), (str(file), "none"), ("v1", "none"), ("v2", "table")):
            scenario = self.folder / "scenario.yaml"
            scenario.write_text(SCENARIO.format(sensor, occluder))
            rows = self.run_suite(scenario, "--overwrite")
            digests[sensor, occluder] = str([row["digest_stream"] for row in rows])
        self.assertEqual(len(set(digests.values())), 4)

    def test_complains_of_what_it_cannot_read(self):
        broken = self.folder / "broken.txt"
        broken.write_text("1 2 3\n")
        for arguments, words in (
                (["stats", broken], "found 3 values in this row; allowed for a Kinect v2 recording: 75"),
                (["stats", self.folder / "none.txt"], "none.txt"),
                (["stats", self.folder / "kinect.txt", "--simulate", "v2"], "--simulate: needs --reference"),
                (["fit", self.folder / "kinect.txt", "--reference", broken, "-o", self.folder / "s.yaml"],
                 "found 3 values in this row; allowed for a recording of 17 targets: 119")):
            with self.subTest(words):
                self.assertIn(words, self.sensor(*arguments, code=2).stderr)
        self.assertFalse((self.folder / "s.yaml").exists())


if __name__ == "__main__":
    unittest.main()

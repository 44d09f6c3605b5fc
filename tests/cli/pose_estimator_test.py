"""Tests the measurements of examples/pose-estimator on keypoints with known results. (No estimator is run.)"""
import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from etude_case import EtudeCase

EXAMPLES = Path(__file__).parents[2] / "examples" / "pose-estimator"
COMPARE, ANSWER = EXAMPLES / "compare.py", EXAMPLES / "answer.py"
SCENARIO = """scenario: pictures
question: How hard are the pictures?
task: capture
clips: ['builtin:boxing']
duration_s: 0.1
trials: 1
methods: [{name: a}]
"""
LIMBS = ["left_shoulder", "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
         "right_hip", "left_knee", "right_knee", "left_ankle", "right_ankle"]  # COCO's numbers 5…16


def projection(path):
    """Returns the 3 × 4 matrix of the calibration file. In OpenCV pixel centres are at whole numbers, in ours at
    halves."""
    text = path.read_text()
    numbers = {name: [float(x) for x in re.search(rf"\n{name}:.*?data: \[(.*?)\]", text, re.S).group(1).split(",")]
               for name in ("camera_matrix", "R", "T")}
    inside = np.array(numbers["camera_matrix"]).reshape(3, 3) + np.array([[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0]])
    return inside @ np.column_stack([np.array(numbers["R"]).reshape(3, 3), numbers["T"]])


class PoseEstimator(EtudeCase):
    @classmethod
    def setUpClass(cls):
        shared = cls.shared_folder()
        (shared / "pictures.yaml").write_text(SCENARIO)
        cls.exported = shared / "data"
        exported = cls.etude("export", shared / "pictures.yaml", "-o", cls.exported)
        assert exported.returncode == 0, exported.stderr

    def setUp(self):
        super().setUp()
        self.data = self.folder / "data"
        shutil.copytree(self.exported, self.data)
        self.truth = self.data / "truth" / "pictures" / "all" / "000"
        joints = json.loads((self.data / "inputs" / "pictures" / "all" / "setting.json").read_text())["joints"]
        self.poses = np.array(json.loads((self.truth / "truth.json").read_text())["poses"]).reshape(-1, len(joints), 3)
        self.limbs = [joints.index(name) for name in LIMBS]

    def compare(self, shift, score):
        """Returns the output line for keypoints that lie `shift` pixels to the right of the truth."""
        keypoints = {}
        problem = json.loads((self.data / "inputs" / "pictures" / "all" / "000" / "problem.json").read_text())
        for picture in (name for camera in problem["cameras"] for name in camera["pictures"]):
            camera, frame = picture.removesuffix(".png").rsplit("-", 1)
            points = np.column_stack([self.poses[int(frame)][self.limbs], np.ones(12)])
            u, v, w = projection(self.truth / f"{camera}.yaml") @ points.T
            found = [[0, 0, 0]] * 5 + [[x + shift, y, score] for x, y in zip(u / w, v / w)]
            keypoints[picture] = found
        (self.truth / "keypoints.json").write_text(json.dumps(keypoints))
        told = subprocess.run([sys.executable, COMPARE, "--export", self.data], capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stderr)
        return [cell.strip() for cell in told.stdout.splitlines()[-1].strip("|").split("|")]

    def answer(self, shift):
        """Returns the score of answers from stored keypoints that lie `shift` pixels to the right of the truth."""
        self.compare(shift, 0.9)
        answers = self.folder / f"answers-{shift}"
        kept = answers / ".keypoints" / "pictures" / "all" / "000.json"
        kept.parent.mkdir(parents=True)
        kept.write_text((self.truth / "keypoints.json").read_text())
        told = subprocess.run([sys.executable, ANSWER, self.data, answers], capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stderr)
        found = np.array(json.loads((answers / "pictures" / "all" / "000.json").read_text())["poses"])
        run = self.folder / f"run-{shift}"
        self.ends(0, "score", self.data, answers, "-o", run, "--name", "estimator", "--alone")
        cell = json.loads(self.etude("rows", run).stdout)
        self.assertEqual(cell["status"], "ok")
        off = np.linalg.norm(found.reshape(self.poses.shape) - self.poses, axis=2)[:, self.limbs]
        return 1000 * off.mean(), cell["mpjpe_mm"]

    def test_stored_keypoints_become_answers_that_are_scored(self):
        joints, all_twenty = self.answer(0)
        self.assertLess(joints, 10, "what cameras calibrated by clicked points leave")
        self.assertLess(all_twenty, 60, "hands, feet and head hang from the twelve")
        self.assertGreater(self.answer(8)[0], joints + 5, "the control: every keypoint eight pixels off")

    def test_the_truth_has_no_error(self):
        self.assertEqual(self.compare(0, 0.9), ["all", "6", "100 %", "0.90", "0.0", "0.0", "100 %"])

    def test_an_error_is_told_in_per_cent_of_the_bodys_height(self):
        # The body is about 1.5 m from head to ankle; at 3.8 m and f = 600 that is 240 pixels.
        _, _, people, score, median, high, near = self.compare(24, 0.2)
        self.assertEqual((people, score, near), ("0 %", "0.20", "0 %"))
        self.assertAlmostEqual(float(median), 10, delta=1.5)
        self.assertGreaterEqual(float(high), float(median))


if __name__ == "__main__":
    unittest.main()

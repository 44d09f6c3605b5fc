"""Tests examples/segmenter: its masks cover the person, `etude capture --masks` reads them, and it works in a run."""
import pathlib
import shutil
import struct
import subprocess
import unittest

import numpy as np
from etude_case import EtudeCase

ROOT = pathlib.Path(__file__).resolve().parents[2]
SEGMENTER = ROOT / "examples/segmenter"
SCENARIO = f"""scenario: masks
question: Does the segmenter find the person?
task: capture
clips: ['builtin:clap']
duration_s: 0.1
trials: 1
seed: 1
clothes: everyday
scene: 0.25
methods:
  - {{name: blazepose, seat: segmenter, exec: [node, {SEGMENTER}/method.mjs], time_s: 120}}
metrics: [iou]
"""


def grey(path):
    """Returns a PNG's pixels, by ffmpeg, and its width and height, by its header."""
    size = struct.unpack(">II", path.read_bytes()[16:24])
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "gray", "-"], check=True, capture_output=True)
    return np.frombuffer(raw.stdout, np.uint8), size


@unittest.skipUnless(shutil.which("node") and (SEGMENTER / "node_modules/@mediapipe/pose").exists(),
                     "the segmenter is not installed: cd examples/segmenter && npm install")
class Segmenter(EtudeCase):
    def test_its_masks_are_those_of_the_person(self):
        (row,) = self.run_suite(self.write("masks.yaml", SCENARIO))
        self.assertEqual((row["status"], row["reason"]), ("ok", None))
        self.assertGreater(row["iou"], 0.7)

    def test_a_film_becomes_masks_of_its_size_one_a_frame(self):
        data = self.folder / "data"
        self.ends(0, "export", self.write("masks.yaml", SCENARIO), "-o", data)
        film = next(data.rglob("camera-1.mkv"))
        subprocess.run(["ffmpeg", "-v", "error", "-i", film, self.folder / "picture-%04d.png"], check=True)
        subprocess.run(["node", SEGMENTER / "masks.mjs", film, self.folder / "masks"], check=True, capture_output=True)
        masks = sorted((self.folder / "masks/camera-1").glob("*.png"))
        pictures = sorted(self.folder.glob("picture-*.png"))
        self.assertEqual(len(masks), len(pictures))
        person, size = grey(masks[0])
        self.assertEqual(size, grey(pictures[0])[1])
        self.assertTrue(0.01 < np.mean(person > 127) < 0.4, "the person is a part of the picture")

    def test_what_is_no_film_is_said(self):
        told = subprocess.run(["node", SEGMENTER / "masks.mjs"], capture_output=True, text=True)
        self.assertEqual((told.returncode, told.stderr.startswith("usage: node masks.mjs")), (2, True))


if __name__ == "__main__":
    unittest.main()

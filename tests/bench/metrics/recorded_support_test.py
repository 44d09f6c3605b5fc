"""Computes from recordings, in Python, what holds a body up in each request that a run keeps, by the definitions in
docs/reference/metrics.md, and compares it with the run."""
import json
import math
import pathlib
import sys
import unittest
import unittest.mock

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "cli")]
from independent import support, transition  # noqa: E402
from etude_case import EtudeCase, heavy  # noqa: E402

METHODS = {"played": ("played", "planted-feet"), "fade": ("now", "crossfade"), "spring": ("now", "inertialised-spring")}
MISTAKES = {"LOWEST": 0.06, "REST_MPS": 0.3, "HEIGHT": 0.01, "FALL_MPS2": (12, 13)}  # each mistake must change a result
SCENARIO = """scenario: held
question: Does a second program see the same bodies held up?
task: transition
libraries:
  moves: ['builtin:*']
  floor: ['FOLDER/*.bvh', 'builtin:jump']
trials: TRIALS
seed: 3
methods:
""" + "".join(f"  - {{name: {name}, choice: {choice}, join: {join}}}\n" for name, (choice, join) in METHODS.items())


def tipped(bvh, angle_of):
    """Returns a clip whose whole body is tipped backwards, by degrees per frame, about the floor point between its
    feet."""
    tree, motion = bvh.split("MOTION\n")
    frames = motion.splitlines()
    tree = tree.replace("HIERARCHY\nROOT", "HIERARCHY\nROOT floor\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
                        "JOINT") + "}\n"
    turned = [f"0 {-angle_of(f):.6f} 0 {line}" for f, line in enumerate(frames[2:])]
    return tree + "MOTION\n" + "\n".join([*frames[:2], *turned]) + "\n"


def join_of(recording):
    """Returns a recording as a join for the second implementation; frames count from the recording's first."""
    def motion(track):
        places = [list(zip(*[iter(pose)] * 3)) for pose in track["poses"]]
        return {"rate_hz": track["rate_hz"], "frames": len(places),
                "joints_m": dict(zip(recording["joints"], zip(*places)))}
    tracks, through = {}, []
    for track in recording["tracks"]:
        if track["name"] == "through":
            through.append(motion(track))
        tracks[track["name"]] = motion(track)
    points = recording["extras"]["transition_frames"]
    between = [{**clip, "begin": begin, "left_at": left_at} for clip, begin, left_at in zip(through, points, points[1:])]
    return {"shown": tracks["coach"], "left": tracks["left"], "wanted": tracks["wanted"], "between": between,
            "request": recording["extras"]["request_frame"], "first": points[0], "last": points[-1]}


class RecordedSupport(EtudeCase):
    def requests(self, trials):
        """Returns (cell, join) of every answered request, from a run of jumps and from bodies that lie down and get
        up."""
        clips = self.folder / "clips"
        clips.mkdir()
        for name, angle_of in {"lies": lambda f: 90, "rises": lambda f: 45 * (1 + math.cos(math.pi * min(f / 60, 1))),
                               "sways": lambda f: 8 * math.sin(f / 9) ** 2}.items():
            standing = clips / f"{name}.bvh"
            self.assertEqual(self.etude("clip", "convert", "builtin:standby", standing).returncode, 0)
            standing.write_text(tipped(standing.read_text(), angle_of))
        scenario = self.write("held.yaml", SCENARIO.replace("FOLDER", str(clips)).replace("TRIALS", str(trials)))
        done = self.etude("run", scenario, "-o", self.out, "--keep", "motions")
        self.assertIn(done.returncode, (0, 1), done.stderr)
        for cell in map(json.loads, (self.out / "cells.jsonl").read_text().splitlines()):
            if cell["status"] == "ok":
                recording = self.out / "recordings" / f"{cell['cell'].replace('/', '~')}.json"
                yield cell, join_of(json.loads(recording.read_text()))

    def compare(self, trials):
        found, flights, through, seen = [], 0, 0, {name: 0 for name in MISTAKES}
        for cell, join in self.requests(trials):
            joints, holds = support.support(join)
            found.append(support.longest_unsupported({"join": join}))
            self.assertEqual(found[-1], cell["unsupported_frames"], cell["cell"])
            self.assertEqual(support.supported({"join": join}), cell["supported_share"], cell["cell"])
            for name, measure in (("balance_cm", support.balance), ("settle_s", transition.settle)):
                self.assertAlmostEqual(measure({"join": join}), cell[name], 9, cell["cell"])
            flights += any(held and not own for own, held in zip(joints, holds))
            through += bool(join["between"])
            for name, value in MISTAKES.items():
                with unittest.mock.patch.object(support, name, value):
                    seen[name] += support.longest_unsupported({"join": join}) != found[-1]
        floats = sum(run >= support.FLOATING_FRAMES for run in found)
        self.assertGreater(len(found), 4 * trials)
        self.assertGreater(floats, trials / 4, "fades that float are in it")
        self.assertLess(floats, len(found) / 2)
        self.assertGreater(flights, 0, "jumps are in it")
        self.assertGreater(through, 0, "clips on the way are in it")
        for name, requests in seen.items():
            self.assertGreater(requests, 0, f"a wrong {name} would be seen")

    @heavy
    def test_a_second_program_finds_the_same_requests_supported(self):
        self.compare(trials=6)

    @heavy
    def test_of_many_requests_too(self):
        self.compare(trials=150)


if __name__ == "__main__":
    unittest.main()

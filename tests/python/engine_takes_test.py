"""The engine's arrays of whole takes: transitions, silhouettes, sensors, the coach; and all of it beside C++, to the last bit."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = pathlib.Path(os.environ["ETUDE_ENGINE"])  # the folder of the module
if not list(BUILT.glob("etude_engine*.so")):
    print("skipped: this build has no module etude_engine (ETUDE_SANITIZE)")
    sys.exit(0)
sys.path[:0] = [str(BUILT), str(ROOT / "python")]
import etude.engine as engine  # noqa: E402

DANCE, MOVES = engine.builtin_dance("groove")
DANCED = DANCE.motion.positions_m


def rectangle(height, width, rows, columns):
    mask = np.zeros((height, width), bool)
    mask[slice(*rows), slice(*columns)] = True
    return mask


def two_cameras(width, height, focal):
    cameras = [engine.Camera(), engine.Camera()]
    for camera in cameras:
        camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy = width, height, focal, focal, width / 2, height / 2
    cameras[0].R_CW, cameras[0].p_WC = [[1, 0, 0], [0, -1, 0], [0, 0, -1]], [0, 1, 4]
    cameras[1].R_CW, cameras[1].p_WC = [[0, 0, -1], [0, -1, 0], [-1, 0, 0]], [4, 1, 0]
    return cameras


class BesideCpp(unittest.TestCase):
    def test_every_answer_is_that_of_cpp_to_the_last_bit(self):
        said = subprocess.run([os.environ["ETUDE_ANSWERS"]], capture_output=True, text=True, check=True).stdout
        told = {name: np.array([float.fromhex(number) for number in numbers])
                for name, *numbers in map(str.split, said.splitlines())}
        body, fraction = engine.Kinematics(), 0.5

        def draw(lower, upper, share):
            nonlocal fraction
            fraction += 0.6180339887498949
            fraction -= int(fraction)
            return (lower + upper) / 2 + share * (fraction - 0.5) * (upper - lower)

        wanted, starts = np.zeros((20, body.dofs)), np.zeros((20, body.dofs))
        for i in range(20):
            for k, (lower, upper) in enumerate(body.tree.limits):
                wanted[i, k], starts[i, k] = draw(lower, upper, 0.6), draw(lower, upper, 0.1)
        places, axes = body.effectors(wanted)
        start = engine.Motion(DANCED[:100])
        features = engine.features(start)
        library = engine.TransitionLibrary([MOVES[0][1][0], MOVES[1][1][0]])
        coach = engine.Coach(DANCE, MOVES, dances_at_once=True)
        mask = rectangle(60, 80, (12, 48), (35, 45))
        ours = {
            "doubles": body.solve(starts, places, axes).angles,
            "floats": body.solve(starts, places, axes, single_precision=True).angles,
            "features": features,
            "distance": engine.fuzzy_distance(features[0], features[99]),
            "transition": library.make(0, 10, 1).motion.positions_m,
            "sensed": engine.sense(start, seed=3)[0],
            "coach": [coach.step(pose, music_s=0.5).positions_m for pose in DANCED[:100]],
            "outline": engine.outline(mask)[0],
            "silhouettes": engine.track_silhouettes(two_cameras(80, 60, 75), [[mask, mask]] * 2),
        }
        self.assertEqual(set(ours), set(told))
        for name, found in ours.items():
            self.assertGreater(told[name].size, 0)
            np.testing.assert_array_equal(np.ravel(found), told[name], err_msg=name)


# Answers to a data set of task pose-distance, as a person's program would make them.
ANSWERS = """import csv, json, pathlib, sys
sys.path[:0] = sys.argv[3:]
import numpy as np
import etude.engine as engine
data, answers = map(pathlib.Path, sys.argv[1:3])
with open(data / "inputs/index.csv", newline="") as file:
    lines = list(csv.DictReader(file))
for line in lines:
    distances = []
    for pair in json.loads((data / "inputs" / line["problem"]).read_text())["pairs"]:
        a, b = (engine.features(engine.Motion(np.reshape(pair[one], (1, 20, 3))))[0] for one in "ab")
        distances.append(engine.fuzzy_distance(a, b))
    path = answers / line["prediction"]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({"distances": distances, "alike": [distance < 0.4 for distance in distances]}))
"""


class BesideWorkers(unittest.TestCase):
    def test_answers_in_workers_environment_are_workers_to_the_last_bit(self):
        pinned = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}  # bench/process/pinned_environment.cc
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "s.yaml").write_text("scenario: s\nquestion: q\ntask: pose-distance\ntrials: 8\n"
                                           "clips: ['builtin:clap', 'builtin:wave']\nmethods: [{name: ours, distance: fuzzy}]\n")
            for command in ([os.environ["ETUDE"], "export", folder / "s.yaml", "-o", folder / "data"],
                            [sys.executable, "-c", ANSWERS, folder / "data", folder / "answers", BUILT, ROOT / "python"],
                            [os.environ["ETUDE"], "score", folder / "data", folder / "answers", "-o", folder / "out", "--name", "told"]):
                subprocess.run(command, check=True, capture_output=True, env=pinned)
            rows = [json.loads(line) for line in (folder / "out/cells.jsonl").read_text().splitlines()]
        verdicts = {}
        for row in rows:
            verdicts.setdefault(row["trial"], {})[row["method"]] = row["digest_verdict"]  # of every distance, bit by bit
        self.assertEqual(len(verdicts), 8)
        for trial, found in verdicts.items():
            self.assertEqual(found["ours"], found["told"], trial)
        self.assertGreater(len({found["ours"] for found in verdicts.values()}), 4)


class Transitions(unittest.TestCase):
    def test_a_request_becomes_a_motion_that_leaves_one_clip_and_ends_in_the_other(self):
        clips = [MOVES[0][1][0], MOVES[2][1][0]]
        library, jumps = engine.TransitionLibrary(clips), {}
        for join in engine.TRANSITION_JOINS:
            made = library.make(0, 12, 1, choice="motion-matching", join=join)
            shown, first = made.motion.positions_m, clips[0].positions_m
            self.assertEqual(made.motion.rate_hz, 30)
            self.assertGreaterEqual(made.points[0], 12)
            np.testing.assert_allclose(shown[:13] - shown[:13, :1], first[:13] - first[:13, :1], atol=1e-9)
            jumps[join] = np.linalg.norm(np.diff(shown, axis=0), axis=2).max()
            thighs = np.linalg.norm(shown[:, engine.ROLES.index("left_knee")] - shown[:, engine.ROLES.index("left_hip")], axis=1)
            np.testing.assert_allclose(thighs, thighs[0], atol=1e-9)
            self.assertTrue(made.why)
        self.assertEqual(max(jumps, key=jumps.get), "cut", jumps)
        waits = [library.make(0, 12, 1, 1, choice).wait_s for choice in ("now", "wait-for-end")]
        self.assertLess(waits[0], 0.1)
        self.assertAlmostEqual(waits[1], (len(clips[0]) - 12) / 30, delta=0.07)
        told = engine.transition_join_settings("crossfade")
        (key, (fallback, lowest, largest, _)), *_ = told.items()
        ours, same, longest = (library.make(0, 12, 1, choice="motion-matching", join="crossfade", join_settings=settings).motion
                               .positions_m for settings in ({}, {key: fallback}, {key: largest}))
        np.testing.assert_array_equal(ours, same)
        self.assertFalse(np.array_equal(ours, longest))
        with self.assertRaisesRegex(engine.BadInput, f"{key} -1 of 'crossfade'; allowed: {lowest:g} to {largest:g}"):
            library.make(0, 12, 1, join="crossfade", join_settings={key: -1})
        with self.assertRaisesRegex(engine.BadInput, "setting 'speed' of 'now'; allowed: none"):
            library.make(0, 12, 1, choice="now", choice_settings={"speed": 1})
        with self.assertRaisesRegex(engine.BadInput, "choice 'best'; allowed: fuzzy-bridge"):
            library.make(0, 0, 1, choice="best")
        with self.assertRaisesRegex(engine.BadInput, "clip 0: 2 frames at 60 Hz"):
            engine.TransitionLibrary([engine.Motion(DANCED[:2], 60)])


class Silhouettes(unittest.TestCase):
    def test_a_rim_and_its_distances(self):
        mask = rectangle(10, 20, (2, 8), (5, 15))
        distances = engine.signed_distances(mask)
        self.assertEqual((distances.shape, distances.dtype), ((10, 20), np.float32))
        self.assertEqual((distances[2, 5], distances[2, 4], distances[5, 19]), (-0.5, 0.5, 4.5))
        pixels, normals = engine.outline(mask, 1, 0)
        self.assertEqual(pixels.shape, normals.shape)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
        self.assertTrue((np.abs(np.abs(pixels - [10, 5]) - [5, 3]).min(axis=1) < 0.71).all())
        np.testing.assert_array_equal(engine.outline(255 * mask.astype(int), 1, 0)[0], pixels)
        self.assertEqual(engine.outline(~mask & mask)[0].shape, (0, 2))

    def test_a_person_is_followed_by_outlines_alone(self):
        cameras, roles = two_cameras(160, 120, 150), list(engine.ROLES)
        bones = [("left_hip", "left_knee", .08), ("left_knee", "left_ankle", .06), ("hip_centre", "shoulder_centre", .13),
                 ("shoulder_centre", "head", .09), ("left_shoulder", "left_elbow", .05), ("left_elbow", "left_wrist", .045)]
        bones += [tuple(name.replace("left", "right") for name in bone[:2]) + bone[2:] for bone in bones if "left" in bone[0]]
        shown = DANCED[:3]
        films = []
        v, u = np.mgrid[:120, :160] + 0.5
        for camera in cameras:
            film = np.zeros((3, 120, 160), bool)
            for frame, pose in zip(film, shown):
                for a, b, radius in bones:
                    for share in np.linspace(0, 1, 9):
                        centre = (1 - share) * pose[roles.index(a)] + share * pose[roles.index(b)]
                        (x, y), = engine.project(camera, centre[None])
                        size = 150 * radius / np.linalg.norm(centre - camera.p_WC)
                        frame |= (u - x) ** 2 + (v - y) ** 2 < size ** 2
            films.append(film)
        found = engine.track_silhouettes(cameras, films, measured=engine.Motion(shown))
        self.assertEqual(found.shape, (3, 20, 3))
        self.assertLess(np.linalg.norm(found[:, 0] - shown[:, 0], axis=1).max(), 0.08)
        nobody = engine.track_silhouettes(cameras, [np.zeros((2, 60, 80), bool)] * 2)
        self.assertTrue(np.isnan(nobody).all())
        with self.assertRaisesRegex(engine.BadInput, "a mask of 150 x 120 pixels of camera ''; allowed: its 160 x 120"):
            engine.track_silhouettes(cameras, [film[:, :, :150] for film in films])


class SensorAndCoach(unittest.TestCase):
    def test_a_sensor_errs_as_it_is_told_to(self):
        motion = engine.Motion(DANCED[:90])
        exact, states, body_seen = engine.sense(motion, strength=0)
        np.testing.assert_allclose(exact[body_seen], DANCED[:90][body_seen], atol=1e-12)
        self.assertEqual((len(states), len(states[0]), body_seen.dtype), (90, 20, np.dtype(bool)))
        once, again, other = (engine.sense(motion, "v1", seed=seed)[0] for seed in (1, 1, 2))
        np.testing.assert_array_equal(once, again)
        self.assertFalse((once == other).all())
        self.assertGreater(np.linalg.norm(once - DANCED[:90], axis=2).mean(), 0.01)
        with self.assertRaisesRegex(engine.BadInput, "sensor:1:"):
            engine.sense(motion, "reach_m: 3")

    def test_a_coach_corrects_who_stands_still_and_not_who_dances(self):
        heard = {}
        for name, player in (("dances", DANCED), ("stands", np.repeat(DANCED[:1], len(DANCED), axis=0))):
            coach = engine.Coach(DANCE, MOVES, dances_at_once=True, right_from=0.2)
            frames = [coach.step(pose, music_s=i / 30) for i, pose in enumerate(player[:600])]
            heard[name] = [decision.event for frame in frames for decision in frame.decisions]
            self.assertEqual(frames[0].positions_m.shape, (20, 3))
        self.assertIn("right", heard["dances"])
        self.assertNotIn("right", heard["stands"])
        self.assertIn("corrects", heard["stands"])
        self.assertEqual({name for name, _, _ in DANCE.acts}, set(engine.COACH_ACTS))
        copy = engine.Dance(DANCE.title, DANCE.motion, DANCE.moves, DANCE.repetitions, DANCE.tags, DANCE.acts)
        self.assertEqual(engine.Coach(copy, MOVES).step(DANCED[0]).mode, "standby")
        with self.assertRaisesRegex(engine.BadInput, "lacks the act"):
            engine.Coach(engine.Dance("x", DANCE.motion, DANCE.moves, DANCE.repetitions, [], []), MOVES)
        with self.assertRaisesRegex(engine.BadInput, "policy 'oracle'"):
            engine.Coach(DANCE, MOVES, "oracle")

    def test_the_interpreter_is_free_meanwhile(self):
        # No thread is made to wait but by what lets the interpreter go: then only a call that does lets the other one count.
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(60)
        clips, zeros = [motion for _, (motion,) in MOVES], np.zeros((4000, 29))
        places, axes = engine.Kinematics().effectors(zeros + 0.1)
        for name, call in (("dance", lambda: engine.builtin_dance("groove")), ("library", lambda: engine.TransitionLibrary(clips)),
                           ("solve", lambda: engine.Kinematics().solve(zeros, places, axes)), ("none", lambda: None)):
            counted, told = 0, []

            def work():
                before = counted
                for _ in range(1000):  # a busy machine may be back from a short call before the other thread runs
                    call()
                    if counted > before:
                        break
                told.append(counted - before)

            worker = threading.Thread(target=work)
            worker.start()
            while worker.is_alive():
                counted += 1
                time.sleep(0)
            self.assertEqual(told[0] > 0, name != "none", name)


if __name__ == "__main__":
    unittest.main()

"""Tests the engine's functions on arrays of whole takes: transitions, silhouettes, sensors, the coach. All results
equal those of C++ to the last bit."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = pathlib.Path(os.environ["ETUDE_ENGINE"])  # the folder of the module
if not list(BUILT.glob("etude_engine*.so")):
    print("skipped: this build has no module etude_engine (ETUDE_SANITIZE)")
    sys.exit(0)
sys.path[:0] = [str(BUILT), str(ROOT / "python")]
import etude  # noqa: E402
import etude.engine as engine  # noqa: E402
from etude.engine import Kinematics, adult_body  # noqa: E402

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


def asked(problem):
    return ([np.radians(problem.start_angles_deg)], [[each.position_m for each in problem.targets]],
            [[each.rotation for each in problem.targets]], None, None, [problem.root.position_m], [problem.root.rotation])


def told(solved):
    return etude.IkAnswer(np.degrees(solved.angles[0]), iterations=int(solved.iterations[0]))


@etude.method(task="ik")
def by_module(problem):
    return told(engine.Kinematics().solve(*asked(problem)))


@etude.method(task="ik")
def by_name(problem):
    return told(Kinematics(adult_body()).solve(*asked(problem)))


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


# Solves exported problems with the engine. For each problem, prints a line with the trial and the digest of the
# answer's numbers, as in a cell's row.
ANSWERS = """import csv, ctypes, json, pathlib, sys
sys.path[:0] = sys.argv[3:]
import numpy as np
import etude.engine as engine
xxh3 = ctypes.CDLL("libxxhash.so.0").XXH3_64bits
xxh3.restype, xxh3.argtypes = ctypes.c_uint64, [ctypes.c_char_p, ctypes.c_size_t]
data = pathlib.Path(sys.argv[1]) / "inputs"

def pose_distance(setting, problem):
    distances = [engine.fuzzy_distance(*(engine.features(engine.Motion(np.reshape(pair[one], (1, 20, 3))))[0] for one in "ab"))
                 for pair in problem["pairs"]]
    return np.array(distances).tobytes() + np.array([distance < 0.4 for distance in distances], np.int64).tobytes()

def ik(setting, problem, body=engine.Kinematics()):
    targets, root = problem["targets"], problem["root"]
    solved = body.solve([body.tree.limits.mean(axis=1)], [[each["position_m"] for each in targets]],
                        [[each["rotation"] for each in targets]], root_positions_m=[root["position_m"]], root_axes=[root["rotation"]])
    return solved.angles.tobytes() + solved.iterations.astype(np.int64).tobytes()

def transition(setting, problem, libraries={}):
    names = tuple(clip["name"] for clip in setting["clips"])
    if names not in libraries:
        clips = [engine.read_motion(pathlib.Path(sys.argv[2]) / f"{name}.bvh") for name in names]
        libraries[names] = engine.TransitionLibrary(clips, engine.scenario_proportions())
    made = libraries[names].make(problem["from"], problem["request_frame"], problem["to"], problem["max_wait_s"])
    return made.motion.positions_m.tobytes()

for line in csv.DictReader(open(data / "index.csv", newline="")):
    problem = data / line["problem"]
    told = [json.loads(path.read_text()) for path in (problem.parents[1] / "setting.json", problem)]
    answer = globals()[line["task"].replace("-", "_")](*told)
    print(line["trial"], f"{xxh3(answer, len(answer)):016x}")
"""


class BesideWorkers(unittest.TestCase):
    """A cell's row and the Python interface give the same answer to the same problem, bit by bit."""

    def digests(self, task, digest, method, **keys):
        """Returns digests by trial: those of one method's cells, and those of Python's answers in the workers'
        environment."""
        pinned = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}  # io/process/pinned_environment.cc
        etude = os.environ["ETUDE"]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)

            def call(*words):
                done = subprocess.run(words, capture_output=True, text=True, env=pinned, cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                return done.stdout

            for clip in ("clap", "boxing", "wave"):
                call(etude, "clip", "convert", f"builtin:{clip}", f"{clip}.bvh")
            (folder / "s.yaml").write_text(json.dumps({"scenario": "s", "question": "q", "task": task, "trials": 12, **keys,
                                                       "methods": [{"name": "ours", **method}]}))
            call(etude, "run", "s.yaml", "-o", "run")
            call(etude, "export", "s.yaml", "-o", "data")
            rows = map(json.loads, (folder / "run/cells.jsonl").read_text().splitlines())
            told = call(sys.executable, "-c", ANSWERS, "data", folder, BUILT, ROOT / "python")
            return {row["trial"]: row[digest] for row in rows}, {int(trial): of for trial, of in map(str.split, told.splitlines())}

    def same(self, *asked, **keys):
        ours, told = self.digests(*asked, **keys)
        self.assertEqual(ours, told)
        self.assertEqual(len(ours), 12)
        self.assertGreater(len(set(ours.values())), 4)

    def test_distances(self):
        self.same("pose-distance", "digest_verdict", {"distance": "fuzzy"}, clips=["clap.bvh", "wave.bvh"])

    def test_inverse_kinematics(self):  # angles in degrees would be rounded, so all start mid-range
        self.same("ik", "digest_solution", {"solver": "gauss-newton"}, start="middle")

    def test_a_request_becomes_the_motion_that_is_judged(self):
        self.same("transition", "digest_motion", {"choice": "played", "join": "planted-feet"},
                  clips=["clap.bvh", "boxing.bvh", "wave.bvh"])


class Sent(unittest.TestCase):
    def test_a_method_with_the_engine_in_it_is_sent_to_the_fence(self):
        with tempfile.TemporaryDirectory() as name, mock.patch.dict(os.environ, {"XDG_CACHE_HOME": name}):
            for method in by_module, by_name:
                run = etude.run("quick/ik", methods=[method], trials=2, output=f"{name}/{method.__name__}", progress=False)
                own, ours = ([cells[id_] for id_ in ("status", "iterations")] for cells in (
                    run["ik-weights"].where(method=method.__etude__.name), run["ik-weights"].where(method="gauss-newton")))
                self.assertEqual([list(each) for each in own], [list(each) for each in ours])


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
        with self.assertRaisesRegex(engine.BadInput, f"setting '{key}' is -1 for method 'crossfade'; allowed: {lowest:g} to {largest:g}"):
            library.make(0, 12, 1, join="crossfade", join_settings={key: -1})
        with self.assertRaisesRegex(engine.BadInput, "setting 'speed' of 'now'; allowed: none"):
            library.make(0, 12, 1, choice="now", choice_settings={"speed": 1})
        thigh = [engine.ROLES.index(name) for name in ("left_hip", "left_knee")]
        pose, height = engine.scenario_proportions()
        lengths = [np.linalg.norm(np.subtract(*engine.TransitionLibrary(clips, (pose, high)).make(0, 12, 1).motion.positions_m[0, thigh]))
                   for high in (height, 2 * height)]
        self.assertAlmostEqual(lengths[1] / lengths[0], 2)
        self.assertEqual(height, 0.9)
        with self.assertRaisesRegex(engine.BadInput, "the hips are 0.01 m high; allowed: 0.1 to 10 m"):
            engine.TransitionLibrary(clips, (pose, 0.01))
        with self.assertRaisesRegex(engine.BadInput, "a body without legs"):
            engine.TransitionLibrary(clips, (0 * pose, 0.9))
        with self.assertRaisesRegex(engine.BadInput, "choice 'best'; allowed: fuzzy-bridge"):
            library.make(0, 0, 1, choice="best")
        with self.assertRaisesRegex(engine.BadInput, "clip 0 has 2 frames at 60 Hz"):
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

    def test_measured_bodies_nobody_and_masks_of_another_size(self):
        cameras, masks = two_cameras(80, 60, 75), [rectangle(60, 80, (12, 48), (35, 45))[None]] * 2
        ours, measured = (engine.track_silhouettes(cameras, masks, **more) for more in ({}, {"measured": engine.Motion(DANCED[:1])}))
        self.assertEqual(measured.shape, (1, 20, 3))
        self.assertFalse(np.array_equal(ours, measured))
        thighs = [np.linalg.norm(np.subtract(*pose[0, [engine.ROLES.index("left_hip"), engine.ROLES.index("left_knee")]]))
                  for pose in (DANCED[:1], measured)]
        self.assertAlmostEqual(thighs[1], thighs[0], places=6)
        self.assertTrue(np.isnan(engine.track_silhouettes(cameras, [np.zeros((2, 60, 80), bool)] * 2)).all())
        with self.assertRaisesRegex(engine.BadInput, "the mask for camera '' has 70 x 60 pixels; allowed: 80 x 60"):
            engine.track_silhouettes(cameras, [mask[:, :, :70] for mask in masks])


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
        # With a switch interval of 60 s, the other thread counts only during calls that release the interpreter.
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(60)
        clips, zeros = [motion for _, (motion,) in MOVES], np.zeros((4000, 29))
        places, axes = engine.Kinematics().effectors(zeros + 0.1)
        for name, call in (("dance", lambda: engine.builtin_dance("groove")), ("library", lambda: engine.TransitionLibrary(clips)),
                           ("solve", lambda: engine.Kinematics().solve(zeros, places, axes)), ("none", lambda: None)):
            counted, told = 0, []

            def work():
                before = counted
                for _ in range(1000):  # on a busy machine a short call may end before the other thread runs
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

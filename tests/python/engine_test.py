"""Tests the engine on arrays: against numpy's arithmetic, against single calls, and with invalid inputs."""
import ast
import os
import pathlib
import random
import sys
import time
import unittest
import warnings

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = pathlib.Path(os.environ["ETUDE_ENGINE"])  # the folder of the module
if not list(BUILT.glob("etude_engine*.so")):
    print("skipped: this build has no module etude_engine (ETUDE_SANITIZE)")
    sys.exit(0)
sys.path[:0] = [str(BUILT), str(ROOT / "python")]
import etude.engine as engine  # noqa: E402

FUZZ_S = float(os.environ.get("ETUDE_FUZZ_SECONDS", "1"))
BODY = engine.Kinematics()


def turn(axis, angle):
    c, s, (j, k) = np.cos(angle), np.sin(angle), ((axis + 1) % 3, (axis + 2) % 3)
    matrix = np.eye(3)
    matrix[j, j], matrix[j, k], matrix[k, j], matrix[k, k] = c, -s, s, c
    return matrix


def limbs_of(tree, angles, root=np.zeros(3), axes=np.eye(3)):
    """Returns positions and axes of one pose's limbs, by numpy."""
    found, used = [], 0
    for limb in tree.limbs:
        place, turned = found[limb.parent] if limb.parent >= 0 else (root, axes)
        place, turned = place + turned @ limb.offset_m, turned @ limb.rest
        for axis in range(limb.dofs):
            turned = turned @ turn(axis, angles[used])
            used += 1
        found.append((place, turned))
    return found


def within_limits(dice, count, share=0.6):
    limits = BODY.tree.limits
    middle, half = limits.mean(axis=1), share * (limits[:, 1] - limits[:, 0]) / 2
    return middle + half * dice.uniform(-1, 1, (count, BODY.dofs))


def rig():
    front, left = engine.Camera(), engine.Camera()
    front.R_CW, front.p_WC = [[1, 0, 0], [0, -1, 0], [0, 0, -1]], [0, 1, 4]
    left.R_CW, left.p_WC = [[0, 0, -1], [0, -1, 0], [-1, 0, 0]], [4, 1, 0]
    return [front, left]


def standing():
    """Returns a person with the arms out, in the order of ROLES."""
    places = {"hip_centre": (0, .95, 0), "spine": (0, 1.1, 0), "shoulder_centre": (0, 1.4, 0), "head": (0, 1.6, 0)}
    for side, x in (("left", 1), ("right", -1)):
        for name, out, y, z in (("shoulder", .2, 1.38, 0), ("elbow", .48, 1.38, -.02), ("wrist", .73, 1.38, 0),
                                ("hand", .82, 1.38, 0), ("hip", .1, .9, 0), ("knee", .1, .48, .02), ("ankle", .1, .08, 0),
                                ("foot", .1, .02, .15)):
            places[f"{side}_{name}"] = (x * out, y, z)
    return np.array([places[role] for role in engine.ROLES])


class Kinematics(unittest.TestCase):
    def test_limbs_are_where_numpy_has_them(self):
        dice = np.random.default_rng(1)
        angles = within_limits(dice, 5)
        root, axes = np.array([1.0, 2, 3]), turn(1, 0.7)
        places, turns = BODY.limbs(angles, root, axes)
        self.assertEqual(places.shape, (5, len(BODY.tree.limbs), 3))
        for i in range(5):
            for k, (place, turned) in enumerate(limbs_of(BODY.tree, angles[i], root, axes)):
                np.testing.assert_allclose(places[i, k], place, atol=1e-12)
                np.testing.assert_allclose(turns[i, k], turned, atol=1e-12)

    def test_positions_alone_and_roots_of_their_own(self):
        dice = np.random.default_rng(4)
        wanted, roots = within_limits(dice, 20), dice.normal(size=(20, 3))
        places, _ = BODY.effectors(wanted, roots)
        solved = BODY.solve(within_limits(dice, 20, 0.1), places, root_positions_m=roots)
        found, _ = BODY.effectors(solved.angles, roots)
        self.assertLess(np.median(np.linalg.norm(found - places, axis=2)), 0.001)

    def test_lists_other_types_and_views_are_the_same_arrays(self):
        dice = np.random.default_rng(5)
        places, axes = BODY.effectors(within_limits(dice, 8))
        starts = np.zeros((8, BODY.dofs))
        plain = BODY.solve(starts, places, axes).angles
        np.testing.assert_array_equal(BODY.solve(starts.astype(int).tolist(), places.tolist(), axes).angles, plain)
        np.testing.assert_array_equal(BODY.solve(np.asfortranarray(starts), places[::-1][::-1], axes).angles, plain)

    def test_a_chain_of_ones_own(self):
        arm = engine.Tree([engine.Limb("base", -1, [0, 0, 0], 0), engine.Limb("upper", 0, [0, 0, 0], 3),
                           engine.Limb("lower", 1, [1, 0, 0], 3)], [engine.Effector("tip", 2, [1, 0, 0])], [[-3, 3]] * 6)
        solved = engine.Kinematics(arm).solve(np.full((1, 6), 0.1), [[[0.5, 1.0, 0.2]]])
        self.assertEqual(engine.STATUSES[solved.statuses[0]], "converged")
        place, turned = limbs_of(arm, solved.angles[0])[2]
        np.testing.assert_allclose(place + turned @ [1, 0, 0], [0.5, 1.0, 0.2], atol=0.001)

    def test_what_is_not_finite_is_that_problems_alone(self):
        places, axes = BODY.effectors(np.zeros((3, BODY.dofs)))
        places[1, 2, 0] = np.nan
        statuses = [engine.STATUSES[each] for each in BODY.solve(np.zeros((3, BODY.dofs)), places, axes).statuses]
        self.assertEqual([each == "bad_input" for each in statuses], [False, True, False])

    def test_shapes_are_told(self):
        with self.assertRaisesRegex(engine.BadInput, r"start_angles: has the shape \(3, 28\), allowed: \(any, 29\)"):
            BODY.solve(np.zeros((3, 28)), np.zeros((3, 4, 3)))
        self.assertEqual(BODY.solve(np.zeros((0, 29)), np.zeros((0, 4, 3))).angles.shape, (0, 29))


class Motions(unittest.TestCase):
    def test_features_and_distances(self):
        still = np.repeat(standing()[None], 30, axis=0)
        motion = engine.Motion(still, 30)
        np.testing.assert_array_equal(motion.positions_m, still)
        features = engine.features(motion)
        self.assertEqual(features.shape, (30, len(engine.FEATURES)))
        self.assertAlmostEqual(features[0, list(engine.FEATURES).index("Posture")], 80, delta=10)
        self.assertEqual(engine.fuzzy_distance(features[0], features[1]), 0)
        with self.assertRaisesRegex(engine.BadInput, "positions_m: value 7 is not finite"):
            broken = still.copy()
            broken.flat[7] = np.inf
            engine.Motion(broken)

    def test_what_is_masked_is_not_finite(self):
        still = np.ma.masked_array(np.repeat(standing()[None], 3, axis=0), mask=False)
        np.testing.assert_array_equal(engine.Motion(still).positions_m, still.data)
        still[1, 4, 2] = np.ma.masked
        for masked in (still, still.astype(np.float32), list(still), tuple(still), [still.data[0], *still[1:]]):
            with self.assertRaisesRegex(engine.BadInput, "positions_m: value 74 is not finite"):
                engine.Motion(masked)

    def test_a_body_in_another_unit_is_refused(self):
        for scale, unit in ((100, "centimetres"), (1000, "millimetres")):
            with self.assertRaisesRegex(engine.BadInput, f"the positions seem to be in {unit}"):
                engine.Motion(scale * np.repeat(standing()[None], 3, axis=0))
        for scale in (0.5, 1.2):
            engine.Motion(scale * np.repeat(standing()[None], 3, axis=0))

    def test_bridges(self):
        still = engine.Motion(np.repeat(standing()[None], 60, axis=0), 30)
        bridges = engine.Bridges([still, still])
        np.testing.assert_array_equal(bridges.frames(0), range(60))  # the pose is constant, so every frame is shared
        self.assertEqual(bridges.find(0, 5, 1), (5, 0, 0.0))
        with self.assertRaises(engine.BadInput):
            bridges.find(0, 0, 7)
        with self.assertRaises(engine.BadInput):
            engine.Bridges([])

    def test_a_file_that_is_not_there(self):
        with self.assertRaisesRegex(engine.BadInput, "nowhere.bvh"):
            engine.read_motion("nowhere.bvh")


class Cameras(unittest.TestCase):
    def test_what_is_projected_is_triangulated_and_calibrates(self):
        points = np.array([[i % 3 - 1, i // 3 % 3, i // 9 - 1] for i in range(27)], float)
        pixels = np.stack([engine.project(camera, points) for camera in rig()])
        places, residuals = engine.triangulate(rig(), pixels)
        np.testing.assert_allclose(places, points, atol=1e-9)
        self.assertLess(residuals.max(), 1e-6)
        pixels[0, 5] = np.nan
        self.assertTrue(np.isnan(engine.triangulate(rig(), pixels)[0][5]).all())
        camera, rms_px = engine.calibrate(points, engine.project(rig()[0], points), 640, 480)
        self.assertLess(rms_px, 1e-3)
        self.assertAlmostEqual(camera.fx, 600, places=2)
        np.testing.assert_allclose(camera.p_WC, [0, 1, 4], atol=1e-4)

    def test_keypoints_become_a_motion(self):
        truth = np.repeat(standing()[None], 20, axis=0) + np.linspace(0, 0.3, 20)[:, None, None]
        roles = list(engine.ROLES)
        coco = ["head"] + [f"{side}_{name}" for name in ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")
                           for side in ("left", "right")]
        seen = []
        for camera in rig():
            frames = np.full((20, 1, 17, 3), np.nan)
            for at, role in zip([0, *range(5, 17)], coco):
                frames[:, 0, at, :2] = engine.project(camera, truth[:, roles.index(role)])
                frames[:, 0, at, 2] = 1
            seen.append(list(frames))
        found = engine.capture(rig(), seen, rate_hz=30)
        knee = roles.index("left_knee")
        self.assertLess(np.linalg.norm(found.motion.positions_m[:, knee] - truth[:, knee], axis=1).max(), 0.005)
        self.assertIn("HIERARCHY", found.bvh)


def wave(turns, frames=40):
    """Returns a right hand that circles `turns` times."""
    poses = np.repeat(standing()[None], frames, axis=0)
    at = 2 * np.pi * turns * np.arange(frames) / frames
    for role, radius in (("right_wrist", .2), ("right_hand", .28)):
        poses[:, engine.ROLES.index(role), 1] += radius * np.sin(at)
        poses[:, engine.ROLES.index(role), 2] += radius * (1 - np.cos(at))
    return poses


class Streams(unittest.TestCase):
    def test_a_recogniser_tells_the_move_that_it_was_taught(self):
        moves = [("once", [engine.Motion(wave(1))]), ("thrice", [engine.Motion(wave(3))])]
        for kind in ("whole-body", "dtw", "nearest"):
            taught = engine.Recogniser(moves, kind)
            likeness = {}
            for name, turns in (("once", 1), ("thrice", 3)):
                for asked in (0, 1):
                    stream = taught.follow()
                    stream.ask(asked)
                    told = [stream.update(pose) for pose in wave(turns)]
                    self.assertEqual([each[1].shape for each in told], [(2,)] * 40)
                    self.assertTrue(all(0 <= each[0] <= 1 for each in told))
                    self.assertEqual([each[0] for each in told], sorted(each[0] for each in told))
                    likeness[name, asked] = told[-1][0]
            self.assertGreater(likeness["once", 0], likeness["thrice", 0], kind)
            self.assertGreater(likeness["thrice", 1], likeness["once", 1], kind)
        again = taught.follow()
        again.ask(0)
        unseen = [again.update(pose, "n" * 20, False) for pose in wave(1)]
        self.assertLess(unseen[-1][0], likeness["once", 0])

    def test_the_person_is_what_changed(self):
        room = np.full((60, 80, 3), 120, np.uint8)
        picture = room.copy()
        picture[10:50, 30:45] = (200, 40, 40)
        finder = engine.PersonFinder(room, "rgb")
        mask = finder.find(picture)
        self.assertEqual((mask.dtype, mask.shape), (np.dtype(bool), (60, 80)))
        self.assertTrue((mask == (picture != room).any(axis=2)).all())
        picture[55:57, 2:4] = 0  # noise beside the person
        self.assertTrue((finder.find(picture) == mask).all())
        self.assertFalse(engine.PersonFinder(room).find(room).any())
        wide = np.zeros((60, 160, 3), np.uint8)
        wide[:, ::2] = picture
        self.assertTrue((finder.find(wide[:, ::2]) == mask).all())  # a view of the array
        for bad, says in ((lambda: finder.find(picture[:50]), "allowed: .60, 80, 3."),
                          (lambda: engine.PersonFinder(room, "magic"), "no segmenter 'magic'; allowed: rgb, "),
                          (lambda: engine.PersonFinder(np.zeros((0, 4, 3), np.uint8)), "a side of 0 pixels"),
                          (lambda: engine.Recogniser([]), "no moves"),
                          (lambda: engine.Recogniser([("a", [])]), "a"),
                          (lambda: engine.Recogniser([("a", [engine.Motion(wave(1))])], "key-pose"), "whole-body, dtw"),
                          (lambda: engine.Recogniser([("a", [engine.Motion(wave(1))])]).follow(0), "0 Hz"),
                          (lambda: engine.Recogniser([("a", [engine.Motion(wave(1))])]).follow().ask(1), "move 1; allowed: 0")):
            with self.assertRaisesRegex(engine.BadInput, says):
                bad()


class Stub(unittest.TestCase):
    def test_the_stub_knows_every_name_and_no_other(self):
        stub = ast.parse((ROOT / "python/engine/etude_engine.pyi").read_text())
        told = {}
        for node in stub.body:
            name = getattr(node, "name", None) or getattr(getattr(node, "target", None), "id", None)
            if name:
                told[name] = {getattr(each, "name", None) or each.target.id for each in getattr(node, "body", [])
                              if isinstance(each, (ast.FunctionDef, ast.AnnAssign))} if isinstance(node, ast.ClassDef) else None
        import etude_engine
        self.assertEqual({name for name in dir(etude_engine) if not name.startswith("__")} | {"__version__"}, set(told))
        for name, inside in told.items():
            if inside is not None and name != "BadInput":
                found = {each for each in vars(getattr(etude_engine, name)) if not each.startswith("_")}
                self.assertEqual(found, {each for each in inside if not each.startswith("_")}, name)


class Limits(unittest.TestCase):
    def test_what_is_just_beyond_each_limit_is_refused_and_what_is_just_within_is_taken(self):
        mask, room, one = np.ones((3, 4), bool), np.zeros((1, 8193, 3), np.uint8), np.zeros((1, 29))
        circle = engine.Tree([engine.Limb("a", -1, [0, 0, 0], 0), engine.Limb("b", 2, [1, 0, 0], 1),
                              engine.Limb("c", 1, [1, 0, 0], 1)], [engine.Effector("tip", 2, [1, 0, 0])], [[-1, 1]] * 2)
        for says, within, beyond in (
                ("allowed: 1 to 1000, 0 to 100", ((mask, 1, 0), (mask, 1000, 100)), ((mask, 0), (mask, 1001), (mask, 3, -.1), (mask, 3, 101))),
                ("the mask has .* allowed: 1 to 8192 pixels on each side", ((np.ones((1, 8192), bool),), (np.ones((8192, 1), bool),)),
                 ((np.ones((0, 1), bool),), (np.ones((1, 8193), bool),), (np.ones((8193, 1), bool),)))):
            for arguments in within:
                engine.outline(*arguments)
            for arguments in beyond:
                with self.assertRaisesRegex(engine.BadInput, says):
                    engine.outline(*arguments)
        engine.PersonFinder(room[:, 1:])
        engine.Kinematics(None, 1, 0.1, 0.1, 1.0)
        for says, call in (
                ("a side of 8193 pixels", lambda: engine.PersonFinder(room)),
                ("iteration limit", lambda: engine.Kinematics(None, 0)),
                ("tolerance is negative", lambda: engine.Kinematics(None, 1, 0.1, 0.1, -1.0)),
                ("do not form a tree", lambda: engine.Kinematics(circle)),
                (r"target_positions_m: .* allowed: \(1, 4, 3\)", lambda: BODY.solve(one, np.zeros((1, 5, 3)))),
                (r"root_axes: .* allowed: \(1, 3, 3\)", lambda: BODY.limbs(one, root_axes=np.zeros((2, 3, 3)))),
                ("root_positions_m: value 0 is not finite", lambda: BODY.limbs(one, [np.nan, 0, 0])),
                ("3 keypoints; allowed: those of layout coco, 17", lambda: engine.capture(rig(), [[np.zeros((1, 3, 3))]] * 2)),
                ("layout 'cocoa'; allowed: coco, ", lambda: engine.capture(rig(), [[np.zeros((1, 3, 3))]] * 2, "cocoa"))):
            with self.assertRaisesRegex(engine.BadInput, says):
                call()


class Fuzz(unittest.TestCase):
    def test_nothing_that_is_handed_over_is_more_than_an_exception(self):
        warnings.simplefilter("ignore")  # numpy's warning about complex numbers made real
        dice, end, calls, refused = random.Random(1), time.monotonic() + FUZZ_S, 0, 0
        numbers = np.random.default_rng(1)

        def shape(rank):
            return tuple(dice.choice([0, 1, 2, 3, 4, 10, 17, 20, 29]) for _ in range(rank))

        def anything(likely=None):
            kind = dice.randrange(10)
            if kind < 4 and likely:
                value = numbers.normal(size=likely)
            elif kind < 7:
                value = numbers.normal(size=shape(dice.randrange(5)))
            else:
                return dice.choice([None, "x", 3, [], [[1], [1, 2]], {}, object(), np.array(["a"]), np.array(None),
                                    np.broadcast_to(np.float64(1), (1 << 40, 29)), float("nan")])
            change = dice.randrange(6)
            if change == 0 and value.size:
                value.flat[dice.randrange(value.size)] = dice.choice([np.nan, np.inf, 1e308])
            elif change == 1:
                value = value[..., ::-1] if value.ndim else value
            elif change == 2:
                value = value.astype(dice.choice([np.float32, np.int8, np.complex128, bool, object]))
            elif change == 3:
                value = value.T
            return value

        frames = [np.zeros((1, 17, 3))] * 3
        dance, moves = engine.builtin_dance("groove")

        def some_dance():
            clip = engine.Motion(dance.motion.positions_m[:dice.choice([1, 5, 90])])
            some = engine.Motion(numbers.normal(size=(dice.choice([2, 9]), 20, 3)))
            return engine.Dance("x", dice.choice([clip, some]), [("a", "", anything((20, 3)), dice.choice([clip, some]))],
                                [(dice.randrange(-1, 2), dice.randrange(3), dice.randrange(6))],
                                [(dice.randrange(9), dice.choice([0.5, float("nan")]))][:dice.randrange(2)],
                                [(name, dice.choice([clip, some]), False) for name in engine.COACH_ACTS])

        coach = engine.Coach(dance, moves, dances_at_once=True)
        small = rig()[:2]
        for camera in small:
            camera.width, camera.height = 4, 3
        targets = {
            "transition": lambda: engine.TransitionLibrary(
                [engine.Motion(numbers.normal(size=(9, 20, 3))), engine.Motion(anything((5, 20, 3)))],
                dice.choice([None, (anything((20, 3)), dice.choice([0.9, 0, float("nan")]))])).make(
                    dice.randrange(-1, 3), dice.randrange(-1, 9), dice.randrange(-1, 3), dice.choice([0, 1, float("nan")]),
                    dice.choice([*engine.TRANSITION_CHOICES, "?"]), dice.choice([*engine.TRANSITION_JOINS, "?"]),
                    dice.choice([0.4, 7, float("nan")])),
            "outline": lambda: engine.outline(anything((5, 6)), dice.choice([0, 1, 3]), dice.choice([0, 1, float("nan")])),
            "distances": lambda: engine.signed_distances(anything((5, 6))),
            "silhouettes": lambda: engine.track_silhouettes(small, [anything((2, 3, 4)), np.ones((2, 3, 4))],
                                                            dice.choice([1.7, 9]), dice.choice([None, engine.Motion(
                                                                numbers.normal(size=(2, 20, 3)))]), dice.choice([30, 0])),
            "sense": lambda: engine.sense(engine.Motion(anything((9, 20, 3)), dice.choice([30, 999])), dice.choice(["v1", "v2", "?"]),
                                          dice.choice([0, 1, -1, float("nan")]), dice.choice([2.75, 0, float("inf")]),
                                          dice.choice([0, 1e9, float("nan")]), 1, dice.choice([1, -1, 1 << 70])),
            "coach": lambda: engine.Coach(some_dance(), [("a", [engine.Motion(anything((5, 20, 3)))])],
                                          dances_at_once=True).step(anything((20, 3))),
            "step": lambda: coach.step(anything((20, 3)), dice.choice(["", "t" * 20, "q" * 20]), dice.random() < .5,
                                       dice.choice([None, 1, -1, float("nan")])),
            "solve": lambda: BODY.solve(anything((2, 29)), anything((2, 4, 3)), anything((2, 4, 3, 3)), anything((4,)),
                                        anything((4, 3)), anything((2, 3)), anything((3, 3))),
            "limbs": lambda: BODY.limbs(anything((2, 29)), anything((3,)), anything((3, 3))),
            "tree": lambda: engine.Kinematics(engine.Tree([engine.Limb("a", dice.randrange(-2, 4), anything((3,)),
                                                                       dice.randrange(-1, 5)) for _ in range(3)],
                                                          [engine.Effector("e", dice.randrange(-2, 5), anything((3,)))],
                                                          anything((3, 2)))),
            "motion": lambda: engine.features(engine.Motion(anything((3, 20, 3)), dice.choice([30, 0, float("nan"), 1e9]))),
            "distance": lambda: engine.fuzzy_distance(anything((10,)), anything((10,))),
            "bridges": lambda: engine.Bridges([engine.Motion(numbers.normal(size=(4, 20, 3)))], dice.randrange(-1, 3),
                                              dice.choice([0.4, -1, float("nan")])).find(dice.randrange(-1, 3),
                                                                                       dice.randrange(-9, 9), 0, 1e9),
            "finder": lambda: engine.PersonFinder(anything((4, 5, 3)), dice.choice(["rgb", "hue", "running", "?"]),
                                                  dice.random() < .5).find(anything((4, 5, 3))),
            "recogniser": lambda: engine.Recogniser(
                [("a", [engine.Motion(anything((3, 20, 3)))]), (dice.choice("ab"), [engine.Motion(numbers.normal(size=(4, 20, 3)))])],
                dice.choice(["dtw", "nearest", "whole-body", "?"])).follow(dice.choice([30, 0, 1e9])).update(
                    anything((20, 3)), dice.choice(["", "t" * 20, "q" * 20]), dice.random() < .5),
            "project": lambda: engine.project(rig()[0], anything((4, 3))),
            "calibrate": lambda: engine.calibrate(anything((8, 3)), anything((8, 2)), dice.choice([640, 0, -1]), 480),
            "triangulate": lambda: engine.triangulate(rig()[:dice.randrange(3)], anything((2, 4, 2))),
            "capture": lambda: engine.capture(rig()[:dice.randrange(3)], [[anything((1, 17, 3))] * 3, frames],
                                              dice.choice(["coco", "body_25", "?"]), dice.choice([30, -1, float("nan")]),
                                              dice.randrange(-1, 2), dice.choice([0, 6, float("nan")])),
        }
        while time.monotonic() < end or calls < 200:
            calls += 1
            try:
                targets[dice.choice(list(targets))]()
            except (TypeError, ValueError, MemoryError, OverflowError):
                refused += 1
        self.assertGreater(refused, calls / 4)
        self.assertLess(refused, calls)


if __name__ == "__main__":
    unittest.main()

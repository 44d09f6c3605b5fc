"""Tests `etude clip` on motion files of other tools' formats, written here by second implementations."""
import csv
import json
import math
import pathlib
import struct
import subprocess
import sys
import unittest

import numpy
import second_readers
from etude_case import HEAVY
from motion_file_case import MotionFileCase


def edit_glb(path, change):
    """Changes the scene of a GLB file; `change` gets it and the file's numbers, and may return more numbers."""
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    scene, numbers = json.loads(data[20:20 + length]), data[28 + length:]
    numbers += change(scene, numbers) or b""
    scene["buffers"][0]["byteLength"] = len(numbers)
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(data[:8] + struct.pack("<II", 28 + len(text) + len(numbers), len(text)) + b"JSON" + text
                     + struct.pack("<I", len(numbers)) + b"BIN\0" + numbers)


class Formats(MotionFileCase):
    def amass(self, name, width, rate_key, compressed, **more):
        frames = 60
        poses, places = numpy.zeros((frames, width)), numpy.zeros((frames, 3))
        upright = [math.pi / 2, 0, 0]  # Y up to Z up
        for t in range(frames):
            poses[t, :3] = upright
            poses[t, 3 * 18 + 1] = -1.2 * t / frames  # the left elbow bends forwards, about the file's Y axis
            places[t] = [0, -0.01 * t, 0.9]
        arrays = {"poses": poses, "trans": places, rate_key: numpy.array(120.0), "gender": numpy.array("neutral"), **more}
        path = self.folder / name
        (numpy.savez_compressed if compressed else numpy.savez)(path, **arrays)
        return path

    def test_both_releases_of_amass_stored_and_deflated(self):
        seen = []
        for name, width, key, compressed in (("h.npz", 156, "mocap_framerate", False), ("x.npz", 165, "mocap_frame_rate", True),
                                            ("smpl.npz", 72, "mocap_framerate", True), ("f.npz", 156, "fps", True)):
            path = self.amass(name, width, key, compressed)
            joints = self.joints(path, "--rate", 120)
            self.assertEqual(len(joints), 60)
            for t in (0, 30, 59):
                body = joints[t]
                # The arms of the T-pose are level; the forearm turns about the vertical by the angle above.
                upper, lower = (body[b] - body[a] for a, b in (("left_shoulder", "left_elbow"), ("left_elbow", "left_wrist")))
                self.assertAlmostEqual(numpy.linalg.norm(lower), 0.25, places=6)
                angle = math.atan2(numpy.linalg.norm(numpy.cross(upper, lower)), upper @ lower)
                self.assertAlmostEqual(angle, 1.2 * t / 60, places=6)
                self.assertGreater(body["head"][1], 1.4)
            moved = joints[59]["hip_centre"] - joints[0]["hip_centre"]
            numpy.testing.assert_allclose(moved, [0, 0, 0.59], atol=1e-6)
            seen.append([joint for frame in joints for joint in frame.values()])
        for other in seen[1:]:
            numpy.testing.assert_array_equal(seen[0], other)

    def test_amass_that_is_none_is_told_what_lacks(self):
        self.refused(self.amass("no.npz", 150, "mocap_framerate", True), "allowed: the arrays of AMASS")
        self.refused(self.amass("slow.npz", 156, "speed", True),
                     "states no frame rate (its arrays: poses, speed, trans, gender (no plain numbers)); allowed:")
        bad = self.amass("nan.npz", 156, "mocap_framerate", True, trans=numpy.full((60, 3), numpy.nan))
        self.refused(bad, "array trans, frame 0: found nan")
        whole = self.amass("cut.npz", 156, "mocap_framerate", True).read_bytes()
        for cut in (30, len(whole) // 2, len(whole) - 9):
            (self.folder / "cut.npz").write_bytes(whole[:cut])
            self.refused(self.folder / "cut.npz", "cut.npz")
        at = whole.index(b"PK\x01\x02") + 24  # the first member's size in the central directory
        (self.folder / "cut.npz").write_bytes(whole[:at] + struct.pack("<I", 300_000_000) + whole[at + 4:])
        self.refused(self.folder / "cut.npz", "bytes unpack to 300000000")
        for at in range(100, len(whole), len(whole) // (40 if HEAVY else 6)):
            (self.folder / "bit.npz").write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
            self.assertIn(self.etude("clip", "info", self.folder / "bit.npz").returncode, (0, 2))

    def test_arrays_of_positions_without_a_rate_are_told_how_to_give_it(self):
        body = numpy.load(self.shared_body())
        path = self.folder / "t.npz"
        numpy.savez(path, positions=body["positions"], names=body["names"])
        self.refused(path, "found no rate_hz (frames per second); allowed: rate_hz with one number from 0.1 to 10000, as in numpy.savez(")
        told = self.write("map.yaml", "rate: 50\n")
        self.assertIn("at 50 Hz", self.ends(0, "clip", "info", path, "--map", told).stdout)
        numpy.savez(path, positions=body["positions"], names=body["names"], rate_hz="30")
        self.refused(path, "the array rate_hz must be a single number, the frames per second")
        # A body in mm or cm with Z up: declared by options, or by keys of the file.
        z_up = body["positions"][:, :, [0, 2, 1]] * [1, -1, 1]
        for unit, name in (1000, "mm"), (100, "cm"):
            numpy.savez(path, positions=unit * z_up, names=body["names"], rate_hz=30.0)
            by_options = self.joints(path, "--unit", name, "--up", "z")
            numpy.savez(path, positions=unit * z_up, names=body["names"], rate_hz=30.0, unit=name, up="z")
            for joints in by_options, self.joints(path):
                numpy.testing.assert_allclose(joints[5]["head"], body["positions"][5][list(body["names"]).index("head")], atol=1e-9)
        self.assertIn("turned upright from Z up", self.info(path)["clips"][0]["body"]["note"])
        numpy.savez(path, positions=100 * body["positions"], names=body["names"], rate_hz=30.0)
        self.assertIn("1 unit = 1 cm, because in units of 1 m the joints would extend",
                      self.info(path)["clips"][0]["body"]["note"])
        self.refusal("clip", "info", path, "--unit", "m", says="allowed: 0.1 to 4")

    def shared_body(self):
        path = self.folder / "body.npz"
        self.ends(0, "clip", "convert", "builtin:clap", path)
        return path

    def test_a_pickled_member_is_never_opened(self):
        path = self.amass("p.npz", 156, "mocap_framerate", True, labels=numpy.array([{"a": 1}], dtype=object))
        self.assertEqual(self.info(path)["clips"][0]["frames"], 60)

    def test_markers_of_a_trc_are_a_clip(self):
        clip = self.folder / "sway.trc"
        self.ends(0, "clip", "convert", "builtin:sway", clip)
        ours, theirs = self.joints("builtin:sway"), self.joints(clip)
        self.assertEqual(len(ours), len(theirs))
        floor = theirs[0]["head"][1] - ours[0]["head"][1]  # the floor of a marker file is estimated
        self.assertLess(abs(floor), 0.05)
        for a, b in zip(ours, theirs):
            for name in a:
                numpy.testing.assert_allclose(b[name] - [0, floor, 0], a[name], atol=2e-5, err_msg=name)
        table = self.folder / "sway.csv"
        self.ends(0, "clip", "convert", "builtin:sway", table)
        self.assertEqual(len(self.joints(table)), len(ours))

    def c3d(self, labels, frames, place):
        """Returns a C3D file of little-endian floats: positions in millimetres, Z up."""
        def parameter(name, kind, sizes, data):
            body = struct.pack("<bB", kind, len(sizes)) + bytes(sizes) + data + b"\0"
            return bytes([len(name), 1]) + name.encode() + struct.pack("<H", 2 + len(body)) + body
        width = max(map(len, labels))
        group = bytes([5, 255]) + b"POINT" + struct.pack("<H", 3) + b"\0"
        parameters = b"\0\0\x08\x54" + group + b"".join([
            parameter("USED", 2, [], struct.pack("<H", len(labels))), parameter("SCALE", 4, [], struct.pack("<f", -1)),
            parameter("RATE", 4, [], struct.pack("<f", 60)), parameter("UNITS", -1, [2], b"mm"),
            parameter("Y_SCREEN", -1, [2], b"+Z"),
            parameter("LABELS", -1, [width, len(labels)], "".join(label.ljust(width) for label in labels).encode()),
            parameter("DATA_START", 2, [], struct.pack("<H", 10))])
        header = bytes([2, 0x50]) + struct.pack("<HHHHHfHHf", len(labels), 0, 1, frames, 0, -1, 10, 0, 60)
        data = b"".join(struct.pack("<4f", *place(t, i), 0) for t in range(frames) for i in range(len(labels)))
        path = self.folder / "take.c3d"
        path.write_bytes(header.ljust(512, b"\0") + parameters.ljust(8 * 512, b"\0") + data)
        return path

    def test_a_c3d_of_two_people_is_two_clips(self):
        ours = self.joints("builtin:sway")
        names = list(ours[0])
        labels = [f"{person}:{name}" for person in ("Ann", "Bob") for name in names]

        def place(t, i):
            x, y, z = ours[t][names[i % len(names)]]
            return 1000 * (x + 2 * (i >= len(names))), -1000 * z, 1000 * y

        path = self.c3d(labels, len(ours), place)
        numpy.testing.assert_allclose(second_readers.read_c3d(path)["Bob:head"][3], numpy.array(place(3, len(names) + names.index("head"))) / 1000,
                                      atol=1e-6)
        self.assertEqual([clip["name"] for clip in self.info(path)["clips"]], ["take#Ann", "take#Bob"])
        bob = self.joints(f"{path}#Bob", "--rate", 60)
        floor = bob[0]["head"][1] - ours[0]["head"][1]
        for a, b in zip(ours, bob):
            for name in names:
                numpy.testing.assert_allclose(b[name] - [2, floor, 0], a[name], atol=1e-5)
        self.refused(self.c3d(["A", "B"], 3, lambda t, i: (0, 0, 0)), "the markers (A, B) belong to no known marker set")

    def body(self, reference):
        """Returns a built-in move (frames × 20 × 3, metres) and its joint names."""
        frames = self.joints(reference)
        return list(frames[0]), numpy.array([[frame[name] for name in frames[0]] for frame in frames])

    def assert_read_back(self, path, places, most=1e-5, **options):
        names, read = self.body(path)
        self.assertEqual(read.shape, places.shape)
        # In a file of markers, the program finds the floor itself.
        floor = read[0, names.index("head"), 1] - places[0, names.index("head"), 1]
        self.assertLess(abs(floor), 0.05)
        numpy.testing.assert_allclose(read - [0, floor, 0], places, atol=most)

    def assert_second_reader(self, markers, names, places, most=1e-6):
        self.assertEqual(list(reversed(markers)), names)
        for i, name in enumerate(names):
            numpy.testing.assert_allclose(markers[name], places[:, i], atol=most, err_msg=name)

    def test_trc_is_written_and_read_in_any_unit_with_gaps(self):
        names, places = self.body("builtin:sway")
        path = self.folder / "sway.trc"
        self.ends(0, "clip", "convert", "builtin:sway", path)
        self.assert_second_reader(second_readers.read_trc(path), names, places)
        for unit, each in (("mm", 1000), ("cm", 100), ("m", 1)):
            columns = "".join(f"\t{name}\t\t" for name in names)
            rows = [f"{t + 1}\t{t / 30:.6f}\t" + "\t".join(f"{each * v:.9f}" for v in frame.ravel()) for t, frame in enumerate(places)]
            cells = rows[7].split("\t")
            cells[2 + 3 * 5:5 + 3 * 5] = ["", "", ""]  # a gap: the sixth marker in the eighth frame
            rows[7] = "\t".join(cells)
            path.write_text(f"PathFileType\t4\t(X/Y/Z)\tsway.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
                            f"30\t30\t{len(rows)}\t{len(names)}\t{unit}\nFrame#\tTime{columns}\n\tX1\n" + "\n".join(rows) + "\n")
            seen = second_readers.read_trc(path)
            self.assertTrue(numpy.isnan(seen[names[5]][7]).all())
            bridged = places.copy()
            bridged[7, 5] = (places[6, 5] + places[8, 5]) / 2
            self.assert_read_back(path, bridged)

    def test_c3d_is_written_in_floats(self):
        names, places = self.body("builtin:sway")
        path = self.folder / "sway.c3d"
        self.ends(0, "clip", "convert", "builtin:sway", path)
        self.assert_second_reader(second_readers.read_c3d(path), names, places)
        self.assertEqual(path.stat().st_size % 512, 0)
        self.assert_read_back(path, places)

    def test_npz_is_written_for_numpy(self):
        names, places = self.body("builtin:groove")
        path = self.folder / "groove.npz"
        self.ends(0, "clip", "convert", "builtin:groove", path)
        with numpy.load(path) as arrays:
            self.assertEqual(list(arrays["names"]), names)
            self.assertEqual((float(arrays["rate_hz"]), arrays["unit"][0], arrays["up"][0]), (30, "m", "y"))
            numpy.testing.assert_allclose(arrays["positions"], places, atol=1e-9)
            turned = numpy.zeros_like(places)
            axes = numpy.zeros(places.shape + (3,))
            for j, parent in enumerate(arrays["parents"].astype(int)):
                w, x, y, z = (arrays["rotations"][:, j, k] for k in range(4))
                own = numpy.moveaxis(numpy.array([
                    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), 2, 0)
                above = axes[:, parent] if parent >= 0 else numpy.broadcast_to(numpy.eye(3), own.shape)
                origin = turned[:, parent] if parent >= 0 else 0
                turned[:, j] = origin + numpy.einsum("tij,tj->ti", above, arrays["translations"][:, j])
                axes[:, j] = above @ own
            numpy.testing.assert_allclose(turned, places, atol=1e-9)
        self.assertEqual(self.info(path)["clips"][0]["format"], "NPZ")
        self.assert_read_back(path, places, 1e-9)

    def test_both_readings_of_bvh_see_the_same_whatever_wrote_it(self):
        for source in ("builtin:clap", self.amass("h.npz", 156, "mocap_framerate", False)):
            for options in ((), ("--ground",), ("--retarget",), ("--ground", "--mirror"), ("--rate", "24")):
                path = self.folder / "out.bvh"
                self.ends(0, "clip", "convert", source, path, "--overwrite", *options)
                replaced, added = second_readers.read_bvh(path), second_readers.read_bvh(path, adds=True)
                self.assertGreater(len(replaced), 15)
                for joint, places in replaced.items():
                    numpy.testing.assert_allclose(places, added[joint], atol=1e-9, err_msg=f"{source} {options} {joint}")

    def test_rows_that_are_missing_are_gaps_of_their_length(self):
        whole = self.joints("builtin:sway")[:60]
        names = list(whole[0])
        kept = [k for k in range(60) if not 20 <= k < 35]
        cells = lambda k, scale: [scale * v for name in names for v in whole[k][name]]
        (self.folder / "time.csv").write_text(
            "time_s," + ",".join(f"{name}_{axis}_m" for name in names for axis in "xyz") + "\n"
            + "".join(f"{k / 30}," + ",".join(map(repr, map(float, cells(k, 1.0)))) + "\n" for k in kept))
        (self.folder / "frame.csv").write_text(
            "frame," + ",".join(f"{name}_{axis}_m" for name in names for axis in "xyz") + "\n"
            + "".join(f"{k}," + ",".join(map(repr, map(float, cells(k, 1.0)))) + "\n" for k in kept))
        (self.folder / "a.trc").write_text(
            "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
            f"30\t30\t{len(kept)}\t{len(names)}\tmm\nFrame#\tTime\t" + "\t\t\t".join(names) + "\n\t\tX1\n\n"
            + "".join(f"{k + 1}\t{k / 30:.3f}\t" + "\t".join(map(repr, map(float, cells(k, 1000.0)))) + "\n" for k in kept))
        for name in ("time.csv", "frame.csv", "a.trc"):
            told = self.info(self.folder / name)["clips"][0]
            self.assertEqual((told["frames"], told["rate_hz"]), (60, 30), name)
            self.assertIn("by their times, 15 of 60 frames are missing, in 1 gap of at most 0.533 s",
                          told["body"]["note"])
            read = self.joints(self.folder / name)
            self.assertEqual(len(read), 60)
            floor = read[0]["head"][1] - whole[0]["head"][1]
            for k in kept:
                for joint in names:
                    apart = numpy.linalg.norm(read[k][joint] - whole[k][joint] - [0, floor, 0])
                    self.assertLess(apart, 1e-4, (name, k, joint))

    def test_a_rate_that_is_told_is_not_assumed(self):
        _, places = self.body("builtin:sway")
        numpy.save(self.folder / "poses.npy", places)
        head = ",".join(f"{name}_{axis}_m" for name in self.body("builtin:sway")[0] for axis in "xyz")
        numpy.savetxt(self.folder / "bare.csv", places.reshape(len(places), -1), delimiter=",", header=head, comments="")
        for name in ("poses.npy", "bare.csv"):
            self.assertIn("the file states no rate, so Etude assumes 30 Hz", self.etude("clip", "info", self.folder / name).stdout)
            told = self.etude("clip", "info", self.folder / name, "--rate", 20).stdout
            self.assertIn("at 20 Hz", told)
            self.assertNotIn("assumed", told)

    def test_arrays_of_joints_in_a_named_layout(self):
        names, places = self.body("builtin:sway")
        path = self.folder / "poses.npy"
        numpy.save(path, (1000 * places).astype("f4"))
        told = self.info(path)["clips"][0]
        self.assertIn("layout etude, 1 unit = 0.1 cm; the file states no rate, so Etude assumes 30 Hz", told["body"]["note"])
        self.assert_read_back(path, places)
        order = ["hip_centre", "right_hip", "right_knee", "right_ankle", "left_hip", "left_knee", "left_ankle", "spine",
                 "shoulder_centre", "head", "head", "left_shoulder", "left_elbow", "left_wrist", "right_shoulder",
                 "right_elbow", "right_wrist"]
        numpy.save(path, places[:, [names.index(name) for name in order]])
        self.refused(path, "17 joints, as several layouts have; allowed: ")
        read = self.joints(f"{path}#h36m")
        wrists = numpy.array([frame["left_wrist"] - frame["right_knee"] for frame in read])
        expected = places[:, names.index("left_wrist")] - places[:, names.index("right_knee")]
        numpy.testing.assert_allclose(wrists, expected, atol=1e-6)
        self.refused(f"{path}#body_25", "17 joints in the layout 'body_25'")
        # Layouts whose points have the names of a marker set.
        for layout, order in (
                ("body_25", "head shoulder_centre right_shoulder right_elbow right_wrist left_shoulder left_elbow left_wrist "
                            "hip_centre right_hip right_knee right_ankle left_hip left_knee left_ankle head head head head "
                            "left_foot left_foot left_ankle right_foot right_foot right_ankle"),
                ("halpe_26", "head head head head head left_shoulder right_shoulder left_elbow right_elbow left_wrist "
                             "right_wrist left_hip right_hip left_knee right_knee left_ankle right_ankle head "
                             "shoulder_centre hip_centre left_foot right_foot left_foot right_foot left_ankle right_ankle")):
            numpy.save(path, places[:, [names.index(name) for name in order.split()]])
            wrists = [frame["left_wrist"] - frame["right_knee"] for frame in self.joints(f"{path}#{layout}")]
            numpy.testing.assert_allclose(wrists, expected, atol=1e-6)
        numpy.save(path, numpy.asfortranarray(places))
        self.assert_read_back(path, places, 1e-9)
        numpy.save(path, places[:, :, :2])
        self.refused(path, "allowed: frames × joints × 3")
        path.write_bytes(path.read_bytes()[:200])
        self.refused(path, "poses.npy")

    def test_the_example_converts_what_humanml3d_wrote(self):
        names, places = self.body("builtin:sway")
        order = ("hip_centre left_hip right_hip spine left_knee right_knee spine left_ankle right_ankle spine left_foot right_foot "
                 "shoulder_centre left_shoulder right_shoulder head left_shoulder right_shoulder left_elbow right_elbow "
                 "left_wrist right_wrist").split()
        joints = places[:, [names.index(name) for name in order]]
        joints = joints - [1, 0, 1] * joints[:1, :1]  # starts above the origin
        # HumanML3D's features by their definition: turns and steps per frame, joints in the body's axes.
        turns = numpy.concatenate([[0], 0.02 * numpy.cumsum(numpy.sin(numpy.arange(len(joints) - 1) / 7))])
        features = numpy.random.default_rng(1).normal(size=(len(joints), 263))
        for t, turn in enumerate(turns):
            to_body = numpy.array([[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]])
            features[t, 3] = joints[t, 0, 1]
            features[t, 4:67] = ((joints[t, 1:] - [1, 0, 1] * joints[t, 0]) @ to_body.T).ravel()
            if t > 0:
                features[t - 1, 0] = (turn - turns[t - 1]) / 2
                features[t - 1, 1:3] = (to_body @ (joints[t, 0] - joints[t - 1, 0]))[[0, 2]]
        path, converted = self.folder / "features.npy", self.folder / "joints.npy"
        numpy.save(path, features)
        self.refused(path, f"{len(joints)} × 263 contains features of HumanML3D; convert the features to joints (docs/clips.md#humanml3d)")
        program = pathlib.Path(__file__).parents[2] / "examples" / "python" / "humanml3d_joints.py"
        subprocess.run([sys.executable, program, path, converted], check=True)
        numpy.testing.assert_allclose(numpy.load(converted), joints, atol=1e-9)
        self.assertIn("at 20 Hz", self.etude("clip", "info", f"{converted}#smpl", "--rate", 20).stdout)

    # SOMA's joints at rest, metres from their parents, left side only. Fingers are chains of 3 cm.
    SOMA = {"Hips": (0, 1, 0), "Spine1": (0, .05, 0), "Spine2": (0, .071, 0), "Chest": (0, .076, -.008), "Neck1": (0, .263, -.006),
            "Neck2": (0, .077, .023), "Head": (0, .061, .02), "HeadEnd": (0, .15, 0), "Jaw": (0, .005, .031), "LeftEye": (.032, .054, .076),
            "LeftShoulder": (.016, .232, .051), "LeftArm": (.149, 0, -.055), "LeftForeArm": (.287, 0, 0), "LeftHand": (.271, 0, 0),
            "LeftHandThumbEnd": (.123, -.032, .048), "LeftHandMiddleEnd": (.19, -.003, 0), "LeftLeg": (.1, -.084, .026),
            "LeftShin": (0, -.432, -.008), "LeftFoot": (0, -.422, -.035), "LeftToeBase": (0, -.051, .132), "LeftToeEnd": (0, -.01, .06)}

    def soma(self, is_whole):
        """Returns SOMA's 77 or 30 joints: (name, parent, offset)."""
        joints = []

        def chain(parent, names):
            for name in names:
                known = self.SOMA.get(name.replace("Right", "Left"))
                if known is None or (is_whole and name.endswith("HandMiddleEnd") or is_whole and name.endswith("ThumbEnd")):
                    known = (.03, 0, .02 if "Thumb" in name else 0)
                joints.append((name, parent, numpy.array(known) * [-1 if "Right" in name else 1, 1, 1]))
                parent = len(joints) - 1
            return parent
        head = chain(-1, ["Hips", "Spine1", "Spine2", "Chest", "Neck1", "Neck2", "Head"])
        for name in ["HeadEnd"] * is_whole + ["Jaw", "LeftEye", "RightEye"]:
            chain(head, [name])
        for side in ("Left", "Right"):
            hand = chain(3, [side + name for name in ("Shoulder", "Arm", "ForeArm", "Hand")])
            if not is_whole:
                chain(hand, [side + "HandThumbEnd"]), chain(hand, [side + "HandMiddleEnd"])
                continue
            chain(hand, [f"{side}HandThumb{name}" for name in (1, 2, 3, "End")])
            for finger in ("Index", "Middle", "Ring", "Pinky"):
                chain(hand, [f"{side}Hand{finger}{name}" for name in (1, 2, 3, 4, "End")])
        for side in ("Left", "Right"):
            chain(0, [side + name for name in ["Leg", "Shin", "Foot", "ToeBase"] + ["ToeEnd"] * is_whole])
        return joints

    def test_somas_bvh_and_arrays_have_the_joints_of_the_generator(self):
        def turn(z, y, x):
            (cz, sz), (cy, sy), (cx, sx) = ((math.cos(a), math.sin(a)) for a in (z, y, x))
            return (numpy.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]) @ [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]
                    @ numpy.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]))
        plays = {"left_wrist": "LeftHand", "right_elbow": "RightForeArm", "left_shoulder": "LeftArm", "right_hip": "RightLeg",
                 "left_knee": "LeftShin", "right_ankle": "RightFoot"}
        for is_whole, count in ((False, 30), (True, 77)):
            with self.subTest(count):
                joints = self.soma(is_whole)
                self.assertEqual(len(joints), count)
                dice = numpy.random.default_rng(count)
                phase = dice.uniform(0, 6, (count, 3))
                frames, places, turns, rows = 60, [], [], []
                for t in range(frames):
                    angles = numpy.radians(8) * numpy.sin(phase + 0.07 * t)
                    hips, at, by, row = numpy.array([0.003 * t, 1 + 0.02 * math.sin(t / 9), 0.01 * t]), [], [], [0] * 6
                    for number, (name, parent, offset) in enumerate(joints):
                        local = turn(*angles[number])
                        at.append(hips if parent < 0 else at[parent] + by[parent] @ offset)
                        by.append(local if parent < 0 else by[parent] @ local)
                        row += [*(100 * hips)] * (parent < 0) + [*numpy.degrees(angles[number])]
                    places.append(at)
                    turns.append(by)
                    rows.append(" ".join(f"{value:.6f}" for value in row))
                places = numpy.array(places)
                six = "CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation"

                # The layout of Kimodo's export and BONES-SEED: a Root above the hips, centimetres, no End Site.
                def block(number):
                    name, parent, offset = joints[number]
                    below = "".join(block(k) for k in range(count) if joints[k][1] == number)
                    channels = six if parent < 0 else "CHANNELS 3 Zrotation Yrotation Xrotation"
                    return f"JOINT {name}\n{{\nOFFSET {' '.join(f'{100 * x:.6f}' for x in offset)}\n{channels}\n{below}}}\n"
                bvh = self.write("soma.bvh", f"HIERARCHY\nROOT Root\n{{\nOFFSET 0 0 0\n{six}\n{block(0)}}}\nMOTION\nFrames: {frames}\n"
                                             f"Frame Time: {1 / 30}\n" + "\n".join(rows) + "\n")
                numpy.savez(self.folder / "soma.npz", posed_joints=places.astype("f4"), global_rot_mats=numpy.array(turns, "f4"),
                            foot_contacts=numpy.zeros((frames, 4), bool))
                for path in (bvh, self.folder / "soma.npz"):
                    told = self.info(path)["clips"][0]
                    self.assertEqual(len(told["body"]["roles"]), 20)
                    read = self.joints(path, "--keep-floor")
                    for role, name in {**plays, "head": "HeadEnd" if is_whole else "Head"}.items():
                        number, left = ([joint[0] for joint in joints].index(one) for one in (name, "LeftLeg"))
                        off = numpy.array([frame[role] - frame["left_hip"] for frame in read]) - (places[:, number] - places[:, left])
                        self.assertLess(numpy.abs(off).max(), 1e-5, (path, role))

    MOTIVE = {"Hip": "hip_centre", "Ab": "spine", "Neck": "shoulder_centre", "Head": "head", "LUArm": "left_shoulder",
              "LFArm": "left_elbow", "LHand": "left_wrist", "RUArm": "right_shoulder", "RFArm": "right_elbow",
              "RHand": "right_wrist", "LThigh": "left_hip", "LShin": "left_knee", "LFoot": "left_ankle", "LToe": "left_foot",
              "RThigh": "right_hip", "RShin": "right_knee", "RFoot": "right_ankle", "RToe": "right_foot"}

    def motive(self, places, names, unit="Centimeters", space="Global", called=str):
        bones = [f"Ann:{called(bone)}" for bone in self.MOTIVE]
        rows = [["Format Version", "1.23", "Take Name", "t", "Capture Frame Rate", "30.000000", "Export Frame Rate",
                 "30.000000", "Length Units", unit, "Coordinate Space", space], [],
                ["", "Type"] + 7 * len(bones) * ["Bone"], ["", "Name"] + [bone for bone in bones for _ in range(7)],
                ["", "ID"] + 7 * len(bones) * ["1"], ["", ""] + len(bones) * (4 * ["Rotation"] + 3 * ["Position"]),
                ["Frame", "Time (Seconds)"] + len(bones) * list("XYZWXYZ")]
        for t, frame in enumerate(places):
            row = [t, t / 30]
            for role in self.MOTIVE.values():
                row += [0, 0, 0, 1, *(100 * frame[names.index(role)])]
            rows.append(row)
        path = self.folder / "take.csv"
        with open(path, "w", newline="") as file:
            csv.writer(file).writerows(rows)
        return path

    def test_a_take_of_motive_by_its_bones(self):
        names, places = self.body("builtin:sway")
        path = self.motive(places, names)
        told = self.info(path)["clips"][0]
        self.assertEqual((told["format"], told["rate_hz"]), ("Motive", 30))
        read = self.joints(path)
        for role in ("left_elbow", "right_ankle", "head"):
            ours = places[:, names.index(role)] - places[:, names.index("left_hip")]
            numpy.testing.assert_allclose([frame[role] - frame["left_hip"] for frame in read], ours, atol=1e-6)
        humanik = {"UArm": "Arm", "FArm": "ForeArm", "Hand": "Hand", "Thigh": "UpLeg", "Shin": "Leg", "Foot": "Foot", "Toe": "ToeBase"}
        sides = {"L": "Left", "R": "Right"}
        path = self.motive(places, names, called=lambda bone: sides[bone[0]] + humanik[bone[1:]] if bone[1:] in humanik else bone)
        for a, b in zip(read, self.joints(path)):
            for role in a:
                numpy.testing.assert_array_equal(b[role], a[role])
        self.refused(self.motive(places, names, unit="Furlongs"), "'Length Units' is 'Furlongs'; allowed: Meters")
        self.refused(self.motive(places, names, space="Local"), "allowed: Global")

    def test_the_bones_of_a_vrm_file_are_those_of_its_table(self):
        path = self.folder / "a.glb"
        self.ends(0, "clip", "convert", "builtin:sway", path)
        before = self.info(path)["clips"][0]["body"]
        bones = {"left_shoulder": "leftUpperArm", "left_elbow": "leftLowerArm", "left_wrist": "leftHand",
                 "left_hip": "leftUpperLeg", "left_knee": "leftLowerLeg", "left_ankle": "leftFoot"}
        bones |= {role.replace("left", "right"): bone.replace("left", "right") for role, bone in bones.items()}
        bones["shoulder_centre"] = "neck"
        nodes = {}

        def rename(scene, _):
            nodes.update({node.get("name"): i for i, node in enumerate(scene["nodes"])})
            for i, node in enumerate(scene["nodes"]):
                node["name"] = f"X{i}"

        edit_glb(path, rename)
        table = {bone: {"node": nodes[role]} for role, bone in bones.items()}
        for extension in ({"VRMC_vrm_animation": {"humanoid": {"humanBones": table}}},
                          {"VRM": {"humanoid": {"humanBones": [{"bone": bone, **node} for bone, node in table.items()]}}}):
            edit_glb(path, lambda scene, _: scene.update({"extensions": extension}))
            body = self.info(path)["clips"][0]["body"]
            self.assertNotIn("by the skeleton's shape", body["note"])
            for role in bones:
                self.assertEqual(body["roles"][role]["joint"], f"X{nodes[role]}")
            self.assertAlmostEqual(body["stature_m"], before["stature_m"], places=5)

    def test_a_scale_on_the_hips_that_the_rest_pose_has_not_is_undone(self):
        path = self.folder / "a.glb"
        self.ends(0, "clip", "convert", "builtin:sway", path)
        before, whole = self.joints(path), path.read_bytes()
        for factor in (0.5, 2, 100):
            def scale(scene, numbers):
                moves = scene["animations"][0]
                times = moves["samplers"][0]["input"]
                keys = struct.pack("<3f", *3 * [factor]) * scene["accessors"][times]["count"]
                scene["bufferViews"].append({"buffer": 0, "byteOffset": len(numbers), "byteLength": len(keys)})
                scene["accessors"].append(scene["accessors"][times] | {"bufferView": len(scene["bufferViews"]) - 1, "byteOffset": 0, "type": "VEC3"})
                scene["accessors"][-1].pop("min"), scene["accessors"][-1].pop("max")
                moves["samplers"].append({"input": times, "output": len(scene["accessors"]) - 1})
                hips = next(i for i, node in enumerate(scene["nodes"]) if node.get("name") == "hip_centre")
                moves["channels"].append({"sampler": len(moves["samplers"]) - 1, "target": {"node": hips, "path": "scale"}})
                return keys

            path.write_bytes(whole)
            edit_glb(path, scale)
            note = self.info(path)["clips"][0]["body"]["note"]
            self.assertIn(f"Etude removed scales that only the frames have and that made the body {factor:g} times as tall as in the rest pose", note)
            for a, b in zip(before, self.joints(path)):
                for name in a:
                    numpy.testing.assert_allclose(b[name], a[name], atol=1e-6, err_msg=f"{factor} {name}")

    def test_what_an_extension_moves_and_is_not_read_is_said(self):
        path = self.folder / "a.glb"
        self.ends(0, "clip", "convert", "builtin:sway", path)
        self.assertNotIn("not read", self.info(path)["clips"][0]["body"]["note"])
        edit_glb(path, lambda scene, _: scene.update({"extensionsUsed": ["KHR_animation_pointer"]}))
        self.assertIn("Etude does not read animations that use KHR_animation_pointer", self.info(path)["clips"][0]["body"]["note"])

    def turned(self, name, unit=1.0):
        """Writes the BVH of the sway in another unit."""
        path = self.folder / name
        self.ends(0, "clip", "convert", "builtin:sway", path)
        if unit != 1:
            lines = path.read_text().splitlines()
            start = lines.index("MOTION") + 3
            for i, line in enumerate(lines):
                words = line.split()
                if "OFFSET" in line:
                    lines[i] = "OFFSET " + " ".join(str(unit * float(word)) for word in words[1:])
                elif i >= start and words:
                    lines[i] = " ".join([str(unit * float(word)) for word in words[:3]] + words[3:])
            path.write_text("\n".join(lines) + "\n")
        return path

    def test_motion_bids_states_its_up_axis_in_another_file(self):
        folder = self.folder / "bids"
        self.ends(0, "clip", "convert", "builtin:clap", f"{folder}/")
        (motion,), (axes,) = folder.rglob("*_motion.tsv"), folder.rglob("*_channels.json")
        self.assertIn("Y up (its SpatialAxes)", self.ends(0, "clip", "info", motion).stdout)
        text = axes.read_text()
        axes.write_text(text.replace("LSA", "ALS"))
        self.assertIn("Z up (its SpatialAxes)", self.ends(0, "clip", "info", motion).stdout)
        axes.write_text(text.replace('"Levels": {', '"Levels": {"other": {"SpatialAxes": "ALS"}, '))
        self.assertIn("Y up (its SpatialAxes)", self.ends(0, "clip", "info", motion).stdout)  # no channel uses the other
        (channels,) = folder.rglob("*_channels.tsv")
        lines = channels.read_text().splitlines()
        channels.write_text("\n".join(line.replace("global", "other") if line.startswith("head_") else line for line in lines) + "\n")
        self.assertIn("SpatialAxes ALS and LSA; allowed: the same SpatialAxes for all", self.ends(2, "clip", "info", motion).stderr)
        axes.write_text("{")
        self.assertIn("_channels.json", self.ends(2, "clip", "info", motion).stderr)
        axes.unlink()
        self.assertNotIn("SpatialAxes", self.ends(0, "clip", "info", motion).stdout)

    def test_motion_bids_finds_what_higher_folders_state(self):
        folder = self.folder / "bids"
        self.ends(0, "clip", "convert", "builtin:clap", f"{folder}/")
        (motion,), (facts,), (axes,) = (folder.rglob(f"*_{end}") for end in ("motion.tsv", "motion.json", "channels.json"))
        clip = lambda: json.loads(self.ends(0, "clip", "info", motion, "--json").stdout)["clips"][0]
        wanted = clip()
        content, task = json.loads(facts.read_text()), next(part for part in motion.name.split("_") if part.startswith("task-"))
        # All in the data set's folder; then a lower file, which states another rate, goes before it.
        top = folder / f"{task}_motion.json"
        facts.rename(top), axes.rename(folder / f"{task}_channels.json")
        self.assertEqual(clip(), wanted)
        facts.write_text(json.dumps({"SamplingFrequency": 2 * content["SamplingFrequency"]}))
        self.assertEqual(clip()["rate_hz"], 2 * wanted["rate_hz"])
        facts.unlink()
        # A file about another task does not apply, nor does one above the data set.
        top.rename(folder / "task-other_motion.json")
        self.assertIn("_motion.json", self.ends(2, "clip", "info", motion).stderr)
        (folder / "task-other_motion.json").rename(folder.parent / "motion.json")
        self.assertIn("_motion.json", self.ends(2, "clip", "info", motion).stderr)

    def test_units_told_that_make_no_body_are_refused(self):
        path = self.turned("metres.bvh")
        result = self.ends(2, "clip", "info", path, "--unit", "cm")
        self.assertIn("m tall; allowed: 0.4 to 4 m; with 1 unit = 100 cm (metre), the body would be 1.", result.stderr)

    def test_a_run_is_told_the_unit_and_keeps_it(self):
        clips = [self.turned("child.bvh", unit=50), self.turned("other.bvh", unit=51)]
        told = ["--clips", *clips, "--unit", "cm", "--up", "y"]
        self.ends(0, "run", self.scenario(), "-o", self.out, *told)
        manifest = json.loads((self.out / "manifest.json").read_text())
        self.assertIn("unit: cm\nup: y\n", manifest["sources"].values())
        self.ends(0, "run", "--from", self.out / "manifest.json", "-o", self.folder / "again")
        self.assertEqual((self.out / "cells.jsonl").read_bytes(), (self.folder / "again" / "cells.jsonl").read_bytes())
        refused = self.ends(2, "run", self.scenario(), "-o", self.folder / "no", "--clips", *clips, "--unit", "mm")
        self.assertIn("with the given unit (1 unit = 0.1 cm)", refused.stderr)

    def test_a_run_leaves_out_what_is_refused_when_asked(self):
        self.turned("a.bvh"), self.turned("b.bvh", unit=100)
        (self.folder / "broken.bvh").write_text("HIERARCHY\nROOT\n")
        pattern = self.folder / "*.bvh"
        self.assertIn("broken.bvh", self.ends(2, "run", self.scenario(), "-o", self.out, "--clips", pattern).stderr)
        result = self.ends(0, "run", self.scenario(), "-o", self.out, "--clips", pattern, "--skip-refused")
        self.assertEqual(result.stderr.count("left out: "), 1)
        setup = json.loads((self.out / "manifest.json").read_text())["scenarios"][0]
        self.assertEqual([one["clip"] for one in setup["refused"]], [str(self.folder / "broken.bvh")])
        self.assertEqual(len(setup["clips"]), 2)
        alone = self.ends(2, "run", self.scenario(), "-o", self.folder / "no", "--clips", self.folder / "broken.bvh",
                          "--skip-refused")
        self.assertIn("none of 1 clips can be read; the first: ", alone.stderr)


if __name__ == "__main__":
    unittest.main()

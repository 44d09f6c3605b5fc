"""Motion files that people own, written here by second implementations and read by `etude clip`."""
import csv
import json
import math
import struct
import unittest

import numpy
from etude_case import EtudeCase

SIDES = {"left": 1, "right": -1}


def turn(axis_times_angle):
    """The rotation of a vector's length about its direction (Rodrigues)."""
    angle = math.sqrt(sum(v * v for v in axis_times_angle))
    if angle == 0:
        return numpy.eye(3)
    x, y, z = (v / angle for v in axis_times_angle)
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * (k @ k)


class Formats(EtudeCase):
    def joints(self, path, *options):
        """The twenty joints of a clip by frame, as `etude clip convert` writes them."""
        out = self.folder / "joints.csv"
        result = self.etude("clip", "convert", path, out, "--overwrite", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(out) as file:
            rows = list(csv.DictReader(file))
        names = [name[:-4] for name in rows[0] if name.endswith("_x_m")]
        return [{name: numpy.array([float(row[f"{name}_{axis}_m"]) for axis in "xyz"]) for name in names} for row in rows]

    def info(self, path):
        result = self.etude("clip", "info", path, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def refused(self, path, complaint):
        result = self.etude("clip", "info", path)
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn(complaint, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def amass(self, name, width, rate_key, compressed, **more):
        frames = 60
        poses, places = numpy.zeros((frames, width)), numpy.zeros((frames, 3))
        upright = [math.pi / 2, 0, 0]  # Y up to Z up
        for t in range(frames):
            poses[t, :3] = upright
            poses[t, 3 * 18 + 1] = -1.2 * t / frames  # the left elbow bends forward, about the file's Y
            places[t] = [0, -0.01 * t, 0.9]
        arrays = {"poses": poses, "trans": places, rate_key: numpy.array(120.0), "gender": numpy.array("neutral"), **more}
        path = self.folder / name
        (numpy.savez_compressed if compressed else numpy.savez)(path, **arrays)
        return path

    def test_both_releases_of_amass_stored_and_deflated(self):
        seen = []
        for name, width, key, compressed in (("h.npz", 156, "mocap_framerate", False), ("x.npz", 165, "mocap_frame_rate", True)):
            path = self.amass(name, width, key, compressed)
            joints = self.joints(path, "--rate", 120)
            self.assertEqual(len(joints), 60)
            for t in (0, 30, 59):
                body = joints[t]
                # Level arms in the T-pose; the forearm turns about the vertical by the told angle.
                upper, lower = (body[b] - body[a] for a, b in (("left_shoulder", "left_elbow"), ("left_elbow", "left_wrist")))
                self.assertAlmostEqual(numpy.linalg.norm(lower), 0.25, places=6)
                angle = math.atan2(numpy.linalg.norm(numpy.cross(upper, lower)), upper @ lower)
                self.assertAlmostEqual(angle, 1.2 * t / 60, places=6)
                self.assertGreater(body["head"][1], 1.4)
            moved = joints[59]["hip_centre"] - joints[0]["hip_centre"]
            numpy.testing.assert_allclose(moved, [0, 0, 0.59], atol=1e-6)
            seen.append([joint for frame in joints for joint in frame.values()])
        numpy.testing.assert_array_equal(seen[0], seen[1])

    def test_amass_that_is_none_is_told_what_lacks(self):
        self.refused(self.amass("no.npz", 150, "mocap_framerate", True), "allowed: a motion of AMASS with poses")
        self.refused(self.amass("slow.npz", 156, "fps", True), "arrays fps, poses, trans; allowed:")
        bad = self.amass("nan.npz", 156, "mocap_framerate", True, trans=numpy.full((60, 3), numpy.nan))
        self.refused(bad, "trans of frame 0 is nan")
        whole = self.amass("cut.npz", 156, "mocap_framerate", True).read_bytes()
        for cut in (30, len(whole) // 2, len(whole) - 9):
            (self.folder / "cut.npz").write_bytes(whole[:cut])
            self.refused(self.folder / "cut.npz", "cut.npz")
        for at in range(100, len(whole), len(whole) // 40):
            (self.folder / "bit.npz").write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
            self.assertIn(self.etude("clip", "info", self.folder / "bit.npz").returncode, (0, 2))

    def test_a_pickled_member_is_never_opened(self):
        path = self.amass("p.npz", 156, "mocap_framerate", True, labels=numpy.array([{"a": 1}], dtype=object))
        self.assertEqual(self.info(path)["clips"][0]["frames"], 60)

    def test_markers_of_a_trc_are_a_clip(self):
        clip = self.folder / "sway.trc"
        self.assertEqual(self.etude("clip", "convert", "builtin:sway", clip).returncode, 0)
        ours, theirs = self.joints("builtin:sway"), self.joints(clip)
        self.assertEqual(len(ours), len(theirs))
        floor = theirs[0]["head"][1] - ours[0]["head"][1]  # a file of markers finds its own
        self.assertLess(abs(floor), 0.05)
        for a, b in zip(ours, theirs):
            for name in a:
                numpy.testing.assert_allclose(b[name] - [0, floor, 0], a[name], atol=2e-5, err_msg=name)
        table = self.folder / "sway.csv"
        self.assertEqual(self.etude("clip", "convert", "builtin:sway", table).returncode, 0)
        self.assertEqual(len(self.joints(table)), len(ours))

    def c3d(self, labels, frames, place):
        """A C3D file of floats, little-endian: places in millimetres, Z up."""
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
        self.assertEqual([clip["name"] for clip in self.info(path)["clips"]], ["take#Ann", "take#Bob"])
        bob = self.joints(f"{path}#Bob", "--rate", 60)
        floor = bob[0]["head"][1] - ours[0]["head"][1]
        for a, b in zip(ours, bob):
            for name in names:
                numpy.testing.assert_allclose(b[name] - [2, floor, 0], a[name], atol=1e-5)
        self.refused(self.c3d(["A", "B"], 3, lambda t, i: (0, 0, 0)), "its markers (A, B) are of no set known here")

    def test_what_a_run_recorded_is_a_clip(self):
        path = self.write("capture.yaml", """scenario: c
question: Is it there?
task: capture
trials: 1
clips: ['builtin:clap']
duration_s: 0.2
methods:
  - {name: fixed, segmenter: hue, calibration: dlt, solver: ccd, weights: fixed}
video: {trials: [0]}
""")
        self.run_suite(path)
        cell = json.loads((self.out / "cells.jsonl").read_text().splitlines()[0])
        name = f"c/-/000/{cell['method']}"
        recorded = json.loads(next((self.out / "recordings").iterdir()).read_text())
        truth = next(track for track in recorded["tracks"] if track["name"] == "truth")
        joints = self.joints(f"{self.out}#{name}@truth")
        poses = truth["poses"]
        self.assertEqual(len(joints), len(poses))
        for frame, pose in zip(joints, poses):
            numpy.testing.assert_allclose(numpy.ravel(list(frame.values())), pose, atol=1e-9)
        self.assertEqual(self.etude("clip", "info", f"{self.out}#{name}").returncode, 0)
        self.refused(f"{self.out}#{name}@nobody", "animation 'nobody'")


if __name__ == "__main__":
    unittest.main()

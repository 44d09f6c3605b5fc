"""Tests FBX files: our own files against our own forward kinematics, a studio's files, and all of them against
three.js's loader.

The last needs Node.js and npm's package three: `npm install three`, and ETUDE_THREE=…/node_modules/three.
"""
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import unittest
import zlib

import numpy
import second_readers
from etude_case import heavy
from motion_file_case import MotionFileCase

THREE = os.environ.get("ETUDE_THREE")


def turn(axis_times_angle):
    """Returns the rotation by a vector's length about its direction (Rodrigues)."""
    angle = math.sqrt(sum(v * v for v in axis_times_angle))
    if angle == 0:
        return numpy.eye(3)
    x, y, z = (v / angle for v in axis_times_angle)
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * (k @ k)


def in_binary(text, version=7400):
    """Returns the binary file with the nodes of a text file; its arrays are deflated."""
    lines = [line.strip() for line in text.splitlines() if line.strip() and not line.startswith(";")]
    kinds = {"KeyTime": ("l", "<i8"), "KeyValueFloat": ("f", "<f4"), "KeyAttrDataFloat": ("f", "<f4")}

    def value(word, node):
        if not word.startswith('"'):
            if not re.fullmatch(r"-?\d+", word):
                return b"D" + struct.pack("<d", float(word))
            is_id = node == "C" or node.startswith(("Model", "Animation"))
            return b"L" + struct.pack("<q", int(word)) if is_id else b"I" + struct.pack("<i", int(word))
        kind, _, name = word.strip('"').rpartition("::") if node != "P" else ("", "", word.strip('"'))
        data = f"{name}\0\1{kind}".encode() if kind else name.encode()
        return b"S" + struct.pack("<I", len(data)) + data

    def nodes(at):
        out = b""
        while lines and lines[0] != "}":
            name, rest = lines.pop(0).split(":", 1)
            opens = rest.endswith("{")
            words = [word for word in re.split(r",\s*", rest.strip(" {")) if word]
            head = at + len(out) + 13 + len(name)
            if opens and words and words[0].startswith("*"):
                letter, kind = kinds.get(name, ("i", "<i4"))
                packed = zlib.compress(numpy.array(lines.pop(0)[2:].split(","), float).astype(kind).tobytes())
                body = values = letter.encode() + struct.pack("<III", int(words[0][1:]), 1, len(packed)) + packed
                lines.pop(0)
            else:
                body = values = b"".join(value(word.strip(), name) for word in words)
                if opens:
                    body += nodes(head + len(values)) + bytes(13)
                    lines.pop(0)
            out += struct.pack("<IIIB", head + len(body), len(words), len(values), len(name)) + name.encode() + body
        return out

    start = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
    return start + nodes(len(start)) + bytes(13)


class Fbx(MotionFileCase):
    # Joint: parent, offset from the parent (cm), Euler angles about x, y, z (degrees) over time (s). Each joint also has a
    # constant rotation of its own.
    FBX_BODY = {
        "Hips": (None, (0, 95, 0), lambda t: (0, 40 * t, 0), (0, 0, 0)),
        "Spine": ("Hips", (0, 20, 0), lambda t: (10 * t, 0, 0), (0, 0, 0)), "Neck": ("Spine", (0, 30, 0), None, (0, 0, 0)),
        "Head": ("Neck", (0, 12, 0), None, (0, 0, 0)),
        **{f"{side}{name}": (f"{side}{parent}" if near else parent, (sign * x, y, z), turns, pre)
           for side, sign in (("Left", 1), ("Right", -1))
           for name, parent, near, (x, y, z), turns, pre in (
               ("Arm", "Spine", 0, (18, 26, 0), lambda t: (0, 0, -50 * t), (0, 0, 0)),
               ("ForeArm", "Arm", 1, (28, 0, 0), lambda t: (0, -45 * t, 15 * t), (90, 0, 0)),
               ("Hand", "ForeArm", 1, (25, 0, 0), None, (0, 0, 0)), ("UpLeg", "Hips", 0, (9, -5, 0), None, (0, 0, 0)),
               ("Leg", "UpLeg", 1, (0, -43, 0), lambda t: (20 * t, 0, 0), (0, 0, 0)),
               ("Foot", "Leg", 1, (0, -42, 0), None, (0, 0, 0)), ("ToeBase", "Foot", 1, (0, -5, 14), None, (0, 0, 0)))}}

    def fbx(self, name, unit_cm, up, frames=31, rate=30, late_ticks=0, inactive=(), pivots=None, branch=lambda t, turns: turns):
        """Writes an FBX text file; returns it and the joints' positions by frame (metres, Y up) by forward
        kinematics of our own.

        Keys about Y come late_ticks later. Joints of `inactive` have RotationActive 0 beside a PreRotation and an
        order. Joints of `pivots` turn about a point, given in centimetres from the joint. `branch` changes the angles
        of a key in the file."""
        pivots = pivots or {}
        def euler(degrees):  # x first, then y, then z
            x, y, z = (turn(numpy.radians(a) * axis) for a, axis in zip(degrees, numpy.eye(3)))
            return z @ y @ x
        stand = numpy.eye(3) if up == "y" else numpy.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # Y up to Z up
        objects, links = [], []
        ids = {joint: 1000 + i for i, joint in enumerate(self.FBX_BODY)}
        times = lambda k: ",".join(str(t * 46186158000 // rate + (late_ticks if k == 1 else 0)) for t in range(frames))
        triple = lambda label, kind, v: f'P: "{label}", "{kind}", "", "A",{",".join(repr(float(c)) for c in v)}\n'
        for joint, (parent, place, turns, pre) in self.FBX_BODY.items():
            if parent is None:
                place, pre = stand @ place, (90 if up == "z" else 0, 0, 0)
            objects.append(f'Model: {ids[joint]}, "Model::{joint}", "LimbNode" {{\nVersion: 232\nProperties70: {{\n'
                           + triple("Lcl Translation", "Lcl Translation", numpy.array(place) / unit_cm)
                           + f'P: "RotationActive", "bool", "", "",{int(joint not in inactive)}\n'
                           + ('P: "RotationOrder", "enum", "", "",5\n' if joint in inactive else "")
                           + triple("RotationPivot", "Vector3D", numpy.array(pivots.get(joint, (0, 0, 0))) / unit_cm)
                           + triple("PreRotation", "Vector3D", (0, 90, 0) if joint in inactive else pre) + "}\n}\n")
            links.append(f'C: "OO",{ids[joint]},{ids.get(parent, 0)}\n')
            if turns is None:
                continue
            node = ids[joint] + 1000
            objects.append(f'AnimationCurveNode: {node}, "AnimCurveNode::R", "" {{\n}}\n')
            links += [f'C: "OO",{node},2\n', f'C: "OP",{node},{ids[joint]}, "Lcl Rotation"\n']
            for k, axis in enumerate("XYZ"):
                curve = 10 * node + k
                values = ",".join(repr(float(branch(t, turns(t / rate))[k])) for t in range(frames))
                objects.append(f'AnimationCurve: {curve}, "AnimCurve::", "" {{\nDefault: 0\nKeyVer: 4008\n'
                               f"KeyTime: *{frames} {{\na: {times(k)}\n}}\nKeyValueFloat: *{frames} {{\na: {values}\n}}\n"
                               f"KeyAttrFlags: *1 {{\na: 24836\n}}\nKeyAttrDataFloat: *4 {{\na: 0,0,0,0\n}}\n"
                               f"KeyAttrRefCount: *1 {{\na: {frames}\n}}\n}}\n")
                links.append(f'C: "OP",{curve},{node}, "d|{axis}"\n')
        text = (
            "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n"
            "GlobalSettings:  {\nVersion: 1000\nProperties70:  {\n"
            + "".join(f'P: "{key}", "int", "Integer", "",{value}\n' for key, value in (
                ("UpAxis", 1 if up == "y" else 2), ("UpAxisSign", 1), ("FrontAxis", 2 if up == "y" else 1), ("FrontAxisSign", 1),
                ("CoordAxis", 0), ("CoordAxisSign", 1)))
            + f'P: "UnitScaleFactor", "double", "Number", "",{float(unit_cm)}\nP: "TimeMode", "enum", "", "",6\n}}\n}}\n'
            'Objects:  {\nAnimationStack: 1, "AnimStack::Walk", "" {\n}\nAnimationLayer: 2, "AnimLayer::Base", "" {\n}\n'
            + "".join(objects) + '}\nConnections:  {\nC: "OO",2,1\n' + "".join(links) + "}\n")
        lines, depth = [], 0
        for line in text.splitlines():  # three.js parses by indentation
            depth -= line.startswith("}")
            lines.append(depth * "\t" + line)
            depth += line.endswith("{")
        path = self.folder / name
        path.write_text("\n".join(lines) + "\n")
        places = []
        for t in range(frames):
            turned, placed = {}, {}
            for joint, (parent, place, turns, pre) in self.FBX_BODY.items():
                own = euler((0, 0, 0) if joint in inactive else pre) @ (euler(turns(t / rate)) if turns else numpy.eye(3))
                turned[joint] = turned[parent] @ own if parent else own
                pivot = numpy.array(pivots.get(joint, (0, 0, 0)), float)
                place = numpy.array(place, float) + pivot - own @ pivot
                placed[joint] = placed[parent] + turned[parent] @ place if parent else place
            places.append({joint: place / 100 for joint, place in placed.items()})
        return path, places

    def test_fbx_in_text_by_units_and_axes(self):
        for unit_cm, up in ((1, "y"), (100, "z")):
            path, places = self.fbx(f"body-{up}.fbx", unit_cm, up)
            self.assertIn("FBX, 31 frames at 30 Hz", self.etude("clip", "info", path).stdout)
            self.assertLess(self.apart_from_truth(path, places), 1e-4, up)

    def apart_from_truth(self, path, places):
        """Returns the largest error (metres) of wrists, elbows, ankles and knees, relative to the hips."""
        worst = 0
        joints = self.joints(path, "--rate", 30)
        self.assertEqual(len(joints), len(places))
        for frame, truth in zip(joints, places):
            for role, joint in (("left_wrist", "LeftHand"), ("right_elbow", "RightForeArm"), ("left_ankle", "LeftFoot"),
                                ("right_wrist", "RightHand"), ("right_knee", "RightLeg"), ("left_shoulder", "LeftArm")):
                apart = frame[role] - frame["hip_centre"] - truth[joint] + (truth["LeftUpLeg"] + truth["RightUpLeg"]) / 2
                worst = max(worst, numpy.linalg.norm(apart))
        return worst

    @heavy
    def test_fbx_keys_of_three_axes_that_are_not_at_one_time(self):
        for late_ticks in (0, 1, 80, 1000, 46186):  # at most a microsecond
            path, places = self.fbx("late.fbx", 1, "y", late_ticks=late_ticks)
            self.assertIn("FBX, 31 frames at 30 Hz", self.etude("clip", "info", path).stdout, late_ticks)
            self.assertLess(self.apart_from_truth(path, places), 1e-4, late_ticks)

    def test_fbx_euler_angles_on_any_branch_in_text_and_binary(self):
        twin = lambda t, turns: (turns[0] + 180, 180 - turns[1], turns[2] - 180) if t % 10 < 5 else turns
        for branch in (lambda t, turns: turns, twin, lambda t, turns: (turns[0] - 360 * (t % 3), turns[1], turns[2] + 720 * (t % 2))):
            path, places = self.fbx("branch.fbx", 1, "y", branch=branch)
            for data in (path.read_bytes(), in_binary(path.read_text())):
                path.write_bytes(data)
                self.assertIn("FBX, 31 frames at 30 Hz", self.etude("clip", "info", path).stdout)
                self.assertLess(self.apart_from_truth(path, places), 1e-4)

    def test_fbx_pre_rotations_and_orders_count_where_rotation_is_active(self):
        path, places = self.fbx("inactive.fbx", 1, "y", inactive=("LeftArm", "RightForeArm"))
        self.assertLess(self.apart_from_truth(path, places), 1e-4)
        note = json.loads(self.etude("clip", "info", path, "--json").stdout)["clips"][0]["body"]["note"]
        self.assertIn("RotationActive is not set in 2 joints, so Etude ignores the pre-rotations, post-rotations", note)
        path, _ = self.fbx("active.fbx", 1, "y")
        self.assertNotIn("RotationActive", self.etude("clip", "info", path, "--json").stdout)

    def test_fbx_joints_with_pivots_turn_about_them(self):
        pivots = {"LeftForeArm": (3, 2, -1), "RightForeArm": (0, 4, 0), "LeftLeg": (0, -3, 2), "Spine": (1, 5, 0), "RightArm": (2, 0, 1)}
        path, places = self.fbx("pivots.fbx", 1, "y", pivots=pivots)
        self.assertIn("FBX, 31 frames at 30 Hz", self.etude("clip", "info", path).stdout)
        self.assertLess(self.apart_from_truth(path, places), 1e-4)

    def test_fbx_keys_that_are_far_apart_are_told(self):
        for rate, told in ((30, False), (2, True)):
            path, _ = self.fbx("far.fbx", 1, "y", frames=4, rate=rate)
            note = json.loads(self.etude("clip", "info", path, "--json").stdout)["clips"][0]["body"]["note"]
            self.assertEqual("keys are up to 0.50 s apart; between keys, Etude replaces the file's curves by shortest"
                             in note, told, note)

    def test_fbx_without_an_animation_is_told_so(self):
        path, _ = self.fbx("rest.fbx", 1, "y")
        text = path.read_text()
        start, end = text.index("\tAnimationCurveNode"), text.index("Connections:")
        models = [part for part in re.split(r"(?m)^(?=\t\w+: \d+)", text[:end]) if not part.startswith("\tAnimation")]
        path.write_text("".join(models) + ("" if models[-1].rstrip().endswith("}\n}") else "}\n") + text[end:])
        self.assertLess(start, end)
        self.refused(path, "rest.fbx: the file contains no animation, only a character (joints: ")

    @unittest.skipUnless(THREE, "ETUDE_THREE names no folder of npm's package three")
    def test_fbx_lies_where_three_js_puts_it(self):
        """Compares every joint in every frame, in metres; a file is in centimetres unless it says otherwise."""
        files = [(self.fbx("y.fbx", 1, "y")[0], 0.01), (self.fbx("z.fbx", 100, "z")[0], 1)]
        files += [(pathlib.Path("/usr/share/assimp/models/FBX", name), 0.01) for name in ("huesitos.fbx", "animation_with_skeleton.fbx")]
        for path, metres in files:
            self.assertLess(self.apart_from_three(path, metres), 1e-4, path)

    def apart_from_three(self, path, metres):
        """Returns the largest distance (metres) of a joint from three.js's."""
        out = self.folder / "out.glb"
        self.ends(0, "clip", "convert", path, out, "--overwrite", "--unit", "m")
        facts = json.loads(self.etude("clip", "info", out, "--json").stdout)["clips"][0]  # code 2: the file has no body
        ours = second_readers.read_gltf(out, facts["name"].partition("#")[2], facts["rate_hz"], facts["frames"])
        words = ["node", pathlib.Path(__file__).with_name("three_fbx.mjs"), THREE, path, facts["rate_hz"], facts["frames"]]
        theirs = json.loads(subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True).stdout)
        named = {re.sub(r"[\[\].:/]", "", name.replace(" ", "_")): places for name, places in ours.items()}  # as three.js does
        both = [name for name in named if name in theirs and name]
        self.assertGreater(len(both), 5)
        return max(numpy.linalg.norm(named[name] - metres * numpy.array(theirs[name]), axis=1).max() for name in both)

    def test_fbx_of_a_studio_tool(self):
        told = self.etude("clip", "info", "/usr/share/assimp/models/FBX/huesitos.fbx").stdout  # binary, with a mesh
        self.assertIn("FBX, 40 frames at 25 Hz", told)

    def test_a_manifest_names_the_build_that_read_an_fbx_file(self):
        path, _ = self.fbx("body.fbx", 1, "y")
        self.run_suite(self.scenario(), "--clips", path, "builtin:sway")
        clips = json.loads((self.out / "manifest.json").read_text())["scenarios"][0]["loaded_clips"]
        self.assertRegex(clips[0]["note"], r"read by libassimp\.so\.\d+ \([0-9a-f]{20}\)")

    def test_an_fbx_file_cut_anywhere_is_refused_in_one_line(self):
        path, _ = self.fbx("whole.fbx", 1, "y")
        text = path.read_text()
        for share in (0.1, 0.5, 0.9):
            path.write_text(text[:int(len(text) * share)])
            self.refused(path, "whole.fbx: ")

    # On this file, found by fuzzing, assimp recurses until its stack overflows.
    def test_an_fbx_file_that_ends_its_reader_ends_nothing_else(self):
        path, _ = self.fbx("circle.fbx", 1, "y")
        path.write_text(path.read_text().replace("Connections:  {", f'Connections:  {{\nC: "OO",{1000 + 3},{1000 + 3}'))
        self.refused(path, "circle.fbx: the FBX file is damaged: its reader ended with signal 11")

    def test_a_refusal_does_not_say_the_file_again(self):
        path, _ = self.fbx("unclosed.fbx", 1, "y")
        path.write_text(path.read_text().replace("Model: 1003, ", 'Model: "' + "x" * 5000 + '", '))
        self.assertLess(len(self.ends(2, "clip", "info", path).stderr), 1000)

    def test_fbx_of_old_tools_is_told_its_version(self):
        path = self.folder / "old.fbx"
        for data in (b"; FBX 6.1.0 project file\nFBXHeaderExtension:  {\nFBXVersion: 6100\n}\n",
                     b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 6100) + bytes(99)):
            path.write_bytes(data)
            self.refused(path, "the FBX file has version 6; allowed: version 7 (2011) or later")


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
"""Measures how hard pictures are for a neural estimator: rendered pictures, by condition of a scenario, and real ones.

    etude export SCENARIO -o DATA
    compare.py --export DATA [--real FOLDER --calibration FILE.toml --reference FILE.trc] [--estimate]

Prints one line per condition, and one for the real pictures: the share in which a person is found, the estimator's mean
score, and the distances of its twelve limb joints from the truth (rendered) or from a reference by several cameras
(real), in per cent of the body's height in the picture. Real pictures are called NAME-FRAME.png: NAME is a camera of
the calibration file (Pose2Sim's TOML), FRAME counts from 0. --stored NAME=SCALE,LEFT,TOP says how a camera's pictures
were scaled and shifted after the calibration.
"""

import argparse
import collections
import json
import pathlib
import re
import subprocess
import sys
import tomllib

import numpy as np

from answer import unpack

HERE = pathlib.Path(__file__).parent
SURE = 0.3      # a person is found if the twelve joints' mean score reaches this
NEAR = 5        # a joint is near if its distance is at most this, per cent of the body's height

# Index in COCO: (role in Etude, marker of the reference).
JOINTS = {5: ("left_shoulder", "LShoulder"), 6: ("right_shoulder", "RShoulder"), 7: ("left_elbow", "LElbow"),
          8: ("right_elbow", "RElbow"), 9: ("left_wrist", "LWrist"), 10: ("right_wrist", "RWrist"),
          11: ("left_hip", "LHip"), 12: ("right_hip", "RHip"), 13: ("left_knee", "LKnee"),
          14: ("right_knee", "RKnee"), 15: ("left_ankle", "LAnkle"), 16: ("right_ankle", "RAnkle")}
COLUMNS = list(JOINTS)
# A body's height is the length of the chain from the head down one leg, which both kinds of truth contain.
ROLES_DOWN = ["head", "shoulder_centre", "spine", "hip_centre", "left_hip", "left_knee", "left_ankle"]
MARKERS_DOWN = ["Head", "Neck", "Hips", "LHip", "LKnee", "LAnkle"]


class Camera:
    """OpenCV's pinhole camera. The corner of the first pixel is (0, 0) if `half` is 0.5; its centre is (0, 0) if
    `half` is 0."""

    def __init__(self, matrix, distortion, rotation, translation, half=0.0):
        self.matrix = np.array(matrix, float).reshape(3, 3)
        self.distortion = np.zeros(5)
        self.distortion[:len(distortion)] = distortion
        self.rotation = np.array(rotation, float).reshape(3, 3)
        self.translation = np.array(translation, float)
        self.half = half

    def project(self, points):
        """Returns the pixels and depths of points (n × 3)."""
        seen = points @ self.rotation.T + self.translation
        x, y = seen[:, 0] / seen[:, 2], seen[:, 1] / seen[:, 2]
        k1, k2, p1, p2, k3 = self.distortion
        r = x * x + y * y
        radial = 1 + r * (k1 + r * (k2 + r * k3))
        u = x * radial + 2 * p1 * x * y + p2 * (r + 2 * x * x)
        v = y * radial + p1 * (r + 2 * y * y) + 2 * p2 * x * y
        pixels = np.stack([u, v, np.ones_like(u)], 1) @ self.matrix.T
        return pixels[:, :2] + self.half, seen[:, 2]


def rotation_of(vector):
    """Returns the rotation matrix of a rotation vector (Rodrigues' formula)."""
    vector = np.array(vector, float)
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def read_opencv(path):
    def numbers(name):
        block = re.search(rf"{name}:.*?data: \[(.*?)\]", path.read_text(), re.S)
        return [float(number) for number in block.group(1).split(",")]
    return Camera(numbers("camera_matrix"), numbers("distortion_coefficients"), numbers("R"), numbers("T"), half=0.5)


def read_toml(path):
    cameras = {}
    for entry in tomllib.loads(path.read_text()).values():
        if "matrix" not in entry:
            continue
        cameras[entry["name"].replace("_", "")] = Camera(
            entry["matrix"], entry["distortions"], rotation_of(entry["rotation"]), entry["translation"])
    return cameras


def read_trc(path):
    """Returns the markers by name, frames × 3, in the cameras' world: the file has Y up, the cameras have Z up."""
    lines = path.read_text().splitlines()
    names = [name for name in lines[3].split("\t")[2:] if name.strip()]
    values = np.array([[float(cell) for cell in line.split("\t")[2:2 + 3 * len(names)]] for line in lines[5:] if line.strip()])
    markers = {name: values[:, 3 * i:3 * i + 3][:, [2, 0, 1]] for i, name in enumerate(names)}
    markers["Hips"] = (markers["LHip"] + markers["RHip"]) / 2
    return markers


def height_of(chain):
    """Returns the median length of a chain over frames, metres; the chain is a list of positions, frames × 3 each."""
    return float(np.median(sum(np.linalg.norm(b - a, axis=1) for a, b in zip(chain, chain[1:]))))


class Figures:
    def __init__(self):
        self.people, self.scores, self.errors = [], [], []

    def add(self, keypoints, camera, points, height, stored=(1, 0, 0)):
        """Adds one picture: the keypoints found in it, and the twelve true points."""
        found = np.array(keypoints)[COLUMNS]
        pixels, depths = camera.project(points)
        scale, left, top = stored
        pixels = pixels * scale + np.array([left, top])
        in_pixels = height * camera.matrix[1, 1] * scale / np.mean(depths)
        self.people.append(found[:, 2].mean() >= SURE)
        self.scores.append(found[:, 2].mean())
        self.errors.extend(100 * np.linalg.norm(found[:, :2] - pixels, axis=1) / in_pixels)

    def line(self, name):
        errors = np.array(self.errors)
        return (f"| {name} | {len(self.people)} | {100 * np.mean(self.people):.0f} % | {np.mean(self.scores):.2f} "
                f"| {np.median(errors):.1f} | {np.percentile(errors, 90):.1f} | {100 * np.mean(errors < NEAR):.0f} % |")


def estimate(pictures, kept, wanted):
    if wanted or not kept.exists():
        unpack(pictures[0].parent)
        found = subprocess.run(["node", HERE / "estimate.mjs", *pictures], check=True, capture_output=True, text=True)
        kept.write_text(found.stdout.splitlines()[-1])
    return json.loads(kept.read_text())


def compare_export(data, wanted):
    by_condition = collections.defaultdict(Figures)
    for truth_file in sorted(data.glob("truth/*/*/*/truth.json")):
        folder = truth_file.parent
        inputs = data / "inputs" / folder.relative_to(data / "truth")
        setting = json.loads((inputs.parent / "setting.json").read_text())
        joints = setting.get("setting", setting)["joints"]
        poses = np.array(json.loads(truth_file.read_text())["poses"]).reshape(-1, len(joints), 3)
        height = height_of([poses[:, joints.index(role)] for role in ROLES_DOWN])
        columns = [joints.index(role) for role, _ in JOINTS.values()]
        problem = json.loads((inputs / "problem.json").read_text())
        pictures = [name for camera in problem["cameras"] for name in camera["pictures"]]
        found = estimate([inputs / name for name in pictures], folder / "keypoints.json", wanted)
        for picture in pictures:
            camera_name, frame = re.fullmatch(r"(camera-\d+)-(\d+)\.png", picture).groups()
            camera = read_opencv(folder / f"{camera_name}.yaml")
            by_condition[folder.parent.name].add(found[picture], camera, poses[int(frame)][columns], height)
    return by_condition


def compare_real(folder, calibration, reference, stored, wanted):
    cameras, markers = read_toml(calibration), read_trc(reference)
    height = height_of([markers[name] for name in MARKERS_DOWN])
    points = np.stack([markers[marker] for _, marker in JOINTS.values()], 1)
    pictures = sorted(folder.glob("*-[0-9]*.png"))
    found = estimate(pictures, folder / "keypoints.json", wanted)
    figures = Figures()
    for picture in pictures:
        name, frame = picture.stem.rsplit("-", 1)
        figures.add(found[picture.name], cameras[name], points[int(frame)], height, stored.get(name, (1, 0, 0)))
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--export", type=pathlib.Path, help="folder written by etude export")
    parser.add_argument("--real", type=pathlib.Path, help="folder of real pictures")
    parser.add_argument("--calibration", type=pathlib.Path)
    parser.add_argument("--reference", type=pathlib.Path)
    parser.add_argument("--stored", action="append", default=[], metavar="NAME=SCALE,LEFT,TOP")
    parser.add_argument("--estimate", action="store_true", help="estimate anew, also where keypoints.json is there")
    arguments = parser.parse_args()
    if not (arguments.export or arguments.real):
        parser.error("nothing to compare: --export or --real")
    if arguments.real and not (arguments.calibration and arguments.reference):
        parser.error("--real needs --calibration and --reference")
    print("| pictures | how many | with a person | mean score | median error, % of height | 90th percentile | "
          f"within {NEAR} % |\n|---|---|---|---|---|---|---|")
    if arguments.export:
        for condition, figures in compare_export(arguments.export, arguments.estimate).items():
            print(figures.line(condition))
    if arguments.real:
        stored = {}
        for entry in arguments.stored:
            name, numbers = entry.split("=")
            stored[name] = tuple(float(number) for number in numbers.split(","))
        print(compare_real(arguments.real, arguments.calibration, arguments.reference, stored,
                           arguments.estimate).line("real"))


if __name__ == "__main__":
    sys.exit(main())

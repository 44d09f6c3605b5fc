"""Tests `etude capture` with other tools' rigs and keypoints, and with users' mistakes. Points are exact, so every
millimetre of deviation is an error of the program.

The test generates a walking figure, four cameras, their calibration and keypoints in every format, and one mistake at a
time. `--poses` prints the distances between skeletons and noisy keypoints.
"""
import copy
import functools
import html
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest
import unittest.mock

import numpy as np
import second_readers
from etude_case import HEAVY, EtudeCase, heavy

WIDTH, HEIGHT, FRAMES, RATE, FOCAL = 640, 480, 60, 30, 520.0
PLACES = {"cam1": (-2.6, 1.6, 3.2), "cam2": (0.4, 2.3, 4.1), "cam3": (3.1, 1.2, 2.6), "cam4": (-0.8, 1.9, -3.7)}
COCO = ("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
        "RAnkle").split()
HALPE = COCO + "Head Neck MidHip LBigToe RBigToe LSmallToe RSmallToe LHeel RHeel".split()
LENS = [-0.12, 0.05, 0.001, -0.0015, 0.01, 0.02, -0.01, 0.004, 0.002, -0.001, 0.001, 0.0005, 0.01, -0.02]


def rotation(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def rodrigues(R):
    angle = math.acos(max(-1, min(1, (np.trace(R) - 1) / 2)))
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    if angle > math.pi - 1e-6:  # for a half turn the axis above is zero
        axis = (R + np.eye(3))[:, np.argmax(np.diag(R))]
    length = np.linalg.norm(axis)
    return axis * 0 if length == 0 else angle * axis / length  # the identity has no axis


@functools.lru_cache(maxsize=None)
def figure(t, centre=(0.0, 0.0), pace=1.0):
    """Returns a figure of 1.7 m that turns, swings its arms and steps aside; metres, Y up, the floor at 0."""
    facing = 0.5 * math.sin(0.8 * t * pace)
    forward, left = np.array([math.sin(facing), 0, math.cos(facing)]), np.array([math.cos(facing), 0, -math.sin(facing)])
    up = np.array([0, 1.0, 0])
    step = min(1, max(0, (t * pace - 0.7) / 0.6))
    step = step ** 3 * (10 - 15 * step + 6 * step * step)  # both feet step, so that their resting places span a floor
    centre = (centre[0] + 0.3 * step, centre[1] - 0.25 * step)
    # Both feet stand still, apart in both directions; the knees bend.
    hips = np.array([centre[0] + 0.06 * math.sin(1.7 * t * pace), 0.86 + 0.04 * math.cos(2.1 * t * pace), centre[1]])
    p = {"MidHip": hips}
    chest = hips + 0.5 * (up * math.cos(0.1) + forward * math.sin(0.1))
    p["Neck"], p["Head"] = chest, chest + 0.28 * up
    p["Nose"] = chest + 0.17 * up + 0.12 * forward
    for side, s in (("L", 1), ("R", -1)):
        swing = s * 0.7 * math.sin(3 * t * pace) + 0.3
        p[side + "Eye"] = chest + 0.2 * up + 0.1 * forward + 0.03 * s * left
        p[side + "Ear"] = chest + 0.19 * up + 0.07 * s * left
        p[side + "Shoulder"] = chest + 0.18 * s * left
        p[side + "Hip"] = hips + 0.1 * s * left
        p[side + "Elbow"] = p[side + "Shoulder"] + 0.29 * (-up * math.cos(swing) + forward * math.sin(swing)) * 0.98 \
            + 0.29 * math.sqrt(1 - 0.98 ** 2) * s * left
        p[side + "Wrist"] = p[side + "Elbow"] + 0.25 * (-up * math.cos(swing + 0.6) + forward * math.sin(swing + 0.6))
        ankle = np.array([centre[0] + 0.16 * s, 0.08, centre[1] + 0.12 * s])
        way = ankle - p[side + "Hip"]
        d = np.linalg.norm(way)
        along = (0.43 ** 2 - 0.42 ** 2 + d * d) / (2 * d)
        aside = math.sqrt(max(0, 0.43 ** 2 - along ** 2))
        ahead = np.array([0, 0, 1.0]) - way * (way[2] / (d * d))
        p[side + "Knee"] = p[side + "Hip"] + way * (along / d) + aside * ahead / np.linalg.norm(ahead)
        p[side + "Ankle"] = ankle
        p[side + "BigToe"] = ankle + np.array([-0.01 * s, -0.06, 0.15])
        p[side + "SmallToe"] = ankle + np.array([0.05 * s, -0.06, 0.12])
        p[side + "Heel"] = ankle + np.array([0, -0.05, -0.05])
    return p


class Lens:
    def __init__(self, coefficients=(), fisheye=False):
        self.coefficients, self.fisheye = list(coefficients), fisheye

    def __call__(self, x, y):
        k = self.coefficients + [0.0] * (14 - len(self.coefficients))
        r = np.maximum(1e-12, np.hypot(x, y))
        if self.fisheye:
            a = np.arctan(r)
            gain = a * (1 + k[0] * a ** 2 + k[1] * a ** 4 + k[2] * a ** 6 + k[3] * a ** 8) / r
            return x * gain, y * gain
        r2 = r * r
        gain = (1 + k[0] * r2 + k[1] * r2 ** 2 + k[4] * r2 ** 3) / (1 + k[5] * r2 + k[6] * r2 ** 2 + k[7] * r2 ** 3)
        u = x * gain + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x) + k[8] * r2 + k[9] * r2 ** 2
        v = y * gain + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y + k[10] * r2 + k[11] * r2 ** 2
        cx, sx, cy, sy = math.cos(k[12]), math.sin(k[12]), math.cos(k[13]), math.sin(k[13])
        R = np.array([[cy, 0, -sy], [0, 1, 0], [sy, 0, cy]]) @ np.array([[1, 0, 0], [0, cx, sx], [0, -sx, cx]])
        w = np.array([[R[2, 2], 0, -R[0, 2]], [0, R[2, 2], -R[1, 2]], [0, 0, 1]]) @ R @ np.array([u, v, np.ones_like(u)])
        return w[0] / w[2], w[1] / w[2]


class Camera:
    """A camera that looks at (0, 0.9, 0), in OpenCV's pixels."""

    def __init__(self, place, lens=Lens()):
        self.place, self.lens = np.array(place, float), lens
        z = np.array([0, 0.9, 0]) - self.place
        z /= np.linalg.norm(z)
        x = np.cross(z, [0, 1, 0])
        x /= np.linalg.norm(x)
        self.R = np.array([x, np.cross(z, x), z])
        self.K = np.array([[FOCAL, 0, WIDTH / 2 - 0.5], [0, FOCAL, HEIGHT / 2 - 0.5], [0, 0, 1]])

    def pixel(self, points):
        """Returns the pixel of a point, or of each row of points."""
        p = self.R @ (points - self.place).T
        x, y = self.lens(p[0] / p[2], p[1] / p[2])
        return np.array([self.K[0, 0] * x + self.K[0, 2], self.K[1, 1] * y + self.K[1, 2]]).T

    def person(self, points):
        """Returns the pixels of named points: name → pixel."""
        return dict(zip(points, self.pixel(np.array(list(points.values())))))

    def outside(self, turn, unit, shift):
        """Returns R and T from a file's world with coordinates (turn · p + shift) / unit."""
        R = self.R @ turn.T
        return R, -R @ ((turn @ self.place + shift) / unit)


Z_UP = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], float)  # (z, x, y), the axes of Pose2Sim and QTM


def matrix_text(name, values, rows, columns):
    return (f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n   data: "
            f"[ {', '.join(repr(float(v)) for v in np.ravel(values))} ]\n")


def toml(cameras, turn, unit, shift=np.zeros(3), name="[{}]", matrix=False, extra="", change=lambda *same: same):
    """Returns cameras as Pose2Sim writes them; `change` may replace name, R, T and K."""
    text = ""
    for i, (key, camera) in enumerate(cameras.items()):
        key, R, T, K = change(key, *camera.outside(turn, unit, shift), camera.K)
        text += (f"{name.format(key, i)}\nname = \"{key}\"\nsize = [{WIDTH}, {HEIGHT}]\n"
                 f"matrix = [\n {K[0].tolist()},\n {K[1].tolist()},\n {K[2].tolist()},\n]\n"
                 f"distortions = {camera.lens.coefficients}\nrotation = {(R if matrix else rodrigues(R)).tolist()}\n"
                 f"translation = {T.tolist()}\nfisheye = {str(camera.lens.fisheye).lower()}\n{extra}\n")
    return text + "[metadata]\nerror = 0.4 # px\n"


def first_frame(cameras):
    first = next(iter(cameras.values()))
    return first.R, -first.R @ first.place


def rig_files(kind, cameras):
    """Returns a rig's files in that format, and the arguments that name the rig and its cameras."""
    turn, shift = first_frame(cameras)
    names = ",".join(cameras)
    if kind == "Pose2Sim":
        return {"rig.toml": toml(cameras, Z_UP, 1)}, "rig.toml", []
    if kind == "FreeMoCap, mm":
        return {"rig.toml": toml(cameras, Z_UP, 0.001, extra="world_position = [1, 2, 3]")}, "rig.toml", []
    if kind == "Anipose, mm, first camera's frame":
        return {"rig.toml": toml(cameras, turn, 0.001, shift)}, "rig.toml", []
    if kind == "Y down, cm":
        return {"rig.toml": toml(cameras, np.diag([1.0, -1, -1]), 0.01)}, "rig.toml", []
    if kind == "Caliscope, a board's frame":
        board = rotation((1, 0.4, 0.2), 2.0)
        return {"rig.toml": toml(cameras, board, 1, np.array([0.2, -0.4, 1]), "[cameras.{1}]", True)}, "rig.toml", []
    if kind == "EasyMocap":
        inside = "%YAML:1.0\n---\nnames:\n" + "".join(f"  - \"{name}\"\n" for name in cameras)
        outside = inside
        for name, camera in cameras.items():
            R, T = camera.outside(Z_UP, 1, np.zeros(3))
            inside += matrix_text(f"K_{name}", camera.K, 3, 3) + matrix_text(
                f"dist_{name}", camera.lens.coefficients, 1, len(camera.lens.coefficients))
            outside += matrix_text(f"R_{name}", rodrigues(R), 3, 1) + matrix_text(f"T_{name}", T, 3, 1)
        return {"rig/intri.yml": inside, "rig/extri.yml": outside}, "rig", []
    if kind == "OpenCV stereo":
        (_, a), (_, b) = list(cameras.items())[:2]
        R, T = b.outside(turn, 1, shift)
        inside = "%YAML:1.0\n---\n" + "".join(
            matrix_text(f"M{i}", c.K, 3, 3) + matrix_text(f"D{i}", c.lens.coefficients, 1, len(c.lens.coefficients))
            for i, c in ((1, a), (2, b)))
        outside = "%YAML:1.0\n---\n" + matrix_text("R", R, 3, 3) + matrix_text("T", T, 3, 1)
        return {"rig/intrinsics.yml": inside, "rig/extrinsics.yml": outside}, "rig", ["--cameras", "left,right"]
    if kind == "COLMAP":
        inside, outside = "# cameras\n", "# images\n"
        for i, (name, camera) in enumerate(cameras.items(), 1):
            R, T = camera.outside(rotation((1, 2, 3), 1.1), 0.37, np.array([1, 2, 0.5]))
            k = camera.lens.coefficients + [0.0] * 4
            w = math.sqrt(max(0, 1 + np.trace(R))) / 2
            q = [w, (R[2, 1] - R[1, 2]) / (4 * w), (R[0, 2] - R[2, 0]) / (4 * w), (R[1, 0] - R[0, 1]) / (4 * w)]
            inside += f"{i} OPENCV {WIDTH} {HEIGHT} {FOCAL} {FOCAL} {WIDTH / 2} {HEIGHT / 2} {k[0]} {k[1]} {k[2]} {k[3]}\n"
            outside += f"{i} {' '.join(map(repr, map(float, [*q, *T])))} {i} {name}.png\n\n"
        return {"rig/cameras.txt": inside, "rig/images.txt": outside}, "rig", ["--rig-unit", "0.37"]
    if kind == "Qualisys, turned":
        text = "<calibration><cameras>"
        for name, camera in cameras.items():
            R = camera.R @ Z_UP.T
            x, y, z = 1000 * Z_UP @ camera.place
            r = [*R[0], *-R[1], *-R[2]]
            text += (f"<camera serial=\"{name}\" viewrotation=\"{90 if name == 'cam2' else 0}\"><transform x=\"{x}\" "
                     f"y=\"{y}\" z=\"{z}\" "
                     + " ".join(f"r{i // 3 + 1}{i % 3 + 1}=\"{v!r}\"" for i, v in enumerate(map(float, r)))
                     + f"/><intrinsic sensorMinU=\"0\" sensorMaxU=\"{64 * WIDTH}\" sensorMinV=\"0\" sensorMaxV=\""
                     f"{64 * HEIGHT}\" focalLengthU=\"{64 * FOCAL}\" focalLengthV=\"{64 * FOCAL}\" centerPointU=\""
                     f"{64 * (WIDTH / 2 - 0.5)}\" centerPointV=\"{64 * (HEIGHT / 2 - 0.5)}\" skew=\"0\" "
                     + " ".join(f"{n}=\"{v}\"" for n, v in zip(
                         ("radialDistortion1", "radialDistortion2", "tangentalDistortion1", "tangentalDistortion2",
                          "radialDistortion3"), camera.lens.coefficients + [0.0] * 5)) + "/></camera>")
        return {"rig.qca.txt": text + "</cameras></calibration>"}, "rig.qca.txt", []
    raise KeyError(kind)


def swapped(person, only=None):
    """Returns the person with left and right exchanged."""
    other = lambda name: {"L": "R", "R": "L"}.get(name[0], name[0]) + name[1:] if name in LEFT_RIGHT else name
    legs = ("Hip", "Knee", "Ankle", "Toe", "Heel")
    return {name: person[other(name) if only is None or name.endswith(legs) else name] for name in person}


SLOW, SLOW_RATE, SLOW_FRAMES = "a film of 25 frames a second", 25, 50
NTSC, NTSC_RATE = "a film of 29.97 frames a second", 30000 / 1001
LATE_AND_NOISY = "late by 3 frames, keypoints off by 2 px"
IN_ALL_FILMS = "sides swapped in 20 frames of all films"
LEFT_RIGHT = {name for name in HALPE if name[0] in "LR" and ("L" + name[1:]) in HALPE}


def seen_people(cameras, mistake, truth):
    """Returns people[camera][frame]: a list of people, each name → pixel."""
    seen = {}
    dice = np.random.default_rng(7)
    noise_px = 2 if mistake == LATE_AND_NOISY else 0
    for name, camera in cameras.items():
        frames = []
        for k in range(SLOW_FRAMES if name == "cam2" and mistake == SLOW else FRAMES):
            time = k / RATE
            if name == "cam2":
                time = {SLOW: k / SLOW_RATE, NTSC: k / NTSC_RATE, "late by 3 frames": (k + 3) / RATE, LATE_AND_NOISY: (k + 3) / RATE,
                        "late by 0.4 frames": (k + 0.4) / RATE, "rate off by 2 %": 1.02 * k / RATE}.get(mistake, time)
            person = {key: p + noise_px * dice.normal(size=2) for key, p in camera.person(truth(time)).items()}
            people = [person]
            if mistake == "two people, identities cross":
                # A second person walks behind the first; in the picture they overlap.
                people.append(camera.person(figure(k / RATE, (1 - k / RATE, -1.1), 0.7)))
                people = people[::-1] if k % 2 else people
            is_amid = 20 <= k < 40
            if mistake == IN_ALL_FILMS and is_amid:
                people = [swapped(person)]
            if name == "cam2":
                exchanged = {"sides swapped in 20 frames": is_amid and swapped(person), "sides swapped for ever": swapped(person),
                             "legs swapped in 20 frames": is_amid and swapped(person, "legs"), "mirrored": swapped(person)}
                turned = {"turned by 180": lambda p: [WIDTH - 1 - p[0], HEIGHT - 1 - p[1]], "mirrored": lambda p: [WIDTH - 1 - p[0], p[1]],
                          "turned by 90": lambda p: [HEIGHT - 1 - p[1], p[0]]}.get(mistake, lambda p: p)
                people[0] = {key: np.array(turned(p)) for key, p in (exchanged.get(mistake) or people[0]).items()}
            frames.append(people)
        seen[name] = frames
    return seen


def write_keypoints(folder, kind, seen):
    """Writes the people of every camera in that format; returns further arguments."""
    folder.mkdir()
    names = COCO if kind in ("COCO results", "AlphaPose", "MMPose") else HALPE
    for camera, frames in seen.items():
        flat = lambda person: [float(v) for name in names for v in (*person[name], 0.9)]
        results = []
        info = []
        for k, people in enumerate(frames):
            if kind in ("OpenPose, 26", "normalised"):
                (folder / f"{camera}_json").mkdir(exist_ok=True)
                share = (lambda v: [x if i % 3 == 2 else (x + 0.5) / (WIDTH, HEIGHT)[i % 3] for i, x in enumerate(v)]) \
                    if kind == "normalised" else lambda v: v
                (folder / f"{camera}_json" / f"{camera}_{k}.json").write_text(
                    json.dumps({"people": [{"pose_keypoints_2d": share(flat(person))} for person in people]}))
            for person in people:
                results.append({"image_id": f"{k}.jpg" if kind == "AlphaPose" else k, "category_id": 1,
                                "keypoints": flat(person), "score": 2.4})
            info.append({"frame_id": k + 1, "instances": [
                {"keypoints": [[float(v) for v in person[name]] for name in names], "keypoint_scores": [0.9] * len(names)}
                for person in people]})
        if kind in ("COCO results", "AlphaPose"):
            (folder / f"{camera}.json").write_text(json.dumps(results))
        if kind == "MMPose":
            (folder / f"{camera}.json").write_text(json.dumps({"meta_info": {}, "instance_info": info}))
        if kind == "MediaPipe":
            order = ("Nose - LEye - - REye - LEar REar - - LShoulder RShoulder LElbow RElbow LWrist RWrist - - - - - - LHip "
                     "RHip LKnee RKnee LAnkle RAnkle LHeel RHeel LBigToe RBigToe").split()
            points = [{"pose_landmarks": [
                {"x": float(people[0].get(n, (0, 0))[0] + 0.5) / WIDTH, "y": float(people[0].get(n, (0, 0))[1] + 0.5) / HEIGHT,
                 "z": 0, "visibility": 0.0 if n == "-" else 0.9} for n in order]} for people in frames]
            (folder / f"{camera}.json").write_text(json.dumps(points))


def read_trc(path):
    markers = second_readers.read_trc(path)
    frames = len(next(iter(markers.values())))
    return [{name: places[k] for name, places in markers.items() if not np.isnan(places[k]).any()} for k in range(frames)]


def write_trc(path, rate, frames, truth):
    """Writes a reference as other tools do: markers in mm, Y up, at their own rate."""
    text = ("PathFileType\t4\t(X/Y/Z)\tr.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
            f"{rate}\t{rate}\t{frames}\t{len(HALPE)}\tmm\nFrame#\tTime" + "".join(f"\t{name}\t\t" for name in HALPE) + "\n\t"
            + "".join(f"\tX{i}\tY{i}\tZ{i}" for i in range(1, len(HALPE) + 1)) + "\n\n")
    for k in range(frames):
        exact = truth(k / rate)
        text += f"{k + 1}\t{k / rate:.5f}" + "".join(f"\t{1000 * v:.4f}" for name in HALPE for v in exact[name]) + "\n"
    path.write_text(text)


def errors_mm(found, truth):
    """Returns the distances after the best turn about the vertical and shift, which no rig determines. Other turns
    stay errors."""
    a, b = [], []
    for k, frame in enumerate(found):
        exact = truth(k / RATE)
        for name, p in frame.items():
            a.append(p)
            b.append(exact[name])
    a, b = np.array(a), np.array(b)
    p, q = a - a.mean(0), b - b.mean(0)
    z = np.sum((p[:, 0] - 1j * p[:, 2]).conj() * (q[:, 0] - 1j * q[:, 2]))
    turned = (p[:, 0] - 1j * p[:, 2]) * (z / abs(z))
    p = np.stack([turned.real, p[:, 1], -turned.imag], 1)
    return 1000 * np.linalg.norm(p - q, axis=1), 1000 * (a - b).mean(0)[1]


RIGS = ["Pose2Sim", "FreeMoCap, mm", "Anipose, mm, first camera's frame", "Y down, cm", "Caliscope, a board's frame",
        "EasyMocap", "OpenCV stereo", "COLMAP", "Qualisys, turned"]
KEYPOINTS = ["OpenPose, 26", "normalised", "COCO results", "AlphaPose", "MMPose", "MediaPipe"]
MISTAKES = {"none": None, "sides swapped in 20 frames": "cam2: left and right were exchanged, frames 21 to 40",
            "sides swapped for ever": "cam2: left and right were exchanged, frames 1 to 60",
            "legs swapped in 20 frames": "cam2: left and right of hips and legs were exchanged, frames 21 to 40",
            "late by 3 frames": "cam2: the film is 3.0", "late by 0.4 frames": "cam2: the film is 0.4",
            "rate off by 2 %": "and its frame rate is 29.41", "turned by 180": "cam2: pictures turned by 180",
            "turned by 90": "cam2: pictures turned by 90", "mirrored": "cam2: pictures mirrored",
            "two people, identities cross": None}


def altered_toml(change):
    return lambda cameras: ({"rig.toml": toml(cameras, Z_UP, 1, change=change)}, "rig.toml", [])


def altered_size(gain):
    """Returns EasyMocap's files, which contain no picture size, of cameras calibrated with pictures of another size."""
    def files(cameras):
        others = {name: copy.copy(camera) for name, camera in cameras.items()}
        for camera in others.values():
            camera.K = np.array([[gain * FOCAL, 0, gain * WIDTH / 2 - 0.5], [0, gain * FOCAL, gain * HEIGHT / 2 - 0.5], [0, 0, 1]])
        return rig_files("EasyMocap", others)
    return files


FLIP, EXCHANGED = np.diag([1.0, -1, -1]), {"cam1": "cam2", "cam2": "cam1"}
PADDED = (WIDTH - HEIGHT) / 2
# Mistakes outside the documentation: the rig, a change of every pixel, and the message.
STRANGERS = {
    "two cameras exchanged": (altered_toml(lambda name, R, T, K: (EXCHANGED.get(name, name), R, T, K)), None,
                              "corrected: the films or the keypoints of cam1 and cam2 are exchanged"),
    "poses from the cameras": (altered_toml(lambda name, R, T, K: (name, R.T, -R.T @ T, K)), None,
                               "corrected: the poses in the rig file are from camera to world"),
    "OpenGL's axes": (altered_toml(lambda name, R, T, K: (name, FLIP @ R, FLIP @ T, K)), None,
                      "corrected: the rig's cameras look along -z"),
    "matrices of Blender": (altered_toml(lambda name, R, T, K: (name, (FLIP @ R).T, -R.T @ T, K)), None,
                            "and the cameras look along -z"),
    "calibrated at twice the size, which is not told": (altered_size(2), None, "1280 x 960 pixels, so Etude assumes this size"),
    "calibrated at half of the size, which is not told": (altered_size(0.5), None, "320 x 240 pixels, so Etude assumes this size"),
    "keypoints of halved pictures": ("Pose2Sim", lambda p: (p + 0.5) / 2 - 0.5, "corrected: keypoints belong to pictures 0.5 times as large"),
    "shares of a padded square": ("Pose2Sim", lambda p: np.array([(p[0] + 0.5) / WIDTH, (p[1] + 0.5 + PADDED) / WIDTH]),
                                  "corrected: keypoint coordinates are fractions of the side of a square around the picture"),
    "shares of the longer side": ("Pose2Sim", lambda p: (p + 0.5) / WIDTH, "corrected: keypoint coordinates are fractions of the longer side of the picture"),
    "x and y exchanged": ("Pose2Sim", lambda p: p[::-1], "corrected: keypoints have x and y exchanged"),
    "v counted from below": ("Pose2Sim", lambda p: np.array([p[0], HEIGHT - 1 - p[1]]), "corrected: keypoints have their origin at the bottom of the picture"),
    "all films turned by 180": ("Pose2Sim", lambda p: np.array([WIDTH - 1 - p[0], HEIGHT - 1 - p[1]]),
                                "corrected: keypoints of all films are turned by 180° clockwise"),
    "all films turned by 90": ("Pose2Sim", lambda p: np.array([HEIGHT - 1 - p[1], p[0]]),
                               "corrected: keypoints of all films are turned by 90° clockwise"),
    "all films mirrored": ("Pose2Sim", lambda p: np.array([WIDTH - 1 - p[0], p[1]]), "corrected: keypoints of all films are mirrored"),
}


FEWEST = ("none", "sides swapped in 20 frames", "late by 0.4 frames", "mirrored", "turned by 180")


LIMBS = ([("MidHip", "Neck", 0.13), ("Neck", "Head", 0.09), ("LShoulder", "RShoulder", 0.07), ("LHip", "RHip", 0.1)] +
         [(side + a, side + b, radius) for side in "LR" for a, b, radius in
          (("Shoulder", "Elbow", 0.05), ("Elbow", "Wrist", 0.04), ("Hip", "Knee", 0.08), ("Knee", "Ankle", 0.055),
           ("Ankle", "BigToe", 0.04))])


def drawn(camera, person):
    """Returns a picture of the figure in red before a patterned room; without a person, the room."""
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH].astype(float)
    picture = np.stack([90 + u % 40, 100 + (v + 2 * u) % 50, 120 + 0 * u], 2)
    for a, b, radius in LIMBS if person else ():
        (ax, ay), (bx, by) = camera.pixel(person[a]), camera.pixel(person[b])
        depth = (camera.R @ (0.5 * (person[a] + person[b]) - camera.place))[2]
        along = np.clip(((u - ax) * (bx - ax) + (v - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2 + 1e-9), 0, 1)
        picture[np.hypot(u - ax - along * (bx - ax), v - ay - along * (by - ay)) < radius * FOCAL / depth] = (200, 50, 40)
    return picture.astype(np.uint8)


class Mistakes(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.films = cls.shared_folder()
        for name, size, rate, frames in (("upright", (WIDTH, HEIGHT), RATE, FRAMES), ("turned", (HEIGHT, WIDTH), RATE, FRAMES),
                                         ("slow", (WIDTH, HEIGHT), SLOW_RATE, SLOW_FRAMES),
                                         ("ntsc", (WIDTH, HEIGHT), "30000/1001", FRAMES)):
            subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", f"color=gray:size={size[0]}x{size[1]}:rate={rate}",
                            "-frames:v", str(frames), "-preset", "ultrafast", "-pix_fmt", "yuv420p", str(cls.films / f"{name}.mp4")],
                           check=True)

    def take(self, rig="Pose2Sim", keypoints="OpenPose, 26", mistake="none", cameras=None, lens=Lens(LENS[:5]),
             truth=figure, pixels=None, noise_px=0):
        """Writes a take; returns its folder, rig, films and the options that the rig needs."""
        folder = self.folder / f"take{len(list(self.folder.iterdir()))}"
        folder.mkdir()
        names = list(PLACES)[:cameras or (2 if rig == "OpenCV stereo" else 4)]
        cams = {name: Camera(PLACES[name], lens) for name in names}
        files, named, arguments = rig(cams) if callable(rig) else rig_files(rig, cams)
        for name, text in files.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(text)
        if rig == "Qualisys, turned":
            mistake = "turned by 90"
        dice = np.random.default_rng(5)
        change = lambda p: (pixels or (lambda q: q))(p + noise_px * dice.normal(size=2))
        write_keypoints(folder / "keypoints", keypoints, {
            camera: [[{name: change(p) for name, p in person.items()} for person in people] for people in frames]
            for camera, frames in seen_people(cams, mistake, truth).items()})
        for name in names:
            kind = {"turned by 90": "turned", SLOW: "slow", NTSC: "ntsc"}.get(mistake, "upright") if name == "cam2" else "upright"
            shutil.copy(self.films / f"{kind}.mp4", folder / f"{name}.mp4")
        if str(rig).startswith("Caliscope"):
            arguments = [*arguments, "--cameras", ",".join(names)]
        return folder, folder / named, [folder / f"{name}.mp4" for name in names], arguments

    def capture(self, *how, more=(), truth=figure, **named):
        """Runs a capture; returns its output and the errors in mm."""
        folder, rig, films, arguments = self.take(*how, truth=truth, **named)
        result = self.etude("capture", "--rig", rig, *films, "--keypoints",
                            folder / "keypoints", "--points", folder / "p.trc", *(() if "-o" in more else ("-o", folder / "m.csv")), *arguments, *more)
        if result.returncode != 0:
            return result.stderr, None, None
        errors, height = errors_mm(read_trc(folder / "p.trc"), truth)
        return result.stdout, errors, height

    def check(self, told, errors, most_mm=2.0, *, words=None):
        self.assertIsNotNone(errors, told)
        self.assertLess(np.percentile(errors, 99), most_mm, told)
        if words:
            self.assertIn(words, told)

    def test_every_rig_gives_the_person_back(self):
        for rig in RIGS if HEAVY else RIGS[2:9:3]:
            with self.subTest(rig):
                told, errors, height = self.capture(rig, lens=Lens(LENS[:4]))
                self.check(told, errors)
                self.assertLess(abs(height), 15, told)

    @heavy
    def test_every_lens(self):
        for lens in [Lens(LENS[:n]) for n in ((0, 14) if HEAVY else (14,))] + [Lens([-0.02, 0.004, -0.001, 0.0003], True)]:
            with self.subTest(lens.coefficients):
                self.check(*self.capture(lens=lens)[:2])

    def test_every_kind_of_keypoints(self):
        for kind in KEYPOINTS[1:] if HEAVY else KEYPOINTS[1::3]:
            with self.subTest(kind):
                self.check(*self.capture(keypoints=kind)[:2])

    def test_every_mistake_is_told_and_mended(self):
        for mistake, words in MISTAKES.items():
            for cameras in (2,) if mistake in FEWEST else (4,) if HEAVY else ():
                with self.subTest(mistake, cameras=cameras):
                    told, errors, _ = self.capture(mistake=mistake, cameras=cameras)
                    self.check(told, errors, words=words)
                    if mistake == "none":
                        for word in ("corrected", "doubtful", "turned", "exchanged"):
                            self.assertNotIn(word, told)

    # No camera contradicts another one, so nothing is mended; the person's joints jump.
    def test_sides_that_change_in_all_films_are_doubted(self):
        told, _, _ = self.capture(mistake=IN_ALL_FILMS, cameras=2)
        self.assertIn("doubtful: left and right exchange positions from one frame to the next, 2 times (first at 0.", told)

    @heavy
    def test_what_no_page_names_is_told_and_mended(self):
        for name, (rig, pixels, words) in list(STRANGERS.items())[::1 if HEAVY else 5]:
            for cameras in (2, 4) if HEAVY else (2,):
                with self.subTest(name, cameras=cameras):
                    told, errors, _ = self.capture(rig, cameras=cameras, pixels=pixels, lens=Lens(LENS[:4]))
                    self.check(told, errors, words=words)

    # Sizes and crops outside the list of known ones are doubted, with the fit, and never "corrected".
    @heavy
    def test_other_sizes_and_crops_are_doubted(self):
        crops = {"scaled by 1.304 and 1.304": lambda p: 0.7667 * p,
                 "shifted by +80 and +30 px": lambda p: p - (80, 30),
                 "scaled by 2.000 and 2.000, then shifted by +0 and -80 px": lambda p: p / 2 + (0, 40)}
        for words, pixels in list(crops.items())[::1 if HEAVY else 2]:
            with self.subTest(words):
                folder, rig, films, _ = self.take(cameras=3, pixels=pixels, lens=Lens(LENS[:4]))
                told = self.etude("capture", "--rig", rig, *films, "--keypoints", folder / "keypoints", "-o", folder / "m.csv")
                self.assertRegex(told.stdout, r"doubtful: keypoints of all films would fit the rig best .*Etude did not correct this")
                self.assertNotIn("corrected: keypoints", told.stdout)

    def remade(self, folder, name, filters, times, *arguments):
        """Makes the film of a camera again, and its keypoints at these times: files that are numbered from 0."""
        subprocess.run(["ffmpeg", "-y", "-v", "error", "-f", "lavfi", "-i", f"testsrc=size={WIDTH}x{HEIGHT}:rate={RATE}",
                        *(("-vf", filters, "-vsync", "vfr") if filters else ()), "-frames:v", str(len(times)), "-preset",
                        "ultrafast", "-pix_fmt", "yuv420p", *arguments, str(folder / f"{name}.mp4")], check=True)
        for old in (folder / "keypoints" / f"{name}_json").iterdir():
            old.unlink()
        for k, time in enumerate(times):
            person = Camera(PLACES[name]).person(figure(time))
            (folder / "keypoints" / f"{name}_json" / f"{name}_{k}.json").write_text(json.dumps(
                {"people": [{"pose_keypoints_2d": [float(v) for key in HALPE for v in (*person[key], 0.9)]}]}))

    # The times of the pictures lay them on even frames, whichever film lacks some.
    @heavy
    def test_films_of_uneven_rate(self):
        low_light = [k for k in range(FRAMES) if k < 30 or k % 2 == 0]
        for name, kept, words in (("cam1", [k for k in range(FRAMES) if not 30 <= k < 36], "missing frames: 31 to 36"),
                                  ("cam2", low_light, "14 of 59 frames are missing")):
            with self.subTest(name):
                folder, rig, films, _ = self.take(cameras=3, lens=Lens())
                picked = "+".join(rf"eq(n\,{k})" for k in kept)
                self.remade(folder, name, f"select='{picked}'", [k / RATE for k in kept])
                told = self.ends(0, "capture", "--rig", rig, *films, "--keypoints", folder / "keypoints", "--points",
                                 folder / "p.trc", "-o", folder / "m.csv")
                self.assertIn(words, told.stdout)
                errors, _ = errors_mm(read_trc(folder / "p.trc"), figure)
                self.assertLess(np.max(errors), 2.0, told.stdout)

    # A film that was cut between two key frames has more packets than pictures.
    @heavy
    def test_a_cut_film_has_the_frames_that_it_shows(self):
        folder, rig, films, _ = self.take(cameras=2, lens=Lens())
        long = folder / "long"
        long.mkdir()
        shutil.copytree(folder / "keypoints", long / "keypoints")
        self.remade(long, "cam2", "", [k / RATE for k in range(RATE + FRAMES)], "-g", "250")
        subprocess.run(["ffmpeg", "-y", "-v", "error", "-ss", "1", "-i", str(long / "cam2.mp4"), "-c", "copy", str(films[1])],
                       check=True)
        told = self.etude("capture", "--rig", rig, *films, "--keypoints", folder / "keypoints", "--points", folder / "p.trc",
                          "-o", folder / "m.csv", "--film", folder / "film.mp4")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertLess(np.max(errors_mm(read_trc(folder / "p.trc"), figure)[0]), 2.0, told.stdout)

    # The end of a film decides, not the number of its frames.
    @heavy
    def test_films_may_end_a_frame_apart(self):
        folder, rig, films, _ = self.take(cameras=2, lens=Lens())
        self.remade(folder, "cam2", "", [k / RATE for k in range(FRAMES + 1)])
        told = self.etude("capture", "--rig", rig, *films, "--keypoints", folder / "keypoints", "-o", folder / "m.csv")
        self.assertIn("cam2: the film has 61 frames, but cam1 has 60; Etude assumes that both begin at the same moment", told.stdout)
        self.remade(folder, "cam2", "", [k / RATE for k in range(FRAMES + 2)])
        told = self.etude("capture", "--rig", rig, *films, "--keypoints", folder / "keypoints", "-o", folder / "n.csv")
        self.assertIn("Cut both films so that they begin and end at the same moments", told.stderr)

    # With errors of 8 px no mistake may be reported, but exchanged cameras must still be found.
    @heavy
    def test_imprecise_keypoints_are_no_mistake_of_the_session(self):
        told, _, _ = self.capture(cameras=2, noise_px=8)
        for word in ("are exchanged", "the rig's", "keypoints are", "focal length"):
            self.assertNotIn(word, told)
        rig, _, words = STRANGERS["two cameras exchanged"]
        self.assertIn(words, self.capture(rig, cameras=2, noise_px=2)[0])

    @heavy
    def test_forecast_measures_how_keypoints_err_and_is_right_about_the_capture(self):
        for cameras, noise_px in ((2, 1.5), (3, 0.5), (4, 1.5), (4, 4)) if HEAVY else ((3, 1.5),):
            with self.subTest(cameras=cameras, noise_px=noise_px):
                folder, rig, films, _ = self.take(cameras=cameras, noise_px=noise_px)
                there = ("forecast", rig, "--middle", "0,0", "--size", "0.6,1.8,0.6", "--calibration", "0,0,0")
                told = self.facts(*there, "--films", *films, "--keypoints", folder / "keypoints")
                self.assertAlmostEqual(told["measured"]["noise_px"] / noise_px, 1, delta=0.05)
                self.assertGreater(told["measured"]["points"], 20 * FRAMES)
                elbows = [joint for joint in told["joints"] if "elbow" in joint["joint"] or "knee" in joint["joint"]]
                for joint in elbows:
                    self.assertAlmostEqual(joint["noise_px"] / noise_px, 1, delta=0.4, msg=joint)
                _, errors, _ = self.capture(cameras=cameras, noise_px=noise_px, more=("--outlier", "60"))
                expected = np.sqrt(np.mean([joint["point_mm"] ** 2 for joint in told["joints"] if joint["noise_px"]]))
                self.assertAlmostEqual(expected / np.sqrt(np.mean(np.square(errors))), 1, delta=0.15)
                assumed = self.facts(*there, "--noise-px", noise_px)
                self.assertIsNone(assumed["measured"])
                self.assertAlmostEqual(assumed["median_mm"] / told["median_mm"], 1, delta=0.05)
        refused = self.refusal(*there, "--noise-px", "1", "--films", *films, "--keypoints", folder / "keypoints")
        self.assertIn("--noise-px", refused)

    @heavy
    def test_forecast_is_right_at_thirty_places_of_twenty_rigs(self):
        frames, places = 480, 30
        truth = lambda t: figure(t, (0.6 * math.sin(0.4 * t), 0.4 * math.sin(0.8 * t)))
        self.films = self.folder / "films"
        self.films.mkdir()
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", f"color=gray:size={WIDTH}x{HEIGHT}:rate={RATE}", "-frames:v", str(frames),
                        "-preset", "ultrafast", "-pix_fmt", "yuv420p", str(self.films / "upright.mp4")], check=True)
        for number in range(20):
            dice = np.random.default_rng(number)
            angles = dice.uniform(0, 2 * math.pi) + np.cumsum(dice.uniform(0.8, 1.4, dice.integers(2, 5)))
            rig = {f"cam{i + 1}": (d * math.sin(angle), dice.uniform(0.6, 2.6), d * math.cos(angle))
                   for i, (angle, d) in enumerate(zip(angles, dice.uniform(3, 5, len(angles))))}
            noise_px = dice.uniform(0.3, 2.5)
            with self.subTest(number), unittest.mock.patch.multiple(sys.modules[__name__], FRAMES=frames, PLACES=rig):
                folder, file, films, arguments = self.take(truth=truth, noise_px=noise_px)
                self.ends(0, "capture", "--rig", file, *films, "--keypoints", folder / "keypoints", "--points", folder / "p.trc", "-o", folder / "m.csv",
                          "--outlier", "90", *arguments)
                found = read_trc(folder / "p.trc")
                points = np.array([list(frame.values()) for frame in found])  # every frame has every marker
                middle = points.mean((0, 1))
                self.ends(0, "forecast", file, "--middle", f"{middle[0]:.3f},{middle[2]:.3f}", "--size", "3,2.2,3", "--calibration", "0,0,0",
                          "--noise-px", noise_px, "--table", folder / "map.csv")
                table = np.genfromtxt(folder / "map.csv", delimiter=",", skip_header=1)
                low, cell = table[:, :3].min(0), (table[:, :3].max(0) - table[:, :3].min(0)) / (19, 9, 19)
                squares = {tuple(at): row[5] ** 2 for at, row in zip(np.rint((table[:, :3] - low) / cell).astype(int), table)}
                at = np.rint((points - low) / cell).astype(int).reshape(-1, 3)
                expected = np.array([squares[tuple(cell)] for cell in np.clip(at, 0, (19, 9, 19))])
                of_place = lambda values: np.sqrt(values.reshape(places, -1).mean(1))
                ratio = of_place(expected) / of_place(np.square(errors_mm(found, truth)[0]))
                self.assertLess(np.abs(ratio - 1).max(), 0.15, ratio)

    @heavy
    def test_focal_lengths_that_are_off_are_doubted(self):
        off = lambda films: altered_toml(lambda name, R, T, K: (name, R, T, K @ np.diag([1.05, 1.05, 1]) if name in films else K))
        cases = [("cam2", 4, 2, r"cam2: a focal length multiplied by 0\.9[56]\d ± 0\.00\d would fit the keypoints better: rays to the same keypoint would miss"),
                 (PLACES, 4, 0, r"focal lengths of all cameras multiplied by 0\.95\d ± 0\.00\d would fit")]
        if HEAVY:
            cases += [("cam2", 2, 8, r"(cam2: a focal length multiplied by 0\.9[456]\d ± 0\.0[01]\d \(or that of cam1 multiplied by 1\.0[456]|"
                                     r"cam1: a focal length multiplied by 1\.0[456]\d ± 0\.0[01]\d \(or that of cam2 multiplied by 0\.9[456])"),
                      (PLACES, 4, 0.5, r"focal lengths of all cameras multiplied by 0\.9[56]\d ± 0\.00\d"),
                      (PLACES, 2, 0.1, r"focal lengths of all cameras multiplied by 0\.9[56]\d ± 0\.00\d")]
        for films, cameras, noise_px, words in cases:
            with self.subTest(films=films, cameras=cameras, noise_px=noise_px):
                told, _, _ = self.capture(off(films), cameras=cameras, lens=Lens(), noise_px=noise_px)
                self.assertRegex(told, r"doubtful: " + words)

    # Pixels relative to a padded square make people look squat, however noisy the estimator is.
    def test_shares_of_a_square_that_err_are_doubted(self):
        rig, shares, _ = STRANGERS["shares of a padded square"]
        for cameras, noise_px in ((2, 2), (4, 2), (4, 6)) if HEAVY else ((2, 2),):
            with self.subTest(cameras=cameras, noise_px=noise_px):
                told, _, _ = self.capture(rig, cameras=cameras, pixels=shares, noise_px=noise_px)
                self.assertRegex(told, r"doubtful: the shoulder width is 0\.5\d times the leg.* fractions of the side of a square around the picture, the ratio is 0\.4|"
                                       r"corrected: keypoint coordinates are fractions of the side of a square around the picture")

    def test_a_camera_that_fits_nobody_is_named(self):
        elsewhere = altered_toml(lambda name, R, T, K: (name, R, 1000 * T if name == "cam2" else T, K))
        told, errors, _ = self.capture(elsewhere)
        self.check(told, errors, words="doubtful: cam2: nobody in this film fits the person in the other films")

    def test_films_and_references_of_other_rates(self):
        reference = self.folder / "reference.trc"
        write_trc(reference, 60, 2 * FRAMES, figure)
        told, errors, _ = self.capture(mistake=SLOW, cameras=2, more=("--reference", reference))
        self.check(told, errors, words="cam2: the film has 25 frames per second, but the first film has 30; Etude resamples the keypoints")
        self.assertIn("reference: resampled from 60 to 30 Hz", told)
        self.assertLess(float(re.search(r"^all\s+([\d.]+)", told, re.M)[1]), 1, told)

    def test_29_97_is_30_and_its_drift_is_measured(self):
        reference = self.folder / "reference.trc"
        write_trc(reference, 29.97, FRAMES - 10, figure)
        told, errors, _ = self.capture(mistake=NTSC, cameras=2, more=("--reference", reference))
        self.check(told, errors, words="cam2: the film has 29.97 frames per second, but the first film has 30; Etude assumes that both have the same rate")
        film = re.search(r"cam2: the measured clock drift is ([+-][\d.]+) frames over the film, but the frame rates of the files give \+0\.06 frames|"
                         r"cam2: the film is .*, which adds ([\d.]+) frames of delay over the film; corrected", told)
        self.assertIsNotNone(film, told)
        self.assertAlmostEqual(float(film[1] or film[2]), 0.06, delta=0.02)
        drift = re.search(r"the reference has 29.97 frames per second, but the films have 30; Etude assumes that both have the same rate; "
                          r"the measured clock drift is ([+-][\d.]+) frames", told)
        self.assertAlmostEqual(float(drift[1]), -0.06, delta=0.03, msg=told)
        self.assertIn("the reference has 50 frames, but the films have 60; only the first 50 frames are compared", told)

    # Errors of 2 px hide the delay from the automatic correction, but the report still doubts the clock.
    def test_a_late_film_of_keypoints_that_err_is_doubted_and_can_be_set(self):
        told, errors, _ = self.capture(mistake=LATE_AND_NOISY, cameras=2)
        self.assertRegex(told, r"doubtful: cam2: the film seems to be (2\.[89]|3\.[012]) frames later than cam1; use --sync 0\.2 to correct this")
        asked, by_sync, _ = self.capture(mistake=LATE_AND_NOISY, cameras=2, more=("--sync", "0.2"))
        self.assertNotIn("doubtful: cam2: the film", asked)
        self.assertLess(np.median(by_sync), 0.85 * np.median(errors))

    @heavy
    def test_the_page_tells_films_residuals_and_mends(self):
        page = self.folder / "a page.html"
        told, errors, _ = self.capture(mistake=FEWEST[1], cameras=2, more=("--report", page))
        self.check(told, errors)
        text = page.read_text()
        for line in told.splitlines():
            if line.startswith(("corrected", "rig,")) or "; corrected" in line:
                self.assertIn(line.replace("'", "&#39;"), text)
        self.assertIn("src=\"data:video/mp4;base64,", text)
        self.assertNotRegex(text, r"(src|href)=\"(?!data:|#)")
        for camera in list(PLACES)[:2]:
            row = re.search(rf"<td>{camera}</td>((<td class=\"n\">[^<]*</td>)+)", text)
            self.assertIsNotNone(row, camera)
            frames, median = re.findall(r">([\d.]+)", row[1])[:2]
            self.assertGreater(int(frames), FRAMES / 2)
            self.assertLess(float(median), 2)
        curves = re.findall(r"<path class=\"line\"[^>]* d=\"(M[^\"]+)\"", text)
        self.assertGreaterEqual(len([c for c in curves if c.count("L") > FRAMES / 2]), 4)  # two cameras × two feet
        self.assertRegex(text, r"<td>shank</td><td class=\"n\">4[23]\.")
        typed = shlex.split(html.unescape(re.search(r"<dt>Command</dt><dd>(etude capture [^<]*)</dd>", text)[1]))
        self.assertIn(str(page), typed)
        self.assertIn("already exists", self.etude(*typed[1:]).stderr, "it can be pasted")

    @unittest.skipUnless(HEAVY, "heavy")
    def test_the_page_of_outlines(self):
        frames, rate, cams = 8, 15, {name: Camera(PLACES[name]) for name in ("cam1", "cam3")}
        files, named, arguments = rig_files("Pose2Sim", cams)
        (self.folder / named).write_text(files[named])
        rooms = self.folder / "rooms"
        rooms.mkdir()
        for name, camera in cams.items():
            fast = 1 + (name == "cam3")  # cam3 has twice the frame rate
            film = np.stack([drawn(camera, figure(0.5 + k / rate / fast)) for k in range(frames * fast)])
            for pixels, path in ((film, self.folder / f"{name}.mp4"), (drawn(camera, None)[None], rooms / f"{name}.png")):
                subprocess.run(["ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{WIDTH}x{HEIGHT}",
                                "-r", str(rate * (1 + (name == "cam3"))), "-i", "-", *(("-pix_fmt", "yuv420p") if len(pixels) > 1 else ()), str(path)],
                               input=pixels.tobytes(), check=True)
        page = self.folder / "outlines.html"
        result = self.ends(0, "capture", "--rig", self.folder / named, *(self.folder / f"{name}.mp4" for name in cams), "--silhouettes",
                            "--rooms", rooms, "--stature", "1.7", "-o", self.folder / "m.csv", "--report", page, *arguments)
        self.assertNotIn("doubtful", result.stdout)
        self.assertIn("cam3: the film has 30 frames per second, but the first film has 15; Etude uses the picture that is nearest "
                      "in time, which is up to 17 ms away", result.stdout)
        text = page.read_text()
        self.assertIn("stature: 1.70 m", text)
        self.assertIn("src=\"data:video/mp4;base64,", text)
        for camera in cams:
            row = re.search(rf"<td>{camera}</td><td class=\"n\">(\d+)</td><td class=\"n\">([\d.]+)</td>", text)
            self.assertEqual(int(row[1]), frames)
            self.assertLess(float(row[2]), 20)  # per cent; the flesh is thicker than an average adult's
        self.assertNotIn("Outliers among keypoints", text)
        self.assertRegex(text, r"nothing is doubtful\.")

        # A body of half the size does not fit: nothing is written unless it is accepted.
        small = ["capture", "--rig", self.folder / named, *(self.folder / f"{name}.mp4" for name in cams), "--silhouettes", "--rooms", rooms,
                 "--stature", "0.7", "-o", self.folder / "small.csv", *arguments]
        refused = self.ends(1, *small, "--json")
        self.assertRegex(refused.stderr, r"etude: in \d+ % of the frames of \w+, body and outline overlap by less than half; Etude wrote no motion "
                                         r"\(--accept-doubtful writes it nevertheless\)\n$")
        facts = json.loads(refused.stdout)
        self.assertIsNone(facts["output"])
        self.assertIn("overlap by less than half", facts["doubt"])
        self.assertFalse((self.folder / "small.csv").exists())
        self.ends(0, *small, "--accept-doubtful")
        self.assertTrue((self.folder / "small.csv").exists())

        # The same with keypoints and outlines.
        moving = lambda t: figure(0.5 + t)
        write_keypoints(self.folder / "keypoints", "OpenPose, 26", {
            name: [[camera.person(moving(k / rate / fast))] for k in range(frames * fast)]
            for (name, camera), fast in zip(cams.items(), (1, 2))})
        write_trc(self.folder / "truth.trc", rate, frames, moving)
        both = self.ends(0, "capture", "--rig", self.folder / named, *(self.folder / f"{name}.mp4" for name in cams), "--silhouettes",
                          "--rooms", rooms, "--keypoints", self.folder / "keypoints", "-o", self.folder / "both.csv", "--reference",
                          self.folder / "truth.trc", "--report", self.folder / "both.html", *arguments)
        self.assertIn("the joints are fitted to keypoints and outlines together", both.stdout)
        self.assertLess(float(re.search(r"^all, median\s+([\d.]+)", both.stdout, re.M)[1]), 10, both.stdout)
        text = (self.folder / "both.html").read_text()
        self.assertEqual(re.findall(r"Median, (px|%)", text), ["px", "%"])
        self.assertRegex(text, r"with a median residual of [\d.]+ px; the median difference between body and outlines is \d+ %; ")

    def test_what_is_no_person_is_refused_with_the_factor(self):
        told, errors, _ = self.capture("Pose2Sim", more=("--rig-unit", "cm"))
        self.assertIsNone(errors)
        self.assertRegex(told, r"with lengths in cm, the person would have legs of 0\.008\d* m from hip to ankle; .*; "
                               r"--rig-unit m gives legs of 0\.8\d* m")
        told, errors, _ = self.capture("Pose2Sim", more=("--rig-up", "-z"))
        self.assertIsNone(errors)
        self.assertIn("with -z up, everything would be upside down", told)
        told, errors, _ = self.capture("Pose2Sim", more=("--rig-up", "up"))
        self.assertIn("allowed: auto, floor, x, y, z, -x, -y, -z", told)


ROLES = {"head": "Head"} | {f"{side}_{joint}": side[0].upper() + name for side in ("left", "right") for joint, name in (
    ("shoulder", "Shoulder"), ("elbow", "Elbow"), ("wrist", "Wrist"), ("hip", "Hip"), ("knee", "Knee"), ("ankle", "Ankle"),
    ("foot", "BigToe"))}


def poses():
    """Prints the median distance (mm) of the skeleton's joints for noisy keypoints: frame by frame, smoothed, and
    adjusted."""
    case = Mistakes()
    Mistakes.setUpClass()
    case.setUp()
    ways = {"frames": (), "smoothed at 6 Hz": ("--smooth", "6"), "bundle": ("--poses", "bundle")}
    print("| pace | cameras | px | " + " | ".join(ways) + " |\n|" + "---|" * (3 + len(ways)))
    for pace in (1, 4):
        for cameras, noise_px in ((2, 2), (2, 8), (4, 8)):
            cells = []
            for more in ways.values():
                truth = lambda t: figure(pace * t)
                told, _, _ = case.capture(cameras=cameras, noise_px=noise_px, truth=truth, more=("-o", case.folder / "m.trc",
                                                                                               "--overwrite", *more))
                off = [np.linalg.norm(frame[role] - truth(k / RATE)[name]) for k, frame in enumerate(
                    read_trc(case.folder / "m.trc")) for role, name in ROLES.items()]
                cells.append(f"{1000 * np.median(off):.1f} ({1000 * np.percentile(off, 95):.0f})")
            print(f"| {pace} | {cameras} | {noise_px} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    poses() if "--poses" in sys.argv else unittest.main()

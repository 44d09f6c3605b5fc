#!/usr/bin/env python3
"""Pose2Sim (Pagnon, Domalain and Reveret 2022) as a method of the task capture. It runs Pose2Sim's triangulation and
filter, by the documented calls `Pose2Sim.triangulation(config)` and `Pose2Sim.filtering(config)`, on the annotator's
marks.

The marks are written as HALPE_26 keypoints in OpenPose's JSON files, and the clicked points as a calibration in
Pose2Sim's TOML. Pose2Sim's TRC file gives the poses. HALPE_26 has no hands; they extend the forearms. Options:
`segmenter`, the segmenter whose marks are used (the first); `config`, settings of Pose2Sim that replace ours, such as
`{filtering: {type: kalman}}`.
"""
import contextlib
import json
import os
import pathlib
import sys
import tempfile

import etude
import numpy as np

sys.path[1:1] = [str(pathlib.Path(__file__).parents[1] / folder) for folder in ("outside-methods", "pose-estimator")]
from answer import body  # noqa: E402
from capture_triangulation_numpy import Triangulation, bridged, camera  # noqa: E402

HALPE_26 = {"left_shoulder": 5, "right_shoulder": 6, "left_elbow": 7, "right_elbow": 8, "left_wrist": 9, "right_wrist": 10,
            "left_hip": 11, "right_hip": 12, "left_knee": 13, "right_knee": 14, "left_ankle": 15, "right_ankle": 16,
            "head": 17, "shoulder_centre": 18, "left_foot": 20, "right_foot": 21}
NAMES = {"left_foot": "LBigToe", "right_foot": "RBigToe", "head": "Head", "shoulder_centre": "Neck",
         **{f"{side}_{joint}": side[0].upper() + joint.capitalize() for side in ("left", "right")
            for joint in ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")}}


def decomposed(matrix):
    """Returns the intrinsic matrix, rotation vector and translation of a 3 × 4 camera matrix (RQ decomposition)."""
    flip = np.eye(3)[::-1]
    q, r = np.linalg.qr((flip @ matrix[:, :3]).T)
    inside, rotation = flip @ r.T @ flip, flip @ q.T
    signs = np.diag(np.sign(np.diag(inside)))
    inside, rotation = inside @ signs, signs @ rotation
    scale = inside[2, 2]
    if np.linalg.det(rotation) < 0:
        rotation, scale = -rotation, -scale
    translation = np.linalg.solve(inside, matrix[:, 3]) * inside[2, 2] / scale
    angle = np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1, 1))
    values, vectors = np.linalg.eig(rotation)
    axis = np.real(vectors[:, np.argmin(abs(values - 1))])
    twist = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    return inside / inside[2, 2], angle * axis * (1 if axis @ twist >= 0 else -1), translation


def calibration(cameras):
    """Returns Pose2Sim's calibration file. Its world has Z up: its x, y, z are our z, x, y."""
    text = ""
    for number, each in enumerate(cameras, 1):
        size = each.image_width, each.image_height
        inside, rotation, translation = decomposed(camera(each.calibration) @ np.array(
            [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]]))
        text += (f"[cam_{number:02}]\nname = \"cam_{number:02}\"\nsize = {[float(x) for x in size]}\nmatrix = {inside.tolist()}\n"
                 f"distortions = [0.0, 0.0, 0.0, 0.0]\nrotation = {rotation.tolist()}\n"
                 f"translation = {translation.tolist()}\nfisheye = false\n\n")
    return text


def write_keypoints(folder, name, pixels, joints):
    """Writes one camera's keypoints; pixels: frames × joints × 2. A missing keypoint gets the likelihood 0."""
    folder.mkdir(parents=True)
    for frame, seen in enumerate(pixels):
        numbers = np.zeros((26, 3))
        for joint, number in HALPE_26.items():
            pixel = seen[joints.index(joint)]
            if np.isfinite(pixel).all():
                numbers[number] = [*pixel, 1]
        people = {"version": 1.3, "people": [{"person_id": [-1], "pose_keypoints_2d": numbers.ravel().tolist()}]}
        (folder / f"{name}_{frame:06}.json").write_text(json.dumps(people))


def read_trc(path):
    """Returns the positions of each marker by its name: {frame: [x, y, z]}."""
    lines = path.read_text().splitlines()
    markers = [name for name in lines[3].split("\t")[2:] if name]
    found = {name: {} for name in markers}
    for line in lines[5:]:
        cells = line.split("\t")
        for i, name in enumerate(markers):
            xyz = [float(cell or "nan") for cell in cells[2 + 3 * i:5 + 3 * i]]
            if len(xyz) == 3 and np.isfinite(xyz).all() and any(xyz):
                found[name][int(cells[0])] = xyz
    return found


def merged(config, more):
    return {**config, **{key: merged(config.get(key, {}), value) if isinstance(value, dict) else value
                         for key, value in more.items()}}


@etude.method(task="capture", name="pose2sim", version="1.0")
class Pose2SimMethod(Triangulation):
    def answer(self, problem):
        try:
            from Pose2Sim import Pose2Sim
        except ImportError as error:
            raise etude.NoAnswer(f"Pose2Sim is not installed ({error}): pip install pose2sim") from error
        joints = self.setting.joints
        marks = problem.marks[self.options.get("segmenter", next(iter(problem.marks)))]
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(sys.stderr):
            project = pathlib.Path(folder) / "take"
            (project / "calibration").mkdir(parents=True)
            (project / "calibration" / "Calib.toml").write_text(calibration(problem.cameras))
            for number, of_camera in enumerate(marks, 1):
                name = f"cam_{number:02}"
                write_keypoints(project / "pose" / f"{name}_json", name, self.pixels(of_camera), joints)
            config = merged({
                "project": {"project_dir": str(project), "multi_person": False, "frame_rate": round(self.setting.rate_hz),
                            "frame_range": "all"},
                "pose": {"pose_model": "Body_with_feet"},
                "triangulation": {"undistort_points": False, "show_interp_indices": False, "make_c3d": False},
                "filtering": {"display_figures": False, "save_filt_plots": False, "make_c3d": False},
                "logging": {"use_custom_logging": True}}, self.options.get("config", {}))
            before = os.getcwd()
            os.chdir(project)  # Pose2Sim looks for the folder "calibration" here
            try:
                Pose2Sim.triangulation(config)
                Pose2Sim.filtering(config)
            finally:
                os.chdir(before)
            files = sorted((project / "pose-3d").glob("*filt*.trc"))
            if not files:
                raise etude.NoAnswer("Pose2Sim wrote no filtered TRC file")
            found = read_trc(files[0])
        tracks = {}
        for joint in HALPE_26:
            seen = found.get(NAMES[joint], {})
            tracks[joint] = bridged(np.array([seen.get(frame, [np.nan] * 3) for frame in range(problem.frames)]))
            if not np.isfinite(tracks[joint]).all():
                raise etude.NoAnswer(f"Pose2Sim gives no {NAMES[joint]}")
        places = {**body(tracks, None, problem.limb_lengths_m), **tracks}
        return {"poses": np.stack([places[joint] for joint in joints], 1).reshape(problem.frames, -1).tolist()}


if __name__ == "__main__":
    etude.serve(Pose2SimMethod)

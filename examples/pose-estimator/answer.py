#!/usr/bin/python3
"""Answers an exported data set with a neural estimator, which needs no marks.

    etude export SCENARIO -o DATA
    answer.py DATA ANSWERS [--cameras N]
    etude score DATA ANSWERS -o RESULT --name movenet

Cameras are calibrated from the problem's own point pairs (DLT). Each of twelve joints is triangulated from all
pictures, weighted by the estimator's scores; where fewer than two cameras are sure of it, it is interpolated over time.
Hands, feet, head and spine are placed from the twelve by the limb lengths that every method gets. The estimator's
keypoints are kept in ANSWERS/.keypoints; later calls reuse them. The truth is not read.
"""

import argparse
import json
import pathlib
import subprocess

import numpy as np

HERE = pathlib.Path(__file__).parent
SURE = 0.2  # keypoints with a lower score are ignored
COCO = {"left_shoulder": 5, "right_shoulder": 6, "left_elbow": 7, "right_elbow": 8, "left_wrist": 9, "right_wrist": 10,
        "left_hip": 11, "right_hip": 12, "left_knee": 13, "right_knee": 14, "left_ankle": 15, "right_ankle": 16}
EARS = (3, 4)
SPINE = 0.45  # position of the spine between the hip centre (0) and the shoulder centre (1)


def calibrate(pairs):
    """Returns the 3 × 4 matrix that maps world points to pixels, by least squares after Hartley's normalisation."""
    world = np.array([pair["world_m"] for pair in pairs], float)
    pixels = np.array([pair["pixel"] for pair in pairs], float)

    def normalising(points):
        scale = np.sqrt(points.shape[1]) / np.mean(np.linalg.norm(points - points.mean(0), axis=1))
        matrix = np.eye(points.shape[1] + 1) * scale
        matrix[:-1, -1] = -scale * points.mean(0)
        matrix[-1, -1] = 1
        return matrix

    of_world, of_pixels = normalising(world), normalising(pixels)
    p = np.column_stack([world, np.ones(len(world))]) @ of_world.T
    q = np.column_stack([pixels, np.ones(len(pixels))]) @ of_pixels.T
    rows = [np.concatenate([point, np.zeros(4), -u * point]) for point, (u, v, _) in zip(p, q)]
    rows += [np.concatenate([np.zeros(4), point, -v * point]) for point, (u, v, _) in zip(p, q)]
    matrix = np.linalg.inv(of_pixels) @ np.linalg.svd(np.array(rows))[2][-1].reshape(3, 4) @ of_world
    matrix /= np.linalg.norm(matrix[2, :3])
    return matrix if np.mean(p @ np.linalg.inv(of_world).T @ matrix[2]) > 0 else -matrix


def triangulate(matrices, seen):
    """Returns the point with the least weighted pixel distances (linear; three rounds divide its rows by depth), or
    None."""
    sure = [(matrix, u, v, score) for matrix, (u, v, score) in zip(matrices, seen) if score >= SURE]
    if len(sure) < 2:
        return None
    depths = np.ones(len(sure))
    for _ in range(4):
        rows, right = [], []
        for (matrix, u, v, score), depth in zip(sure, depths):
            for row, pixel in ((0, u), (1, v)):
                line = np.sqrt(score) / depth * (matrix[row] - pixel * matrix[2])
                rows.append(line[:3])
                right.append(-line[3])
        point = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
        depths = np.array([matrix[2] @ np.append(point, 1) for matrix, *_ in sure])
        if not (depths > 0).all():
            return None
    return point


def fill(track):
    """Interpolates linearly between frames with a point, and repeats the first and the last one; None without a
    point."""
    known = [k for k, point in enumerate(track) if point is not None]
    if not known:
        return None
    values = np.array([track[k] for k in known])
    return np.stack([np.interp(range(len(track)), known, values[:, axis]) for axis in range(3)], 1)


def body(joints, ears, lengths):
    """Returns the positions of all twenty joints by name, frames × 3 each."""
    def unit(v):
        return v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-9)

    places = dict(joints)
    places["hip_centre"] = (joints["left_hip"] + joints["right_hip"]) / 2
    places["shoulder_centre"] = (joints["left_shoulder"] + joints["right_shoulder"]) / 2
    up = unit(places["shoulder_centre"] - places["hip_centre"])
    ahead = unit(np.cross(joints["left_hip"] - joints["right_hip"], up))
    places["spine"] = places["hip_centre"] + SPINE * (places["shoulder_centre"] - places["hip_centre"])
    towards = up if ears is None else unit(ears - places["shoulder_centre"])
    places["head"] = places["shoulder_centre"] + lengths["neck"] * towards
    for side in ("left", "right"):
        forearm = unit(joints[f"{side}_wrist"] - joints[f"{side}_elbow"])
        places[f"{side}_hand"] = joints[f"{side}_wrist"] + lengths["hand"] * forearm
        shank = unit(joints[f"{side}_ankle"] - joints[f"{side}_knee"])
        level = unit(ahead - np.sum(ahead * shank, axis=1, keepdims=True) * shank)
        places[f"{side}_foot"] = joints[f"{side}_ankle"] + lengths["foot"] * unit(level + 0.3 * shank)
    return places


def unpack(folder):
    """Writes the frames of an exported take's lossless films as pictures: camera-1-0000.png, …."""
    for film in folder.glob("camera-*.mkv"):
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", film, "-start_number", "0",
                        folder / f"{film.stem}-%04d.png"], check=True)


def estimate(folder, problem):
    """Returns seventeen keypoints [u, v, score] for every picture, by the picture's name."""
    unpack(folder)
    pictures = [str(folder / name) for camera in problem["cameras"] for name in camera["pictures"]]
    return json.loads(subprocess.run(["node", HERE / "estimate.mjs", *pictures], check=True, stdout=subprocess.PIPE).stdout)


def keypoints_of(folder, problem, kept):
    if not kept.exists():
        keypoints = estimate(folder, problem)
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps(keypoints))
    return json.loads(kept.read_text())


def answer(problem, keypoints, names, cameras):
    used = problem["cameras"][:cameras]
    matrices = [calibrate(camera["calibration"]) for camera in used]

    def track(number):
        return fill([triangulate(matrices, [keypoints[camera["pictures"][k]][number] for camera in used])
                     for k in range(problem["frames"])])

    joints = {name: track(number) for name, number in COCO.items()}
    if any(places is None for places in joints.values()):
        return [None] * problem["frames"]
    ears = [track(number) for number in EARS]
    both_ears = None if any(ear is None for ear in ears) else sum(ears) / 2
    places = body(joints, both_ears, problem["limb_lengths_m"])
    return [[float(x) for name in names for x in places[name][k]] for k in range(problem["frames"])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("answers", type=pathlib.Path)
    parser.add_argument("--cameras", type=int, help="the first N of each problem's cameras alone")
    arguments = parser.parse_args()
    inputs = arguments.data / "inputs"
    for path in sorted(inputs.rglob("problem.json")):
        world = path.parent.relative_to(inputs)
        problem = json.loads(path.read_text())
        names = json.loads((path.parent.parent / "setting.json").read_text())["joints"]
        keypoints = keypoints_of(path.parent, problem, (arguments.answers / ".keypoints" / world).with_suffix(".json"))
        out = (arguments.answers / world).with_suffix(".json")
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(json.dumps({"poses": answer(problem, keypoints, names, arguments.cameras)}))
        print(out)


if __name__ == "__main__":
    main()

"""Replaces Pose2Sim in tests: it has only the documented calls, files and settings. Any other use fails.

Its triangulation is linear, and its filter changes nothing. As with the original, the filtered file lacks the last
frame.
"""
import json
import math
import os
import pathlib
import re
import sys

import numpy as np

KNOWN = {"project": {"project_dir", "multi_person", "participant_height", "participant_mass", "frame_rate", "frame_range",
                     "exclude_from_batch"},
         "pose": {"pose_model"},
         "triangulation": {"reproj_error_threshold_triangulation", "likelihood_threshold_triangulation", "min_cameras_for_triangulation",
                           "interp_if_gap_smaller_than", "interpolation", "remove_incomplete_frames", "sections_to_keep", "min_chunk_size",
                           "fill_large_gaps_with", "show_interp_indices", "undistort_points", "make_c3d"},
         "filtering": {"reject_outliers", "filter", "type", "display_figures", "save_filt_plots", "make_c3d", "butterworth"},
         "logging": {"use_custom_logging"}}
HALPE_26 = {"Hip": 19, "RHip": 12, "RKnee": 14, "RAnkle": 16, "RBigToe": 21, "RSmallToe": 23, "RHeel": 25, "LHip": 11, "LKnee": 13,
            "LAnkle": 15, "LBigToe": 20, "LSmallToe": 22, "LHeel": 24, "Neck": 18, "Head": 17, "Nose": 0, "RShoulder": 6, "RElbow": 8,
            "RWrist": 10, "LShoulder": 5, "LElbow": 7, "LWrist": 9}


def __getattr__(name):
    raise AttributeError(f"Pose2Sim has no documented call {name}")


def checked(config):
    assert isinstance(config, dict), f"config is a {type(config)}"
    for section, settings in config.items():
        unknown = set(settings) - KNOWN.get(section, set())
        assert not unknown, f"unknown settings [{section}] {unknown}"
    assert isinstance(config["project"]["frame_rate"], int) and config["project"]["frame_range"] == "all"
    assert config["pose"]["pose_model"] == "Body_with_feet" and config["filtering"]["display_figures"] is False
    return pathlib.Path(config["project"]["project_dir"])


def toml(text):
    cameras = {}
    for line in filter(None, text.splitlines()):
        if line.startswith("["):
            cameras[line[1:-1]] = {}
        else:
            key, value = line.split(" = ", 1)
            cameras[list(cameras)[-1]][key] = json.loads(value)
    return cameras


def rotation(vector):
    angle = np.linalg.norm(vector)
    x, y, z = np.asarray(vector) / max(angle, 1e-12)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def triangulation(config=None):
    print("Triangulating")  # the original prints as well
    project = checked(config)
    assert pathlib.Path.cwd() == project.resolve(), "looks for its calibration in the working folder"
    files = list((project / "calibration").glob("*.toml"))
    assert len(files) == 1
    matrices = []
    for camera in toml(files[0].read_text()).values():
        assert set(camera) == {"name", "size", "matrix", "distortions", "rotation", "translation", "fisheye"}
        matrix = np.array(camera["matrix"])
        assert matrix.shape == (3, 3) and matrix[0, 0] > 0 and matrix[1, 1] > 0 and abs(matrix[2] - [0, 0, 1]).max() < 1e-9
        matrices.append(matrix @ np.column_stack([rotation(camera["rotation"]), camera["translation"]]))
    folders = sorted(name for name in os.listdir(project / "pose") if "json" in name)
    assert len(folders) == len(matrices), "as many folders of keypoints as cameras"
    films = []
    for folder in folders:
        films.append({})
        for path in (project / "pose" / folder).glob("*.json"):
            people = json.loads(path.read_text())["people"]
            assert len(people) == 1 and len(people[0]["pose_keypoints_2d"]) == 78
            films[-1][int(re.findall(r"\d+", path.name)[-1])] = np.array(people[0]["pose_keypoints_2d"]).reshape(26, 3)
    (project / "pose-3d").mkdir()
    rows = []
    for frame in range(min(map(len, films))):
        row = []
        for number in HALPE_26.values():
            lines = [seen[frame][number, k] * p[2] - p[k] for seen, p in zip(films, matrices) if seen[frame][number, 2] > 0.3 for k in (0, 1)]
            if len(lines) < 4:
                row += [0, 0, 0]
                continue
            point = np.linalg.svd(np.array([line / np.linalg.norm(line[:3]) for line in lines]))[2][-1]
            x, y, z = point[:3] / point[3]
            row += [y, z, x]  # from Z up to Y up
        rows.append([frame, frame / config["project"]["frame_rate"], *row])
    write(project, f"{project.name}_0-{len(rows) - 1}.trc", rows, config)


def write(project, name, rows, config):
    heads = [f"PathFileType\t4\t(X/Y/Z)\t{name}", "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits", f"{config['project']['frame_rate']}",
             "Frame#\tTime\t" + "\t\t\t".join(HALPE_26) + "\t\t\t",
             "\t\t" + "\t".join(f"X{i}\tY{i}\tZ{i}" for i in range(1, len(HALPE_26) + 1)) + "\t"]
    (project / "pose-3d" / name).write_text("\n".join([*heads, *("\t".join(map(repr, map(float, row))).replace(".0\t", "\t", 1) for row in rows)]) + "\n")


def filtering(config=None):
    project = checked(config)
    (path,) = (project / "pose-3d").glob("*.trc")
    lines = path.read_text().splitlines()
    rows = [[float(cell) for cell in line.split("\t")] for line in lines[5:-1]]
    kind = config["filtering"].get("type", "butterworth")
    write(project, path.name.replace(".trc", f"_filt_{kind}.trc"), rows, config)
    print("Filtered", file=sys.stdout)

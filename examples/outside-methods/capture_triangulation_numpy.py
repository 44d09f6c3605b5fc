#!/usr/bin/env python3
"""Captures motion as tools such as Pose2Sim do (Pagnon, Domalain and Reveret 2022), on numpy arrays. Cameras are
calibrated by the direct linear transformation, each joint is triangulated alone, gaps are interpolated linearly, and a
Butterworth low-pass filter runs forwards and backwards.

Joints lie at the ends of the annotator's strokes. Options: `segmenter`, the segmenter whose marks are used (the first);
`cutoff_hz`, the cutoff frequency of the filter (6; 0 = no filter); `order`, the order of both passes together, an even
number (4).
"""
import etude
import numpy as np

SPINE = 0.45  # position of the spine between the hip centre (0) and the shoulder centre (1)


def camera(points):
    """Returns the 3 × 4 matrix that maps points in metres to pixels, from at least six normalised pairs (Hartley and
    Zisserman, algorithm 7.1 without the final minimisation)."""
    world, pixels = np.array([p.world_m for p in points]), np.array([p.pixel for p in points])

    def scaled(at):
        centre, size = at.mean(axis=0), np.linalg.norm(at - at.mean(axis=0), axis=1).mean()
        matrix = np.diag([*[1 / size] * at.shape[1], 1.0])
        matrix[:-1, -1] = -centre / size
        return matrix, np.hstack([at, np.ones((len(at), 1))]) @ matrix.T

    (to_world, x), (to_pixels, u) = scaled(world), scaled(pixels)
    zero = np.zeros_like(x)
    rows = np.vstack([np.hstack([x, zero, -u[:, :1] * x]), np.hstack([zero, x, -u[:, 1:2] * x])])
    matrix = np.linalg.svd(rows)[2][-1].reshape(3, 4)
    return np.linalg.inv(to_pixels) @ matrix @ to_world


def triangulate(matrices, pixels):
    """Triangulates pixels, cameras × … × 2, NaN where a camera does not see the point. Returns … × 3, NaN where
    fewer than two cameras see it."""
    rows = [row for matrix, seen in zip(matrices, pixels)
            for row in (seen[..., :1] * matrix[2] - matrix[0], seen[..., 1:] * matrix[2] - matrix[1])]
    rows = np.stack([row / np.linalg.norm(row[..., :3], axis=-1, keepdims=True) for row in rows], axis=-2)
    seen = np.isfinite(pixels[..., 0]).sum(axis=0) >= 2
    point = np.linalg.svd(np.nan_to_num(rows))[2][..., -1, :]
    return np.where(seen[..., None], point[..., :3] / point[..., 3:], np.nan)


def bridged(track):
    """Returns a track, frames × 3, with its gaps interpolated linearly, and with the nearest value before the first
    and after the last point; NaN if the track has no point."""
    known = np.isfinite(track[:, 0])
    if not known.any():
        return track
    at = np.arange(len(track))
    return np.stack([np.interp(at, at[known], track[known, axis]) for axis in range(3)], axis=1)


def low_pass(motion, rate_hz, cutoff_hz, order):
    """Filters along the first axis with a Butterworth filter, forwards and backwards, in second-order sections by
    the bilinear transformation. The cutoff is raised, so that both passes together have the given one (Winter 2009).
    The ends are extended by point reflection."""
    if not 0 < cutoff_hz < rate_hz / 2 or len(motion) < 4:
        return motion
    sections = order // 4 or 1  # a pass has half of the order, a section the order two
    raised = cutoff_hz / (2 ** 0.5 - 1) ** (1 / (4 * sections))
    warped = np.tan(np.pi * min(raised / rate_hz, 0.49))
    pad = min(len(motion) - 1, 10)
    track = np.concatenate([2 * motion[0] - motion[pad:0:-1], motion, 2 * motion[-1] - motion[-2:-pad - 2:-1]])
    for _ in range(2):
        for section in range(sections):
            damping = 2 * np.sin(np.pi * (2 * section + 1) / (4 * sections))
            scale = 1 / (1 + damping * warped + warped ** 2)
            gain = warped ** 2 * scale
            back = 2 * (warped ** 2 - 1) * scale, (1 - damping * warped + warped ** 2) * scale
            filtered = np.empty_like(track)
            x1 = x2 = y1 = y2 = track[0]
            for frame, x in enumerate(track):
                y = gain * (x + 2 * x1 + x2) - back[0] * y1 - back[1] * y2
                filtered[frame] = y
                x1, x2, y1, y2 = x, x1, y, y1
            track = filtered
        track = track[::-1]
    return track[pad:pad + len(motion)]


@etude.method(task="capture", name="capture-triangulation-numpy", version="1.0")
class Triangulation:
    def __init__(self, setting, options):
        self.setting, self.options = setting, options

    def pixels(self, marks):
        """Returns the joints' pixels in one camera, frames × joints × 2: the mean of the ends of the strokes that
        end at a joint."""
        joints = self.setting.joints
        ends = np.full((len(marks), len(joints), 2, 2), np.nan)  # at most two strokes end at a joint
        for frame, mark in enumerate(marks):
            for line, stroke in zip(self.setting.strokes, mark["strokes"] if mark else []):
                if stroke:
                    ends[frame, joints.index(line["to"]), 0] = stroke[2:]
                    ends[frame, joints.index(line["from"]), 1] = stroke[:2]
        known = np.isfinite(ends).all(axis=-1, keepdims=True)
        return np.where(known.any(axis=2), np.where(known, ends, 0).sum(axis=2) / np.maximum(known.sum(axis=2), 1), np.nan)

    def points(self, problem):
        """Returns the joints, frames × joints × 3, metres, without gaps."""
        joints = self.setting.joints
        at = {name: joint for joint, name in enumerate(joints)}
        marks = problem.marks[self.options.get("segmenter", next(iter(problem.marks)))]
        found = triangulate([camera(each.calibration) for each in problem.cameras], np.stack([self.pixels(m) for m in marks]))
        found = np.stack([bridged(found[:, joint]) for joint in range(len(joints))], axis=1)
        found[:, at["hip_centre"]] = (found[:, at["left_hip"]] + found[:, at["right_hip"]]) / 2
        found[:, at["spine"]] = (1 - SPINE) * found[:, at["hip_centre"]] + SPINE * found[:, at["shoulder_centre"]]
        if not np.isfinite(found).all():
            raise etude.NoAnswer("a joint was never seen by two cameras")
        return found

    def answer(self, problem):
        found = self.points(problem)
        found = low_pass(found, self.setting.rate_hz, self.options.get("cutoff_hz", 6), self.options.get("order", 4))
        return {"poses": found.reshape(len(found), -1).tolist()}


if __name__ == "__main__":
    etude.serve(Triangulation)

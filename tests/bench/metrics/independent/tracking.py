"""Metrics of following a motion."""
import math

from independent import common, ik

PERCENTILE = 0.95
JERK_ORDER = 3
ROUNDING_RAD = 1e-9


def frames_solved(given, goal):
    return common.share([ik.solved(frame, goal) for frame in given["frames"]])


def percentile(given):
    counts = sorted(given["frame_iterations"])
    rank = PERCENTILE * (len(counts) - 1)
    below = int(rank)
    above = min(below + 1, len(counts) - 1)
    return counts[below] + (rank - below) * (counts[above] - counts[below])


def difference(series):
    return [after - before for before, after in zip(series, series[1:])]


def jerk(frames):
    total = 0
    for angle in zip(*frames):
        for _ in range(JERK_ORDER):
            angle = difference(angle)
        total += sum(map(abs, angle))
    return total


def jerk_ratio(given):
    frames = given["true_frames_deg"]
    truth, count = jerk(frames), max(0, len(frames) - JERK_ORDER) * len(frames[0])
    return jerk(given["found_frames_deg"]) / truth if truth > math.degrees(ROUNDING_RAD) * count else None


METRICS = {
    "frames_solved": lambda g: frames_solved(g, ik.PRACTICAL),
    "frames_solved_tight": lambda g: frames_solved(g, ik.TIGHT),
    "iterations_per_frame": lambda g: common.mean(g["frame_iterations"]),
    "iterations_per_frame_p95": percentile,
    "angle_jerk_ratio": jerk_ratio,
}

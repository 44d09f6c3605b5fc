#!/usr/bin/env python3
"""Times `etude evaluate` on pairs of motions, hours in all, and NumPy on the same arrays in the same run.

    bench/peers/evaluation_numpy.py FOLDER [--etude PROGRAM] [--hours 10] [--bvh]

FOLDER receives pairs of files of five minutes at 30 Hz: a built-in dance, and a copy with noise, another size and a
drift. NumPy computes every positional metric, vectorised, on motions without gaps. The script fails if a metric differs
by more than 1e-8 (relative for values above 1). Times are processor seconds of one thread, including reading; memory is
the peak of a process. With --bvh, only Etude is measured, on BVH files.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import time

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
import numpy as np  # noqa: E402

RATE, FRAMES, SEGMENT = 30, 9000, 100
FEET = [14, 15, 18, 19]  # indices in AllRoles: ankle and foot, left and right
BENDS = [(4, 5, 6), (8, 9, 10), (12, 13, 14), (16, 17, 18)]


def similarity(a, b):
    """Fits a similarity (Umeyama) to each pair of point sets. Returns rotations, scales, means of a and means of b."""
    mean_a, mean_b = a.mean(1, keepdims=True), b.mean(1, keepdims=True)
    x, y = a - mean_a, b - mean_b
    u, s, vt = np.linalg.svd(y.transpose(0, 2, 1) @ x)
    s[:, 2] *= np.sign(np.linalg.det(u @ vt))
    u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
    return u @ vt, s.sum(1) / (x * x).sum((1, 2)), mean_a, mean_b


def applied(fit, a, with_scale):
    turn, scale, mean_a, mean_b = fit
    moved = (a - mean_a) @ turn.transpose(0, 2, 1)
    return mean_b + (scale[:, None, None] * moved if with_scale else moved)


def distances(a, b):
    return np.sqrt(((a - b) ** 2).sum(-1))


def by_segments(a, b, fitted):
    whole = len(a) // SEGMENT * SEGMENT
    errors = []
    for part in slice(0, whole), slice(whole, None):
        if part.start is not None and part.start == len(a):
            continue
        length = min(SEGMENT, len(a[part]))
        x, y = (each[part].reshape(-1, length * each.shape[1], 3) for each in (a, b))
        few = min(fitted, length) * a.shape[1]
        errors.append(distances(applied(similarity(x[:, :few], y[:, :few]), x, True), y).ravel())
    return 1000 * np.concatenate(errors).mean()


def all_metrics(a, b):
    """Returns the metrics of an answer a and its truth b, by id; both are frames × joints × 3, metres."""
    found = {"mpjpe_unaligned_mm": 1000 * distances(a, b).mean(), "seen_share": 1.0}
    x, y = a - a[:, :1], b - b[:, :1]
    of_root = 1000 * distances(x, y)
    found["mpjpe_root_mm"] = of_root.mean()
    found["pck_150mm@mpi_inf_3dhp"] = (of_root < 150).mean()
    found["auc_150mm@mpi_inf_3dhp"] = np.mean([(of_root < limit).mean() for limit in range(0, 155, 5)])
    scale = (x * y).sum((1, 2)) / (x * x).sum((1, 2))
    found["mpjpe_root_scaled_mm"] = 1000 * distances(scale[:, None, None] * x, y).mean()
    joints = a.shape[1]
    flat_a, flat_b = a.reshape(1, -1, 3), b.reshape(1, -1, 3)
    for name, fit, points, truth in (("first_frame", similarity(a[:1], b[:1]), flat_a, flat_b),
                                     ("take", similarity(flat_a, flat_b), flat_a, flat_b), ("each_frame", similarity(a, b), a, b)):
        for ending, with_scale in ("_mm", False), ("_scaled_mm", True):
            found[f"mpjpe_{name}{ending}"] = 1000 * distances(applied(fit, points, with_scale), truth).mean()
    found["w_mpjpe_mm@wham"], found["wa_mpjpe_mm@wham"] = by_segments(a, b, 2), by_segments(a, b, SEGMENT)
    path = b[:, 0]
    off = distances(applied(similarity(a[None, :, 0], path[None]), a[None, :, 0], False)[0], path)
    found["rte@wham"] = 100 * off.mean() / distances(path[1:], path[:-1]).sum()
    off = a - b
    found["accel_error_mps2"] = RATE ** 2 * np.sqrt((np.diff(off, 2, axis=0) ** 2).sum(-1)).mean()
    found["accel_error_mm@human_dynamics"] = 1000 / RATE ** 2 * found["accel_error_mps2"]
    found["accel_error_mps2@wham"] = RATE ** 2 * np.sqrt((np.diff(x - y, 2, axis=0) ** 2).sum(-1))[1:-1].mean()
    found["jitter@wham"] = RATE ** 3 / 10 * np.sqrt((np.diff(a, 3, axis=0) ** 2).sum(-1)).mean()
    # Measure the feet with respect to the floor at height 0.
    feet = a[:, FEET]
    steps = np.sqrt((np.diff(feet, axis=0)[:, :, [0, 2]] ** 2).sum(-1))
    toes, speed = feet[:, [1, 3]], RATE * steps[:, [1, 3]]
    mean = np.stack([np.convolve(speed[:, side], np.ones(5) / 5, "same") for side in (0, 1)], 1)
    low = toes[:, :, 1] < .05
    found["skating_ratio@gmd"] = ((low[1:] & low[:-1]) & (speed > .5) & (mean > .5)).any(1).mean()
    whole = RATE * np.sqrt((np.diff(toes, axis=0) ** 2).sum(-1))
    found["skate_from_height_mps@kimodo"] = whole[low[:-1]].sum() / (low[:-1].sum() + 1e-6)
    push = RATE ** 2 * np.diff(a[:, 0], 2, axis=0)
    push[:, 1] = np.maximum(push[:, 1], 0)
    push = np.sqrt((push ** 2).sum(-1))
    slower = np.minimum(steps[1:, [0, 2]], steps[1:, [1, 3]])
    found["pfc@edge"] = 1e4 * (slower[:, 0] * slower[:, 1] * push / push.max()).mean()
    lowest = a[:, :, 1].min(1)
    found["penetration_mm"], found["floating_mm"] = 1000 * np.maximum(-lowest, 0).mean(), 1000 * np.maximum(lowest, 0).mean()
    found["bend_error_deg"] = np.abs(bends(a) - bends(b)).mean()
    return found


def bends(p):
    def angle(above, middle, below):
        u, v = p[:, middle] - p[:, above], p[:, below] - p[:, middle]
        cross = np.cross(u, v)
        return np.degrees(np.arctan2(np.sqrt((cross * cross).sum(-1)), (u * v).sum(-1)))
    return np.stack([angle(*each) for each in BENDS], 1)


def make_pairs(etude, folder, count, ending):
    """Writes `count` pairs of files into `folder`. BVH pairs are all copies of one pair."""
    for side in "t", "m":
        (folder / side).mkdir(parents=True, exist_ok=True)
    if not (folder / "groove.npz").exists():
        subprocess.run([etude, "clip", "convert", "builtin:groove", folder / "groove.npz"], check=True, stdout=subprocess.DEVNULL)
    dance = np.load(folder / "groove.npz")["positions"]
    there_and_back = np.concatenate([dance, dance[-2:0:-1]])
    truth = there_and_back[np.arange(FRAMES) % len(there_and_back)]
    dice = np.random.default_rng(61)
    for i in range(count):
        name = f"{i:03}.{ending}"
        if (folder / "m" / name).exists():
            continue
        if ending == "bvh" and i > 0:
            for side in "t", "m":
                os.link(folder / side / "000.bvh", folder / side / name)
            continue
        noise = dice.normal(0, .004, truth.shape) + np.linspace(0, .3, FRAMES)[:, None, None] * [1, 0, .2]
        for side, positions in ("t", truth + .001 * i), ("m", 1.03 * truth + noise):
            arrays = folder / side / f"{i:03}.npz"
            np.savez(arrays, positions=positions, rate_hz=float(RATE))
            if ending == "bvh":
                subprocess.run([etude, "clip", "convert", arrays, folder / side / name], check=True, stdout=subprocess.DEVNULL)
                arrays.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--etude", default="build/release/etude")
    parser.add_argument("--hours", type=float, default=10)
    parser.add_argument("--bvh", action="store_true")
    arguments = parser.parse_args()
    ending, count = "bvh" if arguments.bvh else "npz", round(arguments.hours * 12)
    folder = arguments.folder / f"{ending}-{count}"
    make_pairs(arguments.etude, folder, count, ending)

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([arguments.etude, "evaluate", folder / "t", f"m={folder / 'm'}", "--jobs", "1", "-o", folder / "run", "--overwrite"],
                          stdout=subprocess.PIPE, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    ours = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(done.stdout, end="")
    print(f"etude: {ours:.1f} CPU-s, {after.ru_maxrss / 1024:.0f} MiB, {count} pairs of {FRAMES} frames ({ending})")
    if arguments.bvh:
        return 0
    rows = {row["clip"]: row for row in map(json.loads, (folder / "run" / "cells.jsonl").read_text().splitlines())}
    begin, worst = time.process_time(), 0
    for i in range(count):
        truth, answer = (np.load(folder / side / f"{i:03}.npz")["positions"] for side in ("t", "m"))
        for name, value in all_metrics(answer, truth).items():
            worst = max(worst, abs(rows[f"{i:03}"][name] - value) / max(1, abs(value)))
            if not worst < 1e-8:
                sys.exit(f"{name} of pair {i}: NumPy {value!r}, etude {rows[f'{i:03}'][name]!r}")
    theirs = time.process_time() - begin
    print(f"NumPy: {theirs:.1f} CPU-s, {theirs / ours:.1f} times as long; largest difference {worst:.1g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

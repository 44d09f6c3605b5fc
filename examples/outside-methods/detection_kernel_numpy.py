#!/usr/bin/env python3
"""Recognises moves by kernel ridge regression on numpy arrays, trained on data that `etude export` writes.

    etude export scenarios/full/rivals_detection.yaml -o data --seed 101 --trials 160      # people who are not judged
    python3 detection_kernel_numpy.py train data -o rival.npz
    python3 detection_kernel_numpy.py rival.npz                                            # what a scenario runs

A performance is aligned with the example by the pace and the lag that fit best. The measures are each limb's deviation
from the example, its variation, and the timing; and then each of these minus what was usual for the same person earlier
in the session.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

SHARES = (np.arange(24) + 0.5) / 24        # positions in the example that are compared, as shares of its duration
LAGS_S = np.arange(-0.3, 1.21, 1 / 15)     # allowed lags of a performance
PACES = np.array([0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.35])  # allowed durations, relative to the example's
PLAIN = 3                                  # index in PACES of the example's own duration
WIDTH, RIDGE = 0.5, 0.5                    # factor in the kernel's exponent; strength of the ridge regression
TRUST = 2                                  # after this many performances, a person's own median counts for half
PRAISED = 0.9                              # share of right performances above the threshold


class Body:
    def __init__(self, joints, parents):
        self.limbs = [(joint, joints.index(parent)) for joint, parent in enumerate(parents) if parent]
        self.across = [(joints.index("left_" + part), joints.index("right_" + part)) for part in ("hip", "shoulder")]

    def limbs_of(self, poses, rate_hz):
        """Returns the directions of the limbs, frames × limbs × 3, relative to the body's heading, averaged over a
        second."""
        poses = np.asarray(poses, dtype=float).reshape(len(poses), -1, 3)
        across = sum(poses[:, left] - poses[:, right] for left, right in self.across)[:, [0, 2]]
        frames = max(1, round(rate_hz))
        sums = np.cumsum(np.concatenate([np.repeat(across[:1], frames, axis=0), across]), axis=0)
        heading = sums[frames:] - sums[:-frames]
        c, s = (heading / np.maximum(np.linalg.norm(heading, axis=1, keepdims=True), 1e-9)).T[..., None]
        limbs = np.stack([poses[:, end] - poses[:, start] for end, start in self.limbs], axis=1)
        x, y, z = np.moveaxis(limbs / np.maximum(np.linalg.norm(limbs, axis=-1, keepdims=True), 1e-9), -1, 0)
        return np.stack([c * x + s * z, y, c * z - s * x], axis=-1)


def sampled(rows, at):
    """Interpolates rows linearly at positions `at`; beyond the ends, returns the first or the last row."""
    at = np.clip(at, 0, len(rows) - 1)
    low = np.minimum(at.astype(int), max(len(rows) - 2, 0))
    part = (at - low).reshape(at.shape + (1,) * (rows.ndim - 1))
    return (1 - part) * rows[low] + part * rows[np.minimum(low + 1, len(rows) - 1)]


def measures(limbs, rate_hz, begin, end, example, example_s):
    """Returns the measures of one performance, in frames [begin, end), against the example."""
    taught = sampled(example, SHARES * (len(example) - 1))
    starts, paces = LAGS_S[None, :, None], PACES[:, None, None]
    at = np.minimum(begin + (starts + SHARES * example_s * paces) * rate_hz, end - 1)
    gaps = ((sampled(limbs, at) - taught) ** 2).sum(axis=-1).mean(axis=-1)  # paces × lags × shares
    unlikely = 0.01 * (LAGS_S - 0.2) ** 2 + 0.1 * np.log(PACES)[:, None] ** 2  # prefers usual lags and paces
    costs = gaps.mean(axis=-1)
    pace, lag = np.unravel_index(np.argmin(costs + unlikely), costs.shape)
    half = len(SHARES) // 2
    first, second = (LAGS_S[np.argmin(gaps[PLAIN, :, part].mean(axis=-1) + unlikely[PLAIN])]
                     for part in (slice(half), slice(half, None)))
    seen = sampled(limbs, at[pace, lag])
    seen_about, taught_about = seen - seen.mean(axis=0), taught - taught.mean(axis=0)
    varies, shall_vary = ((about ** 2).sum(axis=-1).mean(axis=0) for about in (seen_about, taught_about))
    together = (seen_about * taught_about).sum(axis=-1).mean(axis=0)
    return np.concatenate([
        np.sqrt(((seen - taught) ** 2).sum(axis=-1).mean(axis=0)),                    # deviation of each limb
        np.sqrt(np.maximum(varies + shall_vary - 2 * together, 0)), np.sqrt(varies),  # variation about the mean
        # 1 minus the slope of the regression on the example: the share of the example's amplitude that is missing
        1 - (together + 0.02) / (shall_vary + 0.02),
        [LAGS_S[lag], np.log(PACES[pace]), first, second, second - first, np.sqrt(costs.min()), np.sqrt(costs[PLAIN].min()),
         np.sqrt(gaps[PLAIN].min(axis=0).mean())]])


class Eyes:
    """Measures performances of known moves."""

    def __init__(self, joints, parents, moves):
        self.body = Body(joints, parents)
        self.examples = {move["name"]: (self.body.limbs_of(move["poses"], move["rate_hz"]), (len(move["poses"]) - 1) / move["rate_hz"])
                         for move in moves}

    def session(self, rate_hz, poses, events):
        """Returns the measures of each event, (move, begin, end)."""
        limbs = self.body.limbs_of(poses, rate_hz)
        return np.array([measures(limbs, rate_hz, begin, end, *self.examples[move]) for move, begin, end in events])


def with_usual(own, usual):
    """Returns the measures `own` of a session's events in order of time, and beside them the same minus the usual:
    at first all people's median, `usual`, later more and more this person's own median."""
    beyond = own - usual
    for i in range(len(own) - 1, 0, -1):
        beyond[i] -= i / (i + TRUST) * (np.median(own[:i], axis=0) - usual)
    return np.concatenate([own, beyond], axis=1)


def kernel(a, b):
    """Returns the sum of two Gaussian kernels, one for each half of the measures."""
    def gaussian(a, b):
        squares = (a ** 2).sum(axis=1)[:, None] + (b ** 2).sum(axis=1) - 2 * a @ b.T
        return np.exp(-WIDTH * squares / a.shape[1])
    half = a.shape[1] // 2
    return gaussian(a[:, :half], b[:, :half]) + gaussian(a[:, half:], b[:, half:])


def train(folders):
    """Trains the recogniser on exported folders; returns its model."""
    own, right, sessions = [], [], []
    for folder in map(pathlib.Path, folders):
        for problem_file in sorted(folder.glob("inputs/*/*/*/problem.json")):
            place = problem_file.parent.relative_to(folder / "inputs")
            setting, problem, truth = (json.loads(file.read_text()) for file in (
                problem_file.parent.parent / "setting.json", problem_file, folder / "truth" / place / "truth.json"))
            eyes = Eyes(setting["joints"], setting["parents"], setting["moves"])
            events = [(event["move"], event["begin_frame"], event["end_frame"]) for event in problem["events"]]
            own.append(eyes.session(problem["rate_hz"], [frame["pose"] for frame in problem["frames"]], events))
            right += [event["is_right"] for event in truth["events"]]
            sessions += [len(own)] * len(events)
    if len(set(right)) < 2:
        sys.exit("detection_kernel_numpy: right and wrong performances are needed, out of folders of etude export")
    usual = np.median(np.concatenate(own), axis=0)
    rows = np.concatenate([with_usual(session, usual) for session in own])
    mean, scale = rows.mean(axis=0), rows.std(axis=0) + 1e-6
    rows = (rows - mean) / scale
    right, sessions = np.array(right), np.array(sessions)
    share = np.where(right, right.mean(), 1 - right.mean())  # right and wrong performances have equal weight in total
    inverse = np.linalg.inv(kernel(rows, rows) + np.diag(2 * RIDGE * share))
    weights = inverse @ np.where(right, 1.0, -1.0)
    # Predict each session by a model trained without it (closed form of leave-one-block-out).
    left_out = np.where(right, 1.0, -1.0)
    for session in np.unique(sessions):
        block = sessions == session
        left_out[block] -= np.linalg.solve(inverse[np.ix_(block, block)], weights[block])
    threshold = np.quantile(left_out[right], 1 - PRAISED)
    print(f"{len(own)} sessions, {len(right)} performances; {np.mean(left_out[~right] < threshold):.2f} of those not right are found where "
          f"{PRAISED:g} of the right are praised, sessions left out in turn")
    return {"usual": usual, "mean": mean, "scale": scale, "rows": rows, "weights": weights, "threshold": threshold}


def serve(file):
    import etude

    known = np.load(file)

    @etude.method(task="detection", name="detection-kernel-numpy", version="1.0")
    class Kernel:
        def __init__(self, setting):
            self.eyes = Eyes(setting.joints, setting.parents,
                             [{"name": move.name, "poses": move.poses, "rate_hz": move.rate_hz} for move in setting.moves])

        def answer(self, problem):
            events = [(event.move, event.begin_frame, event.end_frame) for event in problem.events]
            if not events:
                return {"events": [], "alarms": []}
            own = self.eyes.session(problem.rate_hz, [frame.pose for frame in problem.frames], events)
            rows = (with_usual(own, known["usual"]) - known["mean"]) / known["scale"]
            scores = kernel(rows, known["rows"]) @ known["weights"]
            return {"events": [{"right_at_frame": event.end_frame - 1 if score >= known["threshold"] else None, "score": float(score)}
                               for event, score in zip(problem.events, scores)], "alarms": []}  # it reports only requested moves

    etude.serve(Kernel)


if __name__ == "__main__":
    if sys.argv[1:2] != ["train"]:
        if len(sys.argv) != 2:
            sys.exit(__doc__)
        serve(sys.argv[1])
    else:
        parser = argparse.ArgumentParser(prog="detection_kernel_numpy.py train")
        parser.add_argument("data", nargs="+", help="folders of etude export")
        parser.add_argument("-o", "--output", required=True)
        options = parser.parse_args(sys.argv[2:])
        np.savez_compressed(options.output, **train(options.data))

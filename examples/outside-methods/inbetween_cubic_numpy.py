#!/usr/bin/env python3
"""Fills gaps on numpy arrays. Each number of a pose follows a cubic that begins with the velocity of the last past
frame and ends with the mean velocity across the gap. Quaternions are then normalised."""
import etude
import numpy as np


@etude.method(task="inbetween", name="inbetween-cubic-numpy", version="1.0")
def fill(problem):
    past, target = np.array(problem.past), np.array(problem.future)[0]
    # Each rotation has two quaternions, q and -q; choose the one nearer to the quaternion in the last past frame.
    near = (past[-1, 3:].reshape(-1, 4) * target[3:].reshape(-1, 4)).sum(axis=1, keepdims=True)
    target[3:] = (target[3:].reshape(-1, 4) * np.where(near < 0, -1, 1)).ravel()
    steps = problem.gap + 1
    t = np.arange(1, steps)[:, None] / steps
    leave = (past[-1] - past[-2]) * steps
    arrive = target - past[-1]
    found = (past[-1] + leave * (t - 2 * t ** 2 + t ** 3) + arrive * (t ** 3 - t ** 2)
             + (target - past[-1]) * (3 * t ** 2 - 2 * t ** 3))
    turns = found[:, 3:].reshape(len(found), -1, 4)
    turns /= np.linalg.norm(turns, axis=-1, keepdims=True)  # a view: `found` changes
    return {"frames": found.tolist()}


if __name__ == "__main__":
    etude.serve(fill)

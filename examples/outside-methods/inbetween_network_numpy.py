#!/usr/bin/env python3
"""Fills gaps with a network. The option `weights` names its file, absolute or beside this program: NumPy's .npz with
w0, b0, w1, b1, … (tanh between layers), or .onnx (needs onnxruntime). Without it, a tiny network is trained and used.

    inbetween_network_numpy.py --make tiny.npz

For each joint and frame, the network gets 7 numbers: the position s in the gap, 0…1; the change over the whole gap at
the velocity before it; and the change to the frame after the gap (rotation vectors in radians; metres for the root's
position). It returns 3 numbers: the deviation from the straight line, divided by s(1 - s). The network fits every
skeleton, because it treats each joint alone.
"""
import pathlib
import sys

import etude
import numpy as np


def make_tiny(hidden=64, examples=4000):
    """Returns a network that has learnt random cubics: a random layer, and a layer fitted by least squares."""
    dice = np.random.default_rng(1)
    x = np.hstack([dice.uniform(0, 1, (examples, 1)), dice.normal(0, 1, (examples, 6))])
    s, leave, way = x[:, :1], x[:, 1:4], x[:, 4:]
    wanted = (1 - s) * (leave - way)  # for a cubic with velocity `leave` at the start and `way` (the mean) at the end
    w0, b0 = dice.normal(0, 0.3, (7, hidden)), dice.normal(0, 0.3, hidden)
    seen = np.hstack([np.tanh(x @ w0 + b0), np.ones((examples, 1))])
    w1 = np.linalg.lstsq(seen, wanted, rcond=None)[0]
    return {"w0": w0, "b0": b0, "w1": w1[:-1], "b1": w1[-1]}


def load(path):
    """Returns the network as a function of an array, rows × 7."""
    if path and path.endswith(".onnx"):
        import onnxruntime
        session = onnxruntime.InferenceSession(path)
        name = session.get_inputs()[0].name
        return lambda x: session.run(None, {name: x.astype(np.float32)})[0]
    weights = dict(np.load(path)) if path else make_tiny()
    layers = [(weights[f"w{i}"], weights[f"b{i}"]) for i in range(len(weights) // 2)]

    def run(x):
        for i, (w, b) in enumerate(layers):
            x = x @ w + b if i + 1 == len(layers) else np.tanh(x @ w + b)
        return x

    return run


def times(a, b):
    """Multiplies quaternions (w, x, y, z)."""
    (aw, ax, ay, az), (bw, bx, by, bz) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    return np.stack([aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw], -1)


def vectors(turns):
    """Returns the rotation vectors of quaternions; their lengths are at most π."""
    turns = turns * np.where(turns[..., :1] < 0, -1, 1)
    sine = np.linalg.norm(turns[..., 1:], axis=-1, keepdims=True)
    return turns[..., 1:] * np.where(sine < 1e-9, 2, 2 * np.arctan2(sine, turns[..., :1]) / np.maximum(sine, 1e-9))


def quaternions(turns):
    half = np.linalg.norm(turns, axis=-1, keepdims=True) / 2
    return np.concatenate([np.cos(half), turns * np.sinc(half / np.pi) / 2], -1)


@etude.method(task="inbetween", name="inbetween-network-numpy", version="1.0")
class Network:
    def __init__(self, options):
        weights = (options or {}).get("weights")
        self.network = load(str(pathlib.Path(__file__).resolve().parent / weights) if weights else None)

    def answer(self, problem):
        past, future = np.array(problem.past), np.array(problem.future)
        before, last, after = past[-2], past[-1], future[0]
        turns = last[3:].reshape(-1, 4)
        back = turns * [1, -1, -1, -1]
        # Make one row for the root's position and one for each joint's rotation, relative to the last past frame.
        relative = [np.vstack([pose[:3] - last[:3], vectors(times(back, pose[3:].reshape(-1, 4)))]) for pose in (before, after)]
        leave, way = -relative[0] * (problem.gap + 1), relative[1]
        frames = []
        for s in np.arange(1, problem.gap + 1) / (problem.gap + 1):
            detour = self.network(np.hstack([np.full((len(way), 1), s), leave, way]))
            moved = s * way + s * (1 - s) * detour
            frames.append(np.concatenate([last[:3] + moved[0], times(turns, quaternions(moved[1:])).ravel()]).tolist())
        return {"frames": frames}


if __name__ == "__main__":
    if sys.argv[1:2] == ["--make"]:
        np.savez(sys.argv[2], **make_tiny())
    else:
        etude.serve(Network)

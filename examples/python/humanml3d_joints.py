#!/usr/bin/env python3
"""humanml3d_joints.py FEATURES.npy JOINTS.npy: converts HumanML3D's 263 features to joints (frames × 22 × 3, metres,
Y up)."""
import sys
import numpy as np

x = np.load(sys.argv[1]).astype(float).reshape(-1, 263)
turn = 2 * np.concatenate([[0], np.cumsum(x[:-1, 0])])  # rotation angle of the body about Y
step = np.concatenate([np.zeros((1, 2)), x[:-1, 1:3]])  # steps of the hips on the floor, in the body's axes
local = np.concatenate([np.stack([step[:, 0], 0 * turn, step[:, 1]], 1)[:, None], x[:, 4:67].reshape(-1, 21, 3)], 1)
c, s = np.cos(turn)[:, None], np.sin(turn)[:, None]
joints = np.stack([c * local[..., 0] - s * local[..., 2], local[..., 1], s * local[..., 0] + c * local[..., 2]], 2)
hips = np.cumsum(joints[:, 0], 0)
joints[:, 0, :] = np.stack([0 * turn, x[:, 3], 0 * turn], 1)
np.save(sys.argv[2], joints + [1, 0, 1] * hips[:, None])

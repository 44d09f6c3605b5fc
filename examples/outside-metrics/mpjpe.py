"""A metric in Python: MPJPE, as `mpjpe_mm` measures it (docs/reference/metrics.md)."""
import math

import etude


def distance(a, b, joint):
    x, y, z = (a[3 * joint + axis] - b[3 * joint + axis] for axis in range(3))
    return math.sqrt(x * x + y * y + z * z)


@etude.metric("mpjpe", unit="mm")
def mpjpe(cell, setting):
    found, truth = cell.track("solution").poses, cell.track("truth").poses
    joints = len(setting.joints)
    total = 0.0
    for pose, true_pose in zip(found, truth):
        of_pose = 0.0  # not sum(), which rounds differently since Python 3.12
        for joint in range(joints):
            of_pose += distance(pose, true_pose, joint)
        total += 1000 * of_pose / joints
    return total / len(found)


if __name__ == "__main__":
    etude.serve(mpjpe)

"""Writes a person who raises both arms as rows of a Kinect v1."""
import math


def standing(left, right):
    """Returns the twenty joints (metres, in the order of roles) of a person whose straight arms are raised by these
    degrees."""
    joints = [(0, .95, 0), (0, 1.15, 0), (0, 1.42, 0), (0, 1.65, 0)]
    for side, angle in ((1, left), (-1, right)):
        s, c = side * math.sin(math.radians(angle)), -math.cos(math.radians(angle))
        joints += [(side * .18 + d * s, 1.4 + d * c, 0) for d in (0, .28, .52, .62)]
    for side in (1, -1):
        joints += [(side * .09, .92, 0), (side * .1, .5, 0), (side * .1, .08, 0), (side * .1, 0, .15)]
    return joints


def arms(high, seconds=2, rate=30, both=True):
    """Returns poses of both arms, or of the left one, rising to `high` degrees and falling."""
    poses, rest, count = [], rate // 2, int(rate * seconds)
    for t in range(-rest, count + rest):
        part = 0 if not 0 <= t < count else .5 - .5 * math.cos(2 * math.pi * t / count)
        angle = 10 + (high - 10) * part
        poses.append(standing(angle, angle if both else 10))
    return poses


def kinect(poses, tilt=0.0):
    """Returns rows of a Kinect v1 that stands 3 m away and 1 m high."""
    rows = []
    for joints in poses:
        row = []
        for x, y, z in joints:
            y, z = y - 1, 3 - z
            row += [-x, math.cos(tilt) * y + math.sin(tilt) * z, -math.sin(tilt) * y + math.cos(tilt) * z]
        rows.append(" ".join(f"{v:.6f}" for v in row))
    return "\n".join(rows) + "\n"

"""Parts that the metrics share: units, averages, the body, vectors. Other files call them as `common.…`, so that a
test can replace one by a wrong one (metrics_test.py)."""
import math

CM, MM = 100, 1000  # per metre
BONES = {  # child: parent
    "spine": "hip_centre", "shoulder_centre": "spine", "head": "shoulder_centre",
    "left_shoulder": "shoulder_centre", "left_elbow": "left_shoulder", "left_wrist": "left_elbow",
    "left_hand": "left_wrist", "right_shoulder": "shoulder_centre", "right_elbow": "right_shoulder",
    "right_wrist": "right_elbow", "right_hand": "right_wrist", "left_hip": "hip_centre", "left_knee": "left_hip",
    "left_ankle": "left_knee", "left_foot": "left_ankle", "right_hip": "hip_centre", "right_knee": "right_hip",
    "right_ankle": "right_knee", "right_foot": "right_ankle"}
ROLES = ["hip_centre", *BONES]


def mean(values):
    return math.fsum(values) / len(values) if values else None


def worst(values):
    return max(values, default=0.0)


def degrees(radians):
    return math.degrees(radians)


def share(flags):
    return sum(flags) / len(flags) if flags else None


def flat(lists):
    return [value for values in lists for value in values]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return math.fsum(x * y for x, y in zip(a, b))


def norm(a):
    return math.sqrt(dot(a, a))


def distance(a, b):
    return norm(minus(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def angle(a, b):
    return math.atan2(norm(cross(a, b)), dot(a, b))


def frames_of(motion):
    """Returns the frames of a motion, each {joint: position}."""
    joints = motion["joints_m"]
    assert set(joints) <= set(ROLES), joints.keys()
    return [{role: joints[role][f if len(joints[role]) > 1 else 0] if role in joints else [0, 0, 0] for role in ROLES}
            for f in range(motion["frames"])]


def pose_of(pose):
    assert set(pose) <= set(ROLES), pose.keys()
    return {role: pose.get(role, [0, 0, 0]) for role in ROLES}

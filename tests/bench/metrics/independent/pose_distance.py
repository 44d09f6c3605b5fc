"""Metrics of distances between poses."""
import math

CLOSE_CM = 15
JOINTS = 20
TIE_CREDIT = 0.5


def alike(given, pair):
    return pair["distance"] < given["threshold"]


def called_alike(given):
    return int(alike(given, given["pairs"][0])) if len(given["pairs"]) == 1 else None


def joint_distance(given):
    origin = [0.0, 0.0, 0.0]
    named = given["a"].keys() | given["b"].keys()
    gaps = [100 * math.dist(given["a"].get(joint, origin), given["b"].get(joint, origin)) for joint in named]
    if given["method"] == "point-cloud":
        return math.sqrt(sum(gap * gap for gap in gaps) / JOINTS)
    return sum(gaps) / JOINTS


def auc(given):
    close = [pair["distance"] for pair in given["pairs"] if pair["pose_gap_cm"] < CLOSE_CM]
    far = [pair["distance"] for pair in given["pairs"] if pair["pose_gap_cm"] >= CLOSE_CM]
    scores = [1.0 if a < b else TIE_CREDIT if a == b else 0.0 for a in close for b in far]
    return sum(scores) / len(scores) if scores else None


def f1(given):
    close = [pair["pose_gap_cm"] < CLOSE_CM for pair in given["pairs"]]
    called = [alike(given, pair) for pair in given["pairs"]]
    either = sum(close) + sum(called)
    return 2 * sum(a and b for a, b in zip(close, called)) / either if either else None


METRICS = {
    "called_alike": called_alike,
    "joint_distance_cm": joint_distance,
    "close_auc": auc,
    "close_f1": f1,
}

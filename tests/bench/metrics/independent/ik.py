"""Metrics of inverse kinematics."""
import math

from independent import common
from independent.common import angle, distance

PRACTICAL, TIGHT = 0.1, 0.001  # cm, and also degrees
PENALTY = 2
ROUNDING = 1e-6  # degrees


def effector_positions_cm(given):
    return [common.CM * distance(e["position_m"], e["target_m"]) for e in given["effectors"]]


def effector_angles_deg(given):
    return [common.mean([common.degrees(angle(a, b)) for a, b in zip(e["axes"], e["target_axes"])])
            for e in given["effectors"]]


def axis_angles_deg(given):
    return [common.degrees(angle(a, b)) for e in given["effectors"] for a, b in zip(e["axes"], e["target_axes"])]


def solved(given, goal):
    judged = {"position": [effector_positions_cm], "orientation": [axis_angles_deg],
              "both": [effector_positions_cm, axis_angles_deg]}[asked(given)]
    return int(all(common.worst(errors(given)) < goal for errors in judged))


def asked(given):
    return given.get("asked", "both")


def limit_violations(given):
    return sum(angle < lower - ROUNDING or angle > upper + ROUNDING
               for angle, (lower, upper) in zip(given["found_deg"], given["limits_deg"]))


def angle_difference(given, other):
    gaps = [(a - b + 180) % 360 - 180 for a, b in zip(given["found_deg"], given[other])]
    return math.sqrt(common.mean([gap * gap for gap in gaps]))


def penalised(given, spent, limit):
    return given[spent] if given["solved"] and given[spent] <= given[limit] else PENALTY * given[limit]


METRICS = {
    "position_error_cm": lambda g: common.mean(effector_positions_cm(g)),
    "position_error_max_cm": lambda g: common.worst(effector_positions_cm(g)),
    "orientation_error_deg": lambda g: common.mean(effector_angles_deg(g)),
    "orientation_error_max_deg": lambda g: common.worst(effector_angles_deg(g)),
    "hidden_angle_error_deg": lambda g: angle_difference(g, "true_deg"),
    "hidden_angle_change_deg": lambda g: angle_difference(g, "start_deg"),
    "solved_practical": lambda g: solved(g, PRACTICAL),
    "solved_tight": lambda g: solved(g, TIGHT),
    "limit_violations": limit_violations,
    "iterations": lambda g: g["iterations"],
    "fk_evaluations": lambda g: g["fk_evaluations"],
    "iterations_par2": lambda g: penalised(g, "iterations", "max_iterations"),
    "fk_evaluations_par2": lambda g: penalised(g, "fk_evaluations", "max_fk_evaluations"),
}

#!/usr/bin/env python3
"""A second implementation of every metric, written from docs/metrics.md alone, in Python's standard library.

    etude list metrics --json | python3 second_implementation.py

recomputes every test vector from its input, prints those that disagree, and how many agree. Exit code 1 when one
disagrees, when a metric has no vector, or when this file does not know a metric or its version.
"""
import json
import sys

from independent import capture, common, detection, ik, pose_distance, search, tracking, transition

METRICS = {  # version 1 of each, but for NEWER
    "position_error_cm": lambda g: common.mean(ik.effector_positions_cm(g)),
    "position_error_max_cm": lambda g: common.worst(ik.effector_positions_cm(g)),
    "orientation_error_deg": lambda g: common.mean(ik.effector_angles_deg(g)),
    "orientation_error_max_deg": lambda g: common.worst(ik.effector_angles_deg(g)),
    "hidden_angle_error_deg": lambda g: ik.angle_difference(g, "true_deg"),
    "hidden_angle_change_deg": lambda g: ik.angle_difference(g, "start_deg"),
    "solved_practical": lambda g: ik.solved(g, ik.PRACTICAL),
    "solved_tight": lambda g: ik.solved(g, ik.TIGHT),
    "limit_violations": ik.limit_violations,
    "iterations": lambda g: g["iterations"],
    "fk_evaluations": lambda g: g["fk_evaluations"],
    "iterations_par2": lambda g: ik.penalised(g, "iterations", "max_iterations"),
    "fk_evaluations_par2": lambda g: ik.penalised(g, "fk_evaluations", "max_fk_evaluations"),
    "frames_solved": lambda g: tracking.frames_solved(g, ik.PRACTICAL),
    "frames_solved_tight": lambda g: tracking.frames_solved(g, ik.TIGHT),
    "iterations_per_frame": lambda g: common.mean(g["frame_iterations"]),
    "iterations_per_frame_p95": tracking.percentile,
    "angle_jerk_ratio": tracking.jerk_ratio,
    "mpjpe_mm": capture.mpjpe,
    "mpjpe_before_ik_mm": lambda g: capture.mpjpe(g, "before_ik"),
    "pa_mpjpe_mm": capture.pa_mpjpe,
    "pck_50mm": lambda g: capture.joint_share(g, lambda error: error < capture.PCK_MM),
    "auc_200mm": lambda g: capture.joint_share(g, lambda error: max(0, 1 - error / capture.AUC_MM)),
    "bone_length_error_cm": capture.bone_length_error,
    "limb_direction_error_deg": capture.limb_direction_error,
    "limb_direction_coverage": lambda g: capture.coverage(g["limbs"]),
    "triangulation_error_mm": capture.triangulation_error,
    "triangulation_coverage": lambda g: capture.coverage(g["ends_m"]),
    "reprojection_rms_px": capture.reprojection,
    "frames_recovered": lambda g: common.share(g["recovered"]),
    "iou": lambda g: capture.over_images(g, lambda f, t, s: f and t, lambda f, t, s: f or t),
    "mask_precision": lambda g: capture.over_images(g, lambda f, t, s: f and t, lambda f, t, s: f),
    "mask_recall": lambda g: capture.over_images(g, lambda f, t, s: f and t, lambda f, t, s: t),
    "mask_f1": lambda g: capture.over_images(g, lambda f, t, s: 2 * (f and t), lambda f, t, s: f + t),
    "shadow_error": lambda g: capture.over_images(g, lambda f, t, s: f and s, lambda f, t, s: s),
    "jump_cm": transition.jump,
    "mean_joint_jump_cm": transition.mean_jump,
    "rotation_step_change_deg": transition.rotation_step_change,
    "jerk_peak_mps3": transition.jerk,
    "foot_slide_cmps": transition.foot_slide,
    "pose_gap_cm": transition.pose_gap,
    "velocity_gap_cmps": transition.velocity_gap,
    "false_smooth": transition.false_smooth,
    "natural_share": transition.natural,
    "wait_s": transition.wait,
    "fuzzy_distance": transition.fuzzy_distance,
    "sparc": transition.sparc,
    "ldlj": transition.ldlj,
    "direct_match": transition.direct_match,
    "matching_share": transition.matching_share,
    "false_smooth_share": transition.false_smooth_share,
    "in_between": transition.in_between,
    "search_agreement": lambda g: search.agreement(g),
    "matches_per_query": search.matches,
    "distances_per_query": lambda g: search.counted(g, "distances"),
    "boxes_per_query": lambda g: search.counted(g, "boxes"),
    "called_alike": pose_distance.called_alike,
    "joint_distance_cm": pose_distance.joint_distance,
    "close_auc": pose_distance.auc,
    "close_f1": pose_distance.f1,
    "precision": detection.precision,
    "recall": detection.recall,
    "f1": detection.f1,
    "roc_auc": detection.roc_auc,
    "latency_s": detection.latency,
    "false_alarms_per_min": detection.false_alarms,
}
NEWER = {"natural_share": 3}


def agrees(vector):
    found, expected = METRICS[vector["metric"]](vector["input"]), vector["expected"]
    if found is None or expected is None:
        return found is None and expected is None
    return abs(found - expected) <= vector["tolerance"]


def disagreements(catalogue):
    """What is wrong with the metrics of `etude list metrics --json`, one line each."""
    for metric in catalogue["metrics"]:
        if metric["id"] not in METRICS or metric["version"] != NEWER.get(metric["id"], 1):
            yield f"{metric['id']} v{metric['version']} is not known here"
        elif not metric["vectors"]:
            yield f"{metric['id']} has no test vector"
        else:
            for vector in metric["vectors"]:
                if not agrees(vector):
                    found = METRICS[metric["id"]](vector["input"])
                    yield f"{metric['id']}: \"{vector['title']}\" is {found}, expected {vector['expected']}"
    for unknown in METRICS.keys() - {metric["id"] for metric in catalogue["metrics"]}:
        yield f"{unknown} is not in the catalogue"


def main():
    catalogue = json.load(sys.stdin)
    wrong = list(disagreements(catalogue))
    print(*wrong, sep="\n", end="\n" if wrong else "")
    vectors = sum(len(metric["vectors"]) for metric in catalogue["metrics"])
    print(f"{vectors} vectors of {len(catalogue['metrics'])} metrics, {len(wrong)} disagreements")
    sys.exit(1 if wrong or vectors == 0 else 0)


if __name__ == "__main__":
    main()

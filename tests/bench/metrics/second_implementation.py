#!/usr/bin/env python3
"""A second implementation of every metric, written from docs/reference/metrics.md alone, in Python's standard library.

    etude list metrics --json | python3 second_implementation.py

recomputes every test vector from its input, prints the vectors that disagree, and the number of those that agree. Exit
code 1 if one disagrees, if a metric has no vector, or if this file does not know a metric or its version.
"""
import json
import sys

from independent import body, capture, coach, detection, evaluation, ik, plausibility, pose_distance, support, tracking
from independent import transition

DOMAINS = [ik, tracking, capture, transition, support, body, pose_distance, detection, coach, evaluation, plausibility]
METRICS = {name: function for domain in DOMAINS for name, function in domain.METRICS.items()}
NEWER = {"natural_share": 3, "solved_practical": 2, "solved_tight": 2, "iterations_par2": 2, "fk_evaluations_par2": 2,
         "frames_solved": 2, "frames_solved_tight": 2, "skipped_s": 2,
         # a flight needs a possible take-off
         "unsupported_frames": 4, "supported_share": 4, "clean_share": 5, "zmp_off_cm": 2, "slip_mps2": 2,
         "glide_cm": 2, "balance_cm": 3,
         # answers are judged at their own frames; in version 3, the root is also the file's own root joint
         **dict.fromkeys(evaluation.METRICS, 2), "lag_ms": 1,
         **dict.fromkeys(["mpjpe_root_mm", "mpjpe_root_scaled_mm", "pck_150mm@mpi_inf_3dhp", "auc_150mm@mpi_inf_3dhp", "rte@wham",
                          "accel_error_mps2@wham", "pfc@edge"], 3),
         # version 2 also counts torn joints, skating on one foot, and further kinds of pops as faults
         **dict.fromkeys(["faults", "skates_share", "skates_max_cmps", "pops", "pops_max_cm", "fault_free", "within_limits"],
                         2)}  # all other metrics are of version 1


def agrees(vector):
    found, expected = METRICS[vector["metric"]](vector["input"]), vector["expected"]
    if found is None or expected is None:
        return found is None and expected is None
    return abs(found - expected) <= vector["tolerance"]


def disagreements(catalogue):
    """Returns the faults of the metrics of `etude list metrics --json`, one line each."""
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

#!/usr/bin/env python3
"""Follows a motion by damped least squares: every frame begins at the answer to the one before."""
import ik_dls
from etude_method import run


def prepare(setting, options, files):
    return setting, options


def answer(kept, problem, files):
    setting, options = kept
    body = {key: problem[key] for key in ("joints", "angles", "effectors")}
    tree = ik_dls.prepare({**setting, **body}, options, files)
    angles, all_angles, steps = problem["start_angles_deg"], [], []
    for frame in problem["frames"]:
        found = ik_dls.answer(tree, {**frame, "start_angles_deg": angles}, files)
        angles = found["angles_deg"]
        all_angles.append(angles)
        steps.append(found["iterations"])
    return {"angles_deg": all_angles, "iterations": steps}


if __name__ == "__main__":
    run("tracking-dls-python", "1.0", prepare, answer)

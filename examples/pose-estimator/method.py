#!/usr/bin/python3
"""The neural estimator as a method that Etude asks, behind its fence (docs/outside-methods.md):

    - {name: movenet, exec: [/usr/bin/python3, examples/pose-estimator/method.py], time_s: 120}

Options: `cameras`, the first so many of each problem's cameras alone (all).
"""
import pathlib
import sys

from answer import answer, estimate

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "outside-methods"))
from etude_method import run  # noqa: E402


def prepare(setting, options, files):
    return setting["joints"], options.get("cameras")


def poses(kept, problem, files):
    joints, cameras = kept
    return {"poses": answer(problem, estimate(pathlib.Path(files), problem), joints, cameras)}


if __name__ == "__main__":
    run("movenet-lightning", "1.0", prepare, poses)

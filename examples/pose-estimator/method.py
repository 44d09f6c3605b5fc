#!/usr/bin/python3
"""The neural estimator as an outside method, which Etude runs in its fence (docs/outside-methods.md):

    - {name: movenet, exec: [/usr/bin/python3, examples/pose-estimator/method.py], time_s: 120}

Options: `cameras`, the number of each problem's cameras that are used, from the first on (all).
"""
import pathlib

import etude
from answer import answer, estimate


@etude.method(task="capture", name="movenet-lightning", version="1.0")
def poses(problem, setting, options, files):
    told = problem.to_json()
    return {"poses": answer(told, estimate(pathlib.Path(files), told), setting.joints, options.get("cameras"))}


if __name__ == "__main__":
    etude.serve(poses)

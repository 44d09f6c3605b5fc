#!/usr/bin/env python3
"""Follows a motion by damped least squares: every frame starts from the answer to the frame before."""
import etude
import ik_dls


@etude.method(task="tracking", name="tracking-dls-python", version="1.0")
class DampedLeastSquares:
    def __init__(self, setting, options):
        self.setting, self.options = setting, options

    def answer(self, problem):
        body = {key: problem.to_json()[key] for key in ("joints", "angles", "effectors")}
        tree = ik_dls.prepare({**self.setting.to_json(), **body}, self.options)
        angles, all_angles, steps = problem.start_angles_deg, [], []
        for frame in problem.frames:
            found = ik_dls.answer(tree, {**frame.to_json(), "start_angles_deg": angles})
            angles = found["angles_deg"]
            all_angles.append(angles)
            steps.append(found["iterations"])
        return {"angles_deg": all_angles, "iterations": steps}


if __name__ == "__main__":
    etude.serve(DampedLeastSquares)

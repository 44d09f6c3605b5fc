#!/usr/bin/env python3
"""Changes clips where they look most alike. Candidates are all pairs of a frame of clip `from` within the time limit
and a frame of clip `to`; it takes the pair with the smallest distance between poses (as in motion graphs: Kovar,
Gleicher, Pighin 2002).

Before poses are compared, they are aligned as Etude aligns them: by hip centre on the floor, and by heading.
"""
import math

import etude

LOOK_AHEAD = 2  # poses this many frames later are compared too, so that velocities also agree


def laid_down(pose, joints):
    """Returns the pose with its hip centre above the origin, facing along z."""
    at = {name: 3 * i for i, name in enumerate(joints)}
    x0, z0 = pose[at["hip_centre"]], pose[at["hip_centre"] + 2]
    # The body's x axis points from the right hip to the left hip.
    dx = pose[at["left_hip"]] - pose[at["right_hip"]]
    dz = pose[at["left_hip"] + 2] - pose[at["right_hip"] + 2]
    length = math.hypot(dx, dz) or 1.0
    c, s = dx / length, dz / length
    laid = []
    for i in range(0, len(pose), 3):
        x, y, z = pose[i] - x0, pose[i + 1], pose[i + 2] - z0
        laid += [c * x + s * z, y, c * z - s * x]
    return laid


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b))


@etude.method(task="transition", name="transition-nearest-python", version="1.0")
class Nearest:
    def __init__(self, setting):
        self.rate_hz = setting.rate_hz
        self.clips = [[laid_down(pose, setting.joints) for pose in clip.poses] for clip in setting.clips]

    def answer(self, problem):
        source, target = self.clips[problem.from_], self.clips[problem.to]
        first = problem.request_frame
        last = min(len(source) - 1, first + int(problem.max_wait_s * self.rate_hz))
        best = None
        for leave in range(first, last + 1):
            for enter in range(len(target) - 1):
                later = min(LOOK_AHEAD, len(source) - 1 - leave, len(target) - 1 - enter)
                gap = distance(source[leave], target[enter]) + distance(source[leave + later], target[enter + later])
                if best is None or gap < best[0]:
                    best = (gap, leave, enter)
        return {"leave_frame": best[1], "enter_frame": best[2], "join": "inertialised-spring", "matched": True}


if __name__ == "__main__":
    etude.serve(Nearest)

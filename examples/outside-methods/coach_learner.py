#!/usr/bin/env python3
"""A learner in the coach's loop: does what the coach does a third of a second later, but leaves its arms hanging in every
move that it has not been shown slowly. It never forgets, and never loses patience.
"""
from collections import deque

from etude_method import run_seat

LAG = 10  # frames


def prepare(setting, options, files):
    return setting["joints"]


def begin(joints, session, files):
    return {"joints": joints, "past": deque(maxlen=LAG), "shown": set(), "slow": None}


def hanging(pose, joints):
    """The same body with both arms down along its sides."""
    pose = list(pose)
    for side in ("left", "right"):
        chain = [joints.index(f"{side}_{joint}") for joint in ("shoulder", "elbow", "wrist", "hand")]
        for above, below in zip(chain, chain[1:]):
            length = sum((pose[3 * above + axis] - pose[3 * below + axis]) ** 2 for axis in range(3)) ** 0.5
            pose[3 * below:3 * below + 3] = [pose[3 * above], pose[3 * above + 1] - length, pose[3 * above + 2]]
    return pose


def step(memory, told, files):
    if "test" in told:
        return {"right": told["test"]["move"] in memory["shown"]}
    if told["clip"].startswith("slow_"):
        memory["shown"].add(told["clip"].removeprefix("slow_"))
    memory["past"].append(told)
    then = memory["past"][0]
    knows = then["move"] is None or then["move"] in memory["shown"]
    pose = then["pose"] if knows else hanging(then["pose"], memory["joints"])
    return {"pose": pose, "right": told["move"] in memory["shown"], "given_up": False}


if __name__ == "__main__":
    run_seat("coach-learner-python", "1.0", prepare, begin, step)

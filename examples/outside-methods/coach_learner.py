#!/usr/bin/env python3
"""A learner in the coach's loop. It repeats what the coach did a third of a second earlier, but lets its arms hang in
every move that it has not been shown slowly. It never forgets, and never gives up.
"""
from collections import deque

import etude

LAG = 10  # frames


def hanging(pose, joints):
    """Returns the pose with both arms hanging at the sides."""
    pose = list(pose)
    for side in ("left", "right"):
        chain = [joints.index(f"{side}_{joint}") for joint in ("shoulder", "elbow", "wrist", "hand")]
        for above, below in zip(chain, chain[1:]):
            length = sum((pose[3 * above + axis] - pose[3 * below + axis]) ** 2 for axis in range(3)) ** 0.5
            pose[3 * below:3 * below + 3] = [pose[3 * above], pose[3 * above + 1] - length, pose[3 * above + 2]]
    return pose


@etude.method(task="coach", seat="learner", name="coach-learner-python", version="1.0")
class Follower:
    def __init__(self, setting):
        self.joints = setting.joints

    def begin(self, session):
        self.past, self.shown = deque(maxlen=LAG), set()

    def step(self, told):
        if told.test is not None:
            return {"right": told.test.move in self.shown}
        if told.clip.startswith("slow_"):
            self.shown.add(told.clip.removeprefix("slow_"))
        self.past.append(told)
        then = self.past[0]
        knows = then.move is None or then.move in self.shown
        pose = then.pose if knows else hanging(then.pose, self.joints)
        return {"pose": pose, "right": told.move in self.shown, "given_up": False}


if __name__ == "__main__":
    etude.serve(Follower)

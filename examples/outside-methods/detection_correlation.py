#!/usr/bin/env python3
"""Recognises moves by correlation. The angles of eight joints over one performance of a move are compared with every
part of the learner's stream; where they correlate well enough, the learner has danced the move.
"""
import math

import etude

# Each triple gives the angle at its middle joint.
ANGLES = [("shoulder_centre", "left_shoulder", "left_elbow"), ("left_shoulder", "left_elbow", "left_wrist"),
          ("shoulder_centre", "right_shoulder", "right_elbow"), ("right_shoulder", "right_elbow", "right_wrist"),
          ("hip_centre", "left_hip", "left_knee"), ("left_hip", "left_knee", "left_ankle"),
          ("hip_centre", "right_hip", "right_knee"), ("right_hip", "right_knee", "right_ankle")]
ENOUGH = 0.75  # a correlation of this or more is a performance
STRIDE = 3     # every n-th frame is compared; ten frames a second are enough for a dance


def angles_of(pose, joints):
    def at(name):
        i = 3 * joints.index(name)
        return pose[i:i + 3]

    angles = []
    for a, b, c in ANGLES:
        u = [x - y for x, y in zip(at(a), at(b))]
        v = [x - y for x, y in zip(at(c), at(b))]
        cosine = sum(x * y for x, y in zip(u, v)) / ((math.hypot(*u) * math.hypot(*v)) or 1.0)
        angles.append(math.acos(max(-1.0, min(1.0, cosine))))
    return angles


def normalised(rows):
    """Returns all angles as one list of norm 1, each angle minus its mean over the rows."""
    means = [sum(column) / len(rows) for column in zip(*rows)]
    numbers = [x - m for row in rows for x, m in zip(row, means)]
    length = math.sqrt(sum(x * x for x in numbers)) or 1.0
    return [x / length for x in numbers]


@etude.method(task="detection", name="detection-correlation-python", version="1.0")
class Correlation:
    def __init__(self, setting):
        self.joints, self.moves = setting.joints, {}
        for move in setting.moves:
            if not move.poses:  # no other person has performed this move, so nothing is known about it
                continue
            step = STRIDE * move.rate_hz / 30
            count = int(len(move.poses) / step)
            self.moves[move.name] = normalised([angles_of(move.poses[int(i * step)], self.joints) for i in range(count)])

    def answer(self, problem):
        rows = [angles_of(frame.pose, self.joints) for frame in problem.frames]
        alike = {}  # for each move: last frame of a possible performance -> correlation
        for move, taught in self.moves.items():
            span = STRIDE * (len(taught) // len(ANGLES))
            alike[move] = {start + span - 1: sum(x * y for x, y in
                                                 zip(taught, normalised(rows[start:start + span:STRIDE])))
                           for start in range(0, len(rows) - span + 1, STRIDE)}
        events, alarms = [], []
        for event in problem.events:
            window = range(event.begin_frame, event.end_frame)
            seen = {end: value for end, value in alike.get(event.move, {}).items() if end in window}
            right = [end for end, value in sorted(seen.items()) if value >= ENOUGH]
            events.append({"right_at_frame": right[0] if right else None, "score": max(seen.values(), default=-1.0)})
        for move, found in alike.items():
            last = -math.inf
            for end, value in sorted(found.items()):  # raise one alarm per performance
                if value >= ENOUGH and end - last > len(self.moves[move]) // len(ANGLES) * STRIDE / 2:
                    alarms.append({"move": move, "frame": end})
                    last = end
        return {"events": events, "alarms": alarms}


if __name__ == "__main__":
    etude.serve(Correlation)

#!/usr/bin/env python3
"""A recogniser in the coach's loop. Its evidence is the correlation of the angles of eight joints, in the window so
far, with the requested move.
"""
import etude
from detection_correlation import STRIDE, angles_of, normalised


@etude.method(task="coach", seat="recogniser", name="coach-correlation-python", version="1.0")
class Correlation:
    def __init__(self, setting):
        self.joints, self.taught = setting.joints, {}
        for move in setting.moves:
            step = STRIDE * move.rate_hz / 30
            self.taught[move.name] = [angles_of(move.poses[int(i * step)], setting.joints)
                                      for i in range(int(len(move.poses) / step))]

    def begin(self, session):
        self.frame, self.rows, self.move, self.asked = 0, [], None, 0.0

    def step(self, seen):
        if seen.ask is not None:
            self.frame, self.rows, self.move, self.asked = 0, [], seen.ask.move, 0.0
        if self.move is None:
            return {"asked": 0.0}
        if self.frame % STRIDE == 0 and seen.body_seen:
            self.rows.append(angles_of(seen.pose, self.joints))
            span = self.taught[self.move]
            rows = self.rows[-len(span):]
            if len(rows) >= 0.9 * len(span):  # otherwise too little of the move has been seen
                alike = sum(x * y for x, y in zip(normalised(rows), normalised(span[-len(rows):])))
                self.asked = max(self.asked, min(1.0, max(0.0, alike)))
        self.frame += 1
        return {"asked": self.asked}


if __name__ == "__main__":
    etude.serve(Correlation)

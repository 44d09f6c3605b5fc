#!/usr/bin/env python3
"""A policy in the coach's loop: it corrects a move that went wrong twice in a row. After a correction it corrects
nothing for three performances.
"""
import etude

ENOUGH = 2
REST = 3


@etude.method(task="coach", seat="policy", name="coach-policy-python", version="1.0")
class Patient:
    def begin(self, session):
        self.wrong, self.rest = {}, 0

    def step(self, shown):
        corrects = False
        for verdict in shown.verdicts:
            self.rest = max(0, self.rest - 1)
            row = self.wrong.get(verdict.move, 0) + 1 if verdict.verdict == "wrong" else 0
            self.wrong[verdict.move] = row
            if row >= ENOUGH and self.rest == 0:
                corrects = True
                self.rest, self.wrong = REST, {}
        return {"correct": corrects}


if __name__ == "__main__":
    etude.serve(Patient)

#!/usr/bin/env python3
"""A policy in the coach's loop: a move that went wrong twice in a row is corrected, but after a correction the learner
is left alone for three performances.
"""
from etude_method import run_seat

ENOUGH = 2
REST = 3


def begin(kept, session, files):
    return {"wrong": {}, "rest": 0}


def step(memory, shown, files):
    corrects = False
    for verdict in shown["verdicts"]:
        memory["rest"] = max(0, memory["rest"] - 1)
        row = memory["wrong"].get(verdict["move"], 0) + 1 if verdict["verdict"] == "wrong" else 0
        memory["wrong"][verdict["move"]] = row
        if row >= ENOUGH and memory["rest"] == 0:
            corrects = True
            memory.update(rest=REST, wrong={})
    return {"correct": corrects}


if __name__ == "__main__":
    run_seat("coach-policy-python", "1.0", lambda setting, options, files: None, begin, step)

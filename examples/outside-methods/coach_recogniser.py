#!/usr/bin/env python3
"""A recogniser in the coach's loop: how well the angles of eight joints, as far as the window goes, correlate with the
move asked for.
"""
from detection_correlation import STRIDE, angles_of, normalised
from etude_method import run_seat


def prepare(setting, options, files):
    taught = {}
    for move in setting["moves"]:
        step = STRIDE * move["rate_hz"] / 30
        taught[move["name"]] = [angles_of(move["poses"][int(i * step)], setting["joints"])
                                for i in range(int(len(move["poses"]) / step))]
    return setting["joints"], taught


def begin(kept, session, files):
    return {"kept": kept, "frame": 0, "rows": [], "move": None, "asked": 0.0}


def step(memory, seen, files):
    joints, taught = memory["kept"]
    if "ask" in seen:
        memory.update(move=seen["ask"]["move"], frame=0, rows=[], asked=0.0)
    if memory["move"] is None:
        return {"asked": 0.0}
    if memory["frame"] % STRIDE == 0 and seen["body_seen"]:
        memory["rows"].append(angles_of(seen["pose"], joints))
        span = taught[memory["move"]]
        rows = memory["rows"][-len(span):]
        if len(rows) >= 0.9 * len(span):  # else too little of the move has been seen
            alike = sum(x * y for x, y in zip(normalised(rows), normalised(span[-len(rows):])))
            memory["asked"] = max(memory["asked"], min(1.0, max(0.0, alike)))
    memory["frame"] += 1
    return {"asked": memory["asked"]}


if __name__ == "__main__":
    run_seat("coach-correlation-python", "1.0", prepare, begin, step)

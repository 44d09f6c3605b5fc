"""Faults of motions without a truth; each fault has a kind, a time and a size."""
from . import common


def sizes(given, kind):
    return [fault["size"] for fault in given["faults"] if fault["kind"] == kind]


def share(kind):
    def value(given):
        times = [(fault["from_s"], fault["to_s"]) for fault in given["faults"] if fault["kind"] == kind]
        # No fault starts or stops between two neighbours in `ends`, so faults cover such an interval wholly or not.
        ends = sorted({end for time in times for end in time})
        covered = sum(b - a for a, b in zip(ends, ends[1:]) if any(f <= a and b <= t for f, t in times))
        return min(covered / given["duration_s"], 1)
    return value


def largest(kind, factor):
    return lambda given: factor() * max(sizes(given, kind), default=0)


def count(kind):
    return lambda given: len(sizes(given, kind))


def within(given):
    if not given["limits"]:
        return None
    return int(all(given["values"].get(name, 0) <= limit for name, limit in given["limits"].items()))


METRICS = {
    "faults": lambda given: len(given["faults"]),
    **{f"{kind}_share": share(kind) for kind in ("floats", "sinks", "skates", "freezes", "gaps", "bends", "passes")},
    **{f"{kind}_max_cm": largest(kind, lambda: common.CM) for kind in ("floats", "sinks", "jumps", "pops", "torn")},
    "skates_max_cmps": largest("skates", lambda: common.CM),
    "stretches_max_percent": largest("stretches", lambda: 100),
    "bends_max_deg": largest("bends", lambda: 1),
    "jumps": count("jumps"),
    "pops": count("pops"),
    "wrong_rate": lambda given: int(bool(sizes(given, "rate") + sizes(given, "speed"))),
    "fault_free": lambda given: int(not given["faults"]),
    "within_limits": within,
}

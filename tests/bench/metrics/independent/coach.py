"""Metrics of a coached session."""
import statistics

from independent import common

PERCENTILE = 0.95
uncaused = True  # a correction without a cause is needless


def is_right(truth):
    return truth == "right"


def is_wrong(truth):
    return truth == "wrong"


def minutes(given):
    return given["frames"] / given["rate_hz"] / 60


def mistakes(given):
    return [i for i, performance in enumerate(given["performances"]) if is_wrong(performance["truth"])]


def next_end(given, i):
    """Returns the last frame in which a correction still answers performance i."""
    later = given["performances"][i + 1:]
    return later[0]["end_frame"] if later else given["frames"]


def missed(given):
    def answered(i):
        begin = given["performances"][i]["end_frame"]
        return any(begin <= correction["decided_frame"] <= next_end(given, i) for correction in given["corrections"])
    return [i for i in mistakes(given) if not answered(i)]


def unneeded(given):
    def needless(correction):
        closed = [p["truth"] for p in given["performances"] if p["end_frame"] <= correction["decided_frame"]]
        return is_right(closed[-1]) if closed else uncaused
    return [correction for correction in given["corrections"] if needless(correction)]


def per_minute(count):
    return lambda given: len(count(given)) / minutes(given)


def kaplan_meier_median(waits):
    surviving = 1.0
    for time in sorted({time for time, happened in waits if happened}):
        at_risk = sum(waited >= time for waited, _ in waits)
        surviving *= 1 - sum(waited == time and happened for waited, happened in waits) / at_risk
        if surviving <= 0.5 + 1e-12:
            return time
    return None


def delay(given, begin, end, given_up):
    frame = end if end is not None else given_up
    return (frame - begin) / given["rate_hz"], end is not None


def decision_delay(given):
    wrong = [given["performances"][i] for i in mistakes(given)]
    return kaplan_meier_median(
        [delay(given, p["begin_frame"], p["called_wrong"], p["end_frame"]) for p in wrong])


def feedback_delay(given):
    return kaplan_meier_median([delay(given, correction["decided_frame"], correction["act_frame"], given["frames"])
                                for correction in given["corrections"]])


def longest_feedback_delay(given):
    begun = [c for c in given["corrections"] if c["act_frame"] is not None]
    return max(((c["act_frame"] - c["decided_frame"]) / given["rate_hz"] for c in begun), default=None)


def repetitions_until_right(given):
    waits = []
    for truths in given["moves"]:
        if truths and is_wrong(truths[0]):
            right = next((i for i, truth in enumerate(truths) if is_right(truth)), None)
            waits.append((len(truths), False) if right is None else (right + 1, True))
    return kaplan_meier_median(waits)


def percentile(values):
    rank = PERCENTILE * (len(values) - 1)
    below = sorted(values)[int(rank)]
    above = sorted(values)[min(int(rank) + 1, len(values) - 1)]
    return below + (rank - int(rank)) * (above - below)


def natural_share(given):
    limit = percentile(given["natural_jumps_cm"]) * (1 + 1e-9)
    return common.share([jump <= limit for jump in given["jumps_cm"]])


METRICS = {
    "corrections_due_per_min": per_minute(mistakes),
    "corrections_given_per_min": per_minute(lambda given: given["corrections"]),
    "corrections_missed_per_min": per_minute(missed),
    "corrections_unneeded_per_min": per_minute(unneeded),
    "answered_share": lambda given: common.share([i not in missed(given) for i in mistakes(given)]),
    "wrong_praise_per_min": per_minute(
        lambda given: [i for i in mistakes(given) if given["performances"][i]["called_right"]]),
    "decision_delay_s": decision_delay,
    "feedback_delay_s": feedback_delay,
    "feedback_delay_max_s": longest_feedback_delay,
    "repetitions_until_right": repetitions_until_right,
    "retention": lambda given: common.mean(given["chances"]),
    "danced_share": lambda given: given["danced_frames"] / given["frames"],
    "gave_up": lambda given: float(given["given_up"]),
    "beat_error_ms": lambda given: percentile([1000 * abs(e) for e in given["errors_s"]]) if given["errors_s"] else None,
    "transition_jump_cm": lambda given: statistics.median(given["jumps_cm"]) if given["jumps_cm"] else None,
    "transition_natural_share": natural_share,
    "transition_bridged_share": lambda given: common.share(
        [i < given["bridged"] for i in range(given["transitions"])]),
}

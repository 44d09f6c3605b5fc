"""Metrics of move detection."""
from independent import common

POINT_TOLERANCE_S = 0.333


def precision(given):
    return common.share([event["right"] for event in given["events"] if event["called"]])


def recall(given):
    return common.share([event["called"] for event in given["events"] if event["right"]])


def f1(given):
    both = sum(event["right"] and event["called"] for event in given["events"])
    either = sum(event["right"] + event["called"] for event in given["events"])
    return 2 * both / either if either else None


def fault_found(given):
    return common.share([not each["called"] for each in given["rehearsals"] if each["severity"] > 0])


def grey_called_right(given):
    return common.share([each["called"] for each in given["graded"] if each["truth"] == "grey"])


def right_spotted(given):
    return common.share([any(call["move"] == each["move"] and each["begin_frame"] <= call["frame"] < each["end_frame"]
                             for call in given["calls"])
                         for each in given["asked"] if each["right"]])


def move_named(given):
    return common.share([each["named"] == each["danced"] for each in given["dances"]])


def action_point_f(given):
    scores = []
    for move in sorted({each["move"] for each in given["points"] + given["detections"]}):
        points = [each["at_s"] for each in given["points"] if each["move"] == move]
        detections = [each["at_s"] for each in given["detections"] if each["move"] == move]
        scores.append(2 * most_pairs(points, detections) / (len(points) + len(detections)))
    return common.mean(scores)


def most_pairs(points, detections):
    """Returns the size of a maximum matching in a bipartite graph, by augmenting paths (Kuhn), without using the
    order in time."""
    taken = {}

    def place(point, seen):
        for index, detection in enumerate(detections):
            if index in seen or abs(detection - points[point]) > POINT_TOLERANCE_S + 1e-9:
                continue
            seen.add(index)
            if index not in taken or place(taken[index], seen):
                taken[index] = point
                return True
        return False

    return sum(place(point, set()) for point in range(len(points)))


def roc_auc(given):
    right = [event["score"] for event in given["events"] if event["right"]]
    wrong = [event["score"] for event in given["events"] if not event["right"]]
    return common.mean([1.0 if a > b else tie_credit() if a == b else 0.0 for a in right for b in wrong])


def tie_credit():
    return 0.5


def latency(given):
    waits = []
    for event in given["performances"]:
        called = event["called_frame"] is not None
        frame = event["called_frame"] if called else event["window_end_frame"]
        waits.append((frame / given["rate_hz"] - event["first_right_s"], called))
    return kaplan_meier_median(waits)


def kaplan_meier_median(waits):
    surviving = 1.0
    for time in sorted({seconds for seconds, called in waits if called}):
        at_risk = sum(seconds >= time for seconds, _ in waits)
        happened = sum(seconds == time and called for seconds, called in waits)
        surviving *= 1 - happened / at_risk
        if surviving <= 0.5 + 1e-12:
            return time
    return None


def false_alarms(given):
    def excused(call):
        return any(call["move"] in (window["asked"], window["danced"]) and
                   window["begin_frame"] <= call["frame"] < window["end_frame"] for window in given["windows"])
    alarms = sum(not excused(call) for call in given["calls"])
    return alarms / (given["frames"] / given["rate_hz"] / 60)


METRICS = {
    "precision": precision,
    "recall": recall,
    "f1": f1,
    "fault_found": fault_found,
    "grey_called_right": grey_called_right,
    "right_spotted": right_spotted,
    "move_named": move_named,
    "action_point_f": action_point_f,
    "roc_auc": roc_auc,
    "latency_s": latency,
    "false_alarms_per_min": false_alarms,
}

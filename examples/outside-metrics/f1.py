"""A metric in Python: the F1 of a session's performances, as `f1` measures it (docs/reference/metrics.md)."""
import etude


@etude.metric("f_one", direction="higher", aggregate="mean", reads="score", practical=0.01)
def f_one(cell):
    judged = [event for event in cell.extras["events"] if event["truth"] != "grey"]
    hits = sum(event["truth"] == "right" and event["called_right"] for event in judged)
    misses = sum(event["truth"] == "right" and not event["called_right"] for event in judged)
    alarms = sum(event["truth"] == "wrong" and event["called_right"] for event in judged)
    if hits + misses + alarms == 0:
        raise etude.NoAnswer("no performance was right and none was called right")
    return 2 * hits / (2 * hits + alarms + misses)


if __name__ == "__main__":
    etude.serve(f_one)

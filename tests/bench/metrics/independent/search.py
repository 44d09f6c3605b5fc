"""Metrics of searches for matching frames."""
from independent import common


def agreement(given):
    return common.share([int(a == b) for a, b in zip(given["found"], given["truth"], strict=True)])


def matches(given):
    return common.mean([len(frames) for frames in given["found"]])


def counted(given, key):
    return None if given[key] is None else common.mean(given[key])


METRICS = {
    "search_agreement": lambda g: agreement(g),
    "matches_per_query": matches,
    "distances_per_query": lambda g: counted(g, "distances"),
    "boxes_per_query": lambda g: counted(g, "boxes"),
}

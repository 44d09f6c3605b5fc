"""The metrics as the program defines them, and the joints of the body."""
import functools
import json
from dataclasses import dataclass, field

from etude.program import call, find_program


@dataclass(frozen=True)
class Metric:
    """A metric. `unit` is "" for shares and counts. `direction` says whether "lower", "higher" or "neither" is better,
    `aggregate` says whether the "median" or "mean" stands for a run's cells. Differences below `practical_threshold` do
    not matter. `vectors` are inputs with expected outputs. `reads` is the kind of value: "amount"; or "yes-no", "share"
    or "score", which are shown in per cent. `weight`: the metric that weights the cells in a mean, if any."""
    id: str
    version: int
    domain: str
    label: str
    unit: str
    direction: str
    aggregate: str
    definition: str
    formula: str
    null_rule: str
    practical_threshold: float
    practical_reason: str
    source: str
    inputs: dict = field(repr=False, hash=False)
    vectors: list = field(repr=False, hash=False)
    reads: str
    weight: str = ""


def metrics(program=None):
    """Returns a dict from the id of each metric to the metric."""
    return _read(find_program(program))[0]


def own(manifest):
    """Returns a dict of the metrics that only this run defines, from id to metric."""
    return {each["id"]: Metric(**each) for each in manifest.get("own_metrics", [])}


def joints(program=None):
    """Returns the twenty joints in the order of poses: the name of each joint and the name of its parent (None for the
    first)."""
    return _read(find_program(program))[1]


@functools.lru_cache(maxsize=8)
def _read(program):
    told = json.loads(call("list", "metrics", "--json", program=program)[1])
    return ({each["id"]: Metric(**each) for each in told["metrics"]},
            [(joint["name"], joint["parent"]) for joint in told["joints"]])

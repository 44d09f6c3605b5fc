"""The metrics as the program defines them, and the joints of the body."""
import functools
import json
from dataclasses import dataclass, field

from etude.program import call, find_program


@dataclass(frozen=True)
class Metric:
    """A metric: `unit` is empty for shares and counts; `direction`, "lower", "higher" or "neither", is better;
    `aggregate`, "median" or "mean", is how a run sums up its cells; a difference below `practical_threshold` does not
    matter; `vectors` are inputs with what must come out; `reads`: "amount", or "yes-no", "share", "score", which people
    are shown in per cent."""
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


def metrics(program=None):
    """Every metric by its id."""
    return _read(find_program(program))[0]


def own(manifest):
    """The metrics of a run's own, by their ids."""
    return {each["id"]: Metric(**each) for each in manifest.get("own_metrics", [])}


def joints(program=None):
    """The twenty joints in the order of poses: each one's name, and its parent's (None for the first)."""
    return _read(find_program(program))[1]


@functools.lru_cache(maxsize=8)
def _read(program):
    told = json.loads(call("list", "metrics", "--json", program=program)[1])
    return ({each["id"]: Metric(**each) for each in told["metrics"]},
            [(joint["name"], joint["parent"]) for joint in told["joints"]])

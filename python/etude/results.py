"""A run as tables, pairs, verdicts, motions and series. Verdicts are read from its summary, never computed here."""
import json
import math
import pathlib
import re
from dataclasses import dataclass, field
from typing import Optional

from etude import catalogue
from etude.program import EtudeError, call, nearest, needed
from etude.tables import Column, Table, condition_text, numpy_or_none, read_npy, table_of_columns, tables_of_rows

__all__ = ["load", "Run", "Table", "Column", "Pairs", "Answer", "Verdict", "Motion", "Series"]


def load(folder, *, unsealed=False, program=None):
    """Reads the result folder of a finished run.

    The program checks the run's seal and refuses changed values; with `unsealed`, it makes no such check. Raises
    EtudeError.
    """
    folder = pathlib.Path(folder)
    if not (folder / "manifest.json").is_file():
        raise EtudeError(f"{folder}: is not a result folder, because there is no manifest.json", 2)
    if not (folder / "summary.json").is_file():
        raise EtudeError(f"{folder}: the run did not finish, or is one shard of a run; continue it with "
                         "etude.run(…, resume=True), or merge all shards with `etude merge`", 3)
    if not unsealed:
        call("cite", folder, program=program)
    return Run(folder, catalogue.metrics(program), catalogue.joints(program))


@dataclass(frozen=True)
class Verdict:
    """A paired comparison of the summary: method − baseline in the same worlds.

    verdict: the verdict on these worlds: "better", "worse", "no difference", "undecided" or "untested". beyond: the
    verdict generalised to other worlds like them; None if there are too few units. against: "baseline", or "rival" for
    the strongest other method. details: the summary's whole entry.
    """
    scenario: str
    condition: str
    metric: str
    baseline: str
    method: str
    against: str
    pairs: int
    difference: Optional[float]
    ci95_low: Optional[float]
    ci95_high: Optional[float]
    p_holm: Optional[float]
    verdict: str
    why_open: str
    beyond: Optional[str]
    beyond_why_open: str
    details: dict = field(repr=False, compare=False, hash=False)


@dataclass(frozen=True)
class Answer:
    """The comparison of one method with another under one condition, as a single verdict (the one on the report's
    page). The verdict considers success first, then the first headline metric, then the tail.

    verdict: the verdict on these worlds. beyond: the verdict generalised to other worlds like them; None if there are
    too few units. against: "baseline" or "rival". decided_by: "success", "value", "tail" or "none". details: the
    summary's whole entry.
    """
    scenario: str
    condition: str
    baseline: str
    method: str
    against: str
    verdict: str
    decided_by: str
    beyond: Optional[str]
    details: dict = field(repr=False, compare=False, hash=False)


class Pairs:
    """The worlds in which two methods have a value, in order. Lists or arrays, one value per world: condition, trial,
    clip, units (what the world was drawn from; "a, b" if it was drawn from two clips), baseline, method, and difference
    (method − baseline).

    only_baseline, only_method, neither: the numbers of worlds in which only the baseline, only the method or neither of
    them has a value. verdict: the summary's Verdict on the two methods; None if the summary has none, or if there are
    several conditions.
    """

    def __init__(self, metric, method_name, baseline_name, found, counts, verdict, scenario):
        self.metric, self.method_name, self.baseline_name, self.scenario = metric, method_name, baseline_name, scenario
        self.unit = metric.unit if metric else ""
        self.condition, self.trial, self.clip, self.units = ([each[i] for each in found] for i in (0, 1, 2, 5))
        numpy = numpy_or_none()
        as_array = numpy.array if numpy else list
        self.baseline, self.method = (as_array([each[i] for each in found]) for i in (3, 4))
        self.difference = as_array([each[4] - each[3] for each in found])
        self.only_baseline, self.only_method, self.neither = counts
        self.verdict = verdict

    def __len__(self):
        return len(self.trial)

    def to_pandas(self):
        frame = needed("pandas").DataFrame({"condition": self.condition, "trial": self.trial, "clip": self.clip,
                                            self.baseline_name: self.baseline, self.method_name: self.method,
                                            "difference": self.difference})
        frame.attrs["unit"] = self.unit
        return frame

    def __repr__(self):
        unit = f" {self.unit}" if self.unit else ""
        says = f"; {self.verdict.verdict}" if self.verdict else ""
        return f"<Pairs {self.metric.id if self.metric else ''}: {self.method_name} − {self.baseline_name},{unit} " \
               f"{len(self)} worlds{says}>"


@dataclass(frozen=True)
class Motion:
    """A recorded motion. positions_m: frames × joints × 3 in metres, Y up, NaN where a joint was not seen; an array if
    numpy is installed, else lists.
    joints: names. parents: for each joint, the name of the joint above it (None for the first)."""
    cell: str
    name: str
    rate_hz: float
    joints: tuple
    parents: tuple
    positions_m: object = field(repr=False)
    unit: str = "m"

    def __len__(self):
        return len(self.positions_m)


@dataclass(frozen=True)
class Series:
    """A curve of one cell: `values` along `axis` ("frame", "iteration", …). names: if set, `values` are indices into
    this list of names."""
    cell: str
    condition: str
    trial: int
    method: str
    name: str
    axis: str
    unit: str
    values: object = field(repr=False)
    names: Optional[list] = field(default=None, repr=False)

    def __len__(self):
        return len(self.values)


class Run:
    """A finished run. run["ik-weights"] is the Table of a scenario. summary, manifest: the contents of the run's
    summary.json and manifest.json."""

    def __init__(self, folder, metrics, joints):
        self.folder = pathlib.Path(folder)
        self._joints = joints
        self.summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
        self.metrics = {**metrics, **catalogue.own(self.manifest)}
        self._scenarios = {each["name"]: each for each in self.summary["scenarios"]}
        self._tables = None

    @property
    def tables(self):
        """The tables by scenario."""
        if self._tables is None:
            columns = self.folder / "columns"
            if columns.is_dir():
                found = dict(table_of_columns(each, self.metrics) for each in sorted(columns.iterdir()))
                self._tables = {name: found[name] for name in self._scenarios if name in found}
            else:
                self._tables = tables_of_rows(self.folder / "cells.jsonl", self.metrics)
        return self._tables

    @property
    def scenarios(self):
        return list(self._scenarios)

    def __iter__(self):
        """Iterates over the names of the scenarios, as a dictionary of tables does."""
        return iter(self._scenarios)

    def __len__(self):
        return len(self._scenarios)

    def __getitem__(self, scenario):
        return self.tables[self._named(scenario)]

    def methods(self, scenario=None):
        return list(self._scenarios[self._named(scenario)]["methods"])

    def answers(self, scenario=None):
        """Returns every answer: first for each method against its baseline, then for each method against its strongest
        rival."""
        if scenario is not None:
            self._named(scenario)
        return [Answer(name, condition_text(condition["condition"]), each["baseline"], each["method"], against,
                       each["verdict"], each["decided_by"], each["beyond"], each)
                for name, summary in self._scenarios.items() if scenario in (None, name)
                for condition in summary["conditions"]
                for against, key in (("baseline", "answers"), ("rival", "rival_answers"))
                for each in condition[key]]

    def verdicts(self, scenario=None, metric=None):
        """Returns every comparison on the page, in the page's order: against baselines, then against the strongest
        rivals."""
        found = []
        for name, summary in self._scenarios.items():
            for condition in summary["conditions"]:
                for against, comparisons in (("baseline", condition["comparisons"]), ("rival", condition["rivals"])):
                    found += [_verdict(name, condition_text(condition["condition"]), against, each)
                              for each in comparisons]
        if scenario is not None:
            self._named(scenario)
        return [each for each in found if scenario in (None, each.scenario) and metric in (None, each.metric)]

    def pairs(self, method, baseline, metric=None, *, scenario=None, condition=None):
        """Returns the Pairs of two methods. metric: by default the scenario's first metric. scenario: may be left out
        if only one scenario has both methods. condition: as in rows ("joint_noise_deg=15"); by default all
        conditions."""
        if scenario is None:
            both = [name for name, each in self._scenarios.items() if {method, baseline} <= set(each["methods"])]
            if len(both) != 1:
                raise EtudeError(f"{'no scenario has' if not both else 'several scenarios have'} both '{method}' and "
                                 f"'{baseline}'; select a scenario with scenario=; there are "
                                 + ", ".join(f"{name} ({', '.join(each['methods'])})"
                                             for name, each in self._scenarios.items()))
            scenario = both[0]
        scenario = self._named(scenario)
        summary, table = self._scenarios[scenario], self[scenario]
        # Check that the two methods and the condition exist.
        for name in (method, baseline):
            if name not in summary["methods"]:
                raise EtudeError(f"{scenario}: there is no method '{name}'{nearest(name, summary['methods'])}; "
                                 f"there are {', '.join(summary['methods'])}")
        conditions = [condition_text(each["condition"]) for each in summary["conditions"]]
        if condition is not None and condition not in conditions:
            raise EtudeError(f"{scenario}: there is no condition '{condition}'; allowed: {', '.join(conditions)}")
        metric = metric or summary["headline_metrics"][0]
        # Collect, for each world, the values of the two methods.
        values, methods = list(table[metric]), list(table["method"])
        clips, units = (list(table[name]) if name in table else [None] * len(table) for name in ("clip", "units"))
        worlds = {}
        for i, (of, trial) in enumerate(zip(table["condition"], table["trial"])):
            name = methods[i]
            if name in (method, baseline) and condition in (None, of):
                unit = ", ".join(units[i]) if units[i] else None
                world = worlds.setdefault((of, trial), [clips[i], None, None, unit])
                if name == baseline:
                    world[1] = values[i]
                if name == method:
                    world[2] = values[i]
        found = [(*key, *world) for key, world in worlds.items() if world[1] is not None and world[2] is not None]
        # Count the worlds without a pair of values, and find the summary's verdict.
        counts = (sum(world[1] is not None and world[2] is None for world in worlds.values()),
                  sum(world[1] is None and world[2] is not None for world in worlds.values()),
                  sum(world[1] is None and world[2] is None for world in worlds.values()))
        one = condition or (conditions[0] if len(conditions) == 1 else None)
        said = [each for each in self.verdicts(scenario, metric)
                if (each.method, each.baseline, each.condition) == (method, baseline, one)]
        return Pairs(self.metrics.get(metric), method, baseline, found, counts, said[0] if said else None, scenario)

    def recorded(self):
        """Returns the cells that kept a recording."""
        return [_cell_of(path) for path in sorted((self.folder / "recordings").glob("*.json"))]

    def motion(self, cell, name="truth"):
        """Returns a motion from a cell's recording.

        cell: a row, or the name of a cell. name: "truth", another track of the recording ("sensed", "solution", …; of
        a compared pair of files "answer"), or a method, for this method's motion in the same world. A track comes before
        a method of the same name. Raises EtudeError that lists the existing names.
        """
        cell = cell["cell"] if isinstance(cell, dict) else cell
        recorded = self.recorded()
        world, _, own = cell.rpartition("/")
        methods = self._scenarios.get(cell.partition("/")[0], {"methods": []})["methods"]
        if name in methods and name != own and not (cell in recorded and name in self._tracks(cell)[0]):
            cell, own = f"{world}/{name}", name
        if cell not in recorded:
            raise EtudeError(f"cell '{cell}' has no recording; the scenario's key `video`, or --keep motions, selects "
                             f"the cells to record{nearest(cell, recorded)}; recorded cells: {', '.join(recorded) or 'none'}")
        tracks, joints = self._tracks(cell)
        if name == own and name not in tracks:
            name = next((each for each in ("recovered", "solution", "coach", "sensed", "answer") if each in tracks), name)
        if name not in tracks:
            raise EtudeError(f"the recording of cell '{cell}' has no track '{name}'{nearest(name, tracks)}; there are "
                             f"{', '.join(tracks)}")
        return _motion(cell, tracks[name], joints)

    def _tracks(self, cell):
        """Returns the tracks of a cell's recording by name, and each joint with the joint above it."""
        path = self.folder / "recordings" / (cell.replace("/", "~") + ".json")
        told = json.loads(path.read_text(encoding="utf-8"))
        if told.get("recording") != 2:
            raise EtudeError(f"{path}: the recording has version {told.get('recording', 1)}, but this package reads "
                             "version 2, which contains the names of the joints; repeat the run")
        tracks = {track["name"]: track for track in told["tracks"]}
        joints = [(joint, dict(self._joints)[joint]) for joint in told["joints"]]
        extras = told.get("extras") or {}
        if not tracks and {"truth", "answer"} <= set(extras):  # a pair of files: the extras hold motions and joints
            tracks = {track: {"name": track, "rate_hz": extras["rate_hz"], "poses": extras[track]}
                      for track in ("truth", "answer")}
            joints = [(joint, extras["joints"][above] if above >= 0 else None)
                      for joint, above in zip(extras["joints"], extras["parents"])]
        return tracks, joints

    def series(self, name=None, *, scenario=None, method=None, condition=None, trial=None):
        """Yields the cells' curves with this name; all curves if `name` is None."""
        wanted = [self._named(scenario)] if scenario is not None else self.scenarios
        known = set()
        for each in wanted:
            read = _series_of_columns if (self.folder / "columns").is_dir() else _series_of_lines
            for of, trial_of, by, cell, told, values in read(self, each):
                known.add(told["name"])
                if (name in (None, told["name"]) and method in (None, by) and condition in (None, of)
                        and trial in (None, trial_of)):
                    metric = self.metrics.get(told["name"])
                    unit = metric.unit if metric else _unit_of(told)
                    yield Series(cell, of, trial_of, by, told["name"], told["axis"], unit, values, told.get("names"))
        if name is not None and name not in known:
            raise EtudeError(f"there is no curve '{name}'{nearest(name, known)}; "
                             f"there are {', '.join(sorted(known)) or 'none'}")

    def _named(self, scenario):
        if scenario is None and len(self._scenarios) == 1:
            return next(iter(self._scenarios))
        if scenario not in self._scenarios:
            raise EtudeError(f"{self.folder}: there is no scenario '{scenario}'{nearest(scenario, self._scenarios)}; "
                             f"there are {', '.join(self._scenarios)}")
        return scenario

    def __repr__(self):
        lines = [f"<Run {self.folder}, seed {self.manifest.get('seed')}"]
        for name, each in self._scenarios.items():
            lines.append(f"  {name} ({each['task']}): {len(each['conditions'])} condition"
                         f"{'s' * (len(each['conditions']) != 1)}; {', '.join(each['methods'])}")
        return "\n".join(lines) + ">"


def _verdict(scenario, condition, against, told):
    beyond = told.get("beyond") or {}
    return Verdict(scenario, condition, told["metric"], told["baseline"], told["method"], against, told["pairs"],
                   told["difference"], told["ci95_low"], told["ci95_high"], told["p_holm"], told["verdict"],
                   told["why_open"], beyond.get("verdict"), beyond.get("why_open", ""), told)


def _cell_of(path):
    return path.name[:-len(".json")].replace("~", "/")


def _motion(cell, track, joints):
    names, above = tuple(name for name, _ in joints), tuple(parent for _, parent in joints)
    numpy = numpy_or_none()
    if numpy:
        positions = numpy.array(track["poses"], dtype=float).reshape(len(track["poses"]), len(names), 3)
    else:
        positions = [[[math.nan if x is None else x for x in pose[3 * i:3 * i + 3]] for i in range(len(names))]
                     for pose in track["poses"]]
    return Motion(cell, track["name"], track["rate_hz"], names, above, positions)


def _unit_of(curve):
    """Returns the unit at the end of a curve's name, or ""; mean errors of a joint, which has a name of its own, are in
    millimetres."""
    if curve["axis"] == "mean joint errors":
        return "mm"
    found = re.search(r"_(cm|deg|mm|s|mps3|cmps)$", curve["name"])
    return found[1] if found else ""


def _series_of_lines(run, scenario):
    path = run.folder / "series" / f"{scenario}.jsonl"
    if not path.is_file():
        return
    numpy = numpy_or_none()
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            told = json.loads(line)
            _, condition, trial, method = _split(told["cell"])
            for each in told["series"]:
                values = [math.nan if value is None else value for value in each.pop("values")]
                yield condition, trial, method, told["cell"], each, numpy.array(values) if numpy else values


def _split(cell):
    """Splits a cell into scenario, condition, trial and method; a condition may contain slashes."""
    scenario, rest = cell.split("/", 1)
    condition, trial, method = rest.rsplit("/", 2)
    return scenario, condition, int(trial), method


def _series_of_columns(run, scenario):
    folder = run.folder / "columns" / scenario
    index = json.loads((folder / "index.json").read_text(encoding="utf-8"))
    methods, trials = index["methods"], index["trials"]
    conditions = [condition_text(each) for each in index["conditions"]]
    names = {each["name"]: each for kind in index["kinds"] for each in kind["series"]}
    for name, told in names.items():
        values, ends = (read_npy(folder / "series" / f"{name}{ending}.npy") for ending in ("", ".ends"))
        begin = 0
        for at, end in enumerate(ends):
            end = int(end)
            if end > begin:
                condition, trial = conditions[at // (trials * len(methods))], at // len(methods) % trials
                method = methods[at % len(methods)]
                cell = f"{scenario}/{condition}/{trial:03d}/{method}"
                yield condition, trial, method, cell, told, values[begin:end]
            begin = end

"""Tables of cells: columns by name, read on demand, with the units and definitions of their metrics."""
import array
import collections.abc
import json
import math
import mmap
import re
import struct

from etude.program import EtudeError, nearest, needed

IDENTITY = ("cell", "scenario", "task", "condition", "trial", "clip", "units", "method", "status", "reason")
_TYPES = {"<f8": "d", "<f4": "f", "<u8": "Q", "<u4": "I", "|u1": "B"}


def numpy_or_none():
    try:
        import numpy
        return numpy
    except ImportError:
        return None


class Column(collections.abc.Sequence):
    """The values of one column, one per row. As an item, a missing value is None; in `values` and in arrays, it is NaN.

    values: a numpy array if numpy is installed, else an array of the standard library or a list. metric: the column's
    etude.catalogue.Metric, or None if the column is not a metric. unit, definition: of the metric, else "".
    """

    def __init__(self, name, values, metric=None):
        self.name, self.values, self.metric = name, values, metric
        self.unit = metric.unit if metric else ""
        self.definition = metric.definition if metric else ""

    def __len__(self):
        return len(self.values)

    def __getitem__(self, at):
        if isinstance(at, slice):
            return [self[i] for i in range(*at.indices(len(self)))]
        value = self.values[at]
        value = value.item() if hasattr(value, "item") else value
        return None if isinstance(value, float) and math.isnan(value) else value

    def __iter__(self):
        values = self.values.tolist() if hasattr(self.values, "tolist") else self.values
        return (None if isinstance(value, float) and value != value else value for value in values)

    def __array__(self, dtype=None, copy=None):
        import numpy
        return numpy.asarray(self.values, dtype=dtype)

    def __repr__(self):
        unit = f", {self.unit}" if self.unit else ""
        return f"<{self.name}{unit}: {len(self)} values>"


class Table:
    """The cells of one scenario, all of one task. Columns without any value are left out; `null_columns` gives the
    reasons, by the column's name.

    columns: the names, settings first. table["iterations"] is a Column; so are the digests of stages, `digest_…`,
    although `columns` leaves them out.
    """

    def __init__(self, scenario, task, length, readers, null_columns, metrics, reasons, digests=(), whole=None):
        self.scenario, self.task = scenario, task
        self._length, self._readers, self._metrics, self._reasons = length, readers, metrics, reasons
        self.null_columns, self._read = dict(null_columns), {}
        self._whole = whole or self  # the table from which this one was taken
        self.columns = [name for name in readers if name not in digests]

    def __len__(self):
        return self._length

    def __contains__(self, name):
        return name in self._readers

    def __getitem__(self, name):
        if name not in self._readers:
            if name in self.null_columns:
                raise EtudeError(f"{self.scenario}: '{name}' has no value in any cell: {self.null_columns[name]}")
            raise EtudeError(f"{self.scenario}: there is no column '{name}'{nearest(name, self._readers)}; there are "
                             f"{', '.join(self.columns)}")
        if name not in self._read:
            self._read[name] = Column(name, self._readers[name](), self._metrics.get(name))
        return self._read[name]

    def reasons(self, name):
        """Returns for each cell the reason why the cell has no value of a metric; None if the value exists."""
        column = self[name] if name in self else [None] * len(self)
        why = self._reasons(name)
        return [None if value is not None else why(i) for i, value in enumerate(column)]

    def rows(self):
        """Returns the cells as dicts, without the digests of stages."""
        columns = [self[name] for name in self.columns]
        for values in zip(*columns) if columns else ():
            yield dict(zip(self.columns, values))

    def where(self, **wanted):
        """Returns the cells whose columns have these values: `table.where(method="adaptive", joint_noise_deg=15)`.
        Raises EtudeError if the scenario has no such method, condition or setting."""
        kept = range(len(self))
        for name, value in wanted.items():
            values = list(self[name])
            is_choice = name in ("method", "condition") or name not in IDENTITY and name not in self._metrics
            if is_choice and value not in values and value not in list(self._whole[name]):
                known = list(dict.fromkeys(map(str, self._whole[name])))
                raise EtudeError(f"{self.scenario}: there is no {name} '{value}'{nearest(str(value), known)}; "
                                 "there are " + ", ".join(known[:20]) + ", …" * (len(known) > 20))
            kept = [i for i in kept if values[i] == value]
        readers = {name: (lambda name=name: _take(self[name].values, kept)) for name in self._readers}
        digests = [name for name in self._readers if name not in self.columns]
        return Table(self.scenario, self.task, len(kept), readers, self.null_columns, self._metrics,
                     lambda name: (lambda why: lambda i: why(kept[i]))(self._reasons(name)), digests, self._whole)

    def to_pandas(self):
        """Returns a DataFrame; its `attrs` hold the `units` and `definitions` of the metrics' columns."""
        frame = needed("pandas").DataFrame({name: self[name].values for name in self.columns})
        measured = {name: self._metrics[name] for name in self.columns if name in self._metrics}
        frame.attrs["units"] = {name: metric.unit for name, metric in measured.items()}
        frame.attrs["definitions"] = {name: metric.definition for name, metric in measured.items()}
        return frame

    def to_xarray(self):
        """Returns a Dataset over condition × trial × method, in the order of the rows. Settings are coordinates of the
        condition; every metric has `units`, `long_name` and `definition` in its `attrs`. A cell that does not exist is
        NaN, or None for texts. `sel` has an argument named `method`, so write `data.sel({"method": "fixed"})`."""
        needed("xarray")
        frame, axes = self.to_pandas(), ["condition", "trial", "method"]
        settings = [name for name in self.columns if name not in IDENTITY and name not in self._metrics]
        kept = [name for name in self.columns if name in self._metrics or name in ("clip", "status", "reason")]
        order = {axis: list(dict.fromkeys(self[axis])) for axis in axes}
        data = frame[axes + kept].set_index(axes).to_xarray().sel(order)
        firsts = frame.drop_duplicates("condition")
        data = data.assign_coords({name: ("condition", firsts[name].to_numpy()) for name in settings})
        for name in kept:
            if name in self._metrics:
                metric = self._metrics[name]
                data[name].attrs = {"units": metric.unit, "long_name": metric.label, "definition": metric.definition}
        data.attrs = {"scenario": self.scenario, "task": self.task}
        return data

    def __repr__(self):
        return (f"<Table {self.scenario} ({self.task}): {len(self)} cells; {', '.join(self.columns)}>")


def _take(values, places):
    return values[places] if numpy_or_none() and hasattr(values, "dtype") else [values[i] for i in places]


def _typed(values):
    """Returns numbers as an array, with NaN for None; other values as a list."""
    if not all(value is None or isinstance(value, (int, float)) for value in values):
        return values
    numpy = numpy_or_none()
    is_whole = all(isinstance(value, int) for value in values)
    numbers = [math.nan if value is None else value for value in values]
    if numpy:
        return numpy.array(numbers, dtype=numpy.int64 if is_whole else numpy.float64)
    return array.array("q" if is_whole else "d", numbers)


def tables_of_rows(file, metrics):
    """Returns the tables of cells.jsonl, by scenario."""
    rows_of = {}
    with open(file, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            try:
                row = json.loads(line)
                rows_of.setdefault((row["scenario"], row["task"]), []).append(row)
            except (ValueError, KeyError, TypeError) as error:
                raise EtudeError(f"{file}:{number}:1: is not a row of a run: {error}") from None
    return {scenario: _table_of_rows(scenario, task, rows, metrics) for (scenario, task), rows in rows_of.items()}


def _table_of_rows(scenario, task, rows, metrics):
    names = {}
    for row in rows:
        for name in row:
            names.setdefault(name, None)
    for name in "null_reasons", "judged":
        names.pop(name, None)
    values = {name: [row.get(name) for row in rows] for name in names}
    digests = [name for name in names if name.startswith("digest_")]
    settings = [name for name in names if name not in IDENTITY and name not in metrics and name not in digests]
    order = [*settings, *[name for name in IDENTITY if name in names], *[name for name in names if name in metrics],
             *digests]
    nulls = {}
    for name in order:
        if all(value is None for value in values[name]):
            nulls[name] = _whys(rows, name)
    readers = {name: (lambda name=name: _typed(values[name])) for name in order if name not in nulls}
    return Table(scenario, task, len(rows), readers, nulls, metrics,
                 lambda name: lambda i: _why(rows[i], name), digests)


def _why(row, name):
    return (row.get("null_reasons") or {}).get(name) or row["reason"] or "is not measured in such a cell"


def _whys(rows, name):
    if name == "reason":
        return "every cell is ok"
    found = list(dict.fromkeys(_why(row, name) for row in rows)) if name not in IDENTITY else ["no world has one"]
    return "; ".join(found[:3]) + ("; …" if len(found) > 3 else "")


def read_npy(path):
    """Returns the numbers of a .npy file that a run wrote, mapped into memory, as one dimension."""
    with open(path, "rb") as file:
        magic = file.read(10)
        length = struct.unpack("<H", magic[8:])[0] if len(magic) == 10 and magic[:6] == b"\x93NUMPY" else 0
        head = file.read(length).decode("latin-1")
        kind = re.search(r"'descr': '([^']+)'", head)
        if not length or kind is None or kind[1] not in _TYPES:
            raise EtudeError(f"{path}: the file is not a column of numbers")
        numpy = numpy_or_none()
        if numpy:
            return numpy.memmap(path, dtype=kind[1], mode="r", offset=10 + length)
        mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        return memoryview(mapped)[10 + length:].cast(_TYPES[kind[1]])


def table_of_columns(folder, metrics):
    """Returns the name and the table of a scenario in a run that has columns (more than 100,000 cells). `folder` is the
    run's folder columns/SCENARIO."""
    index = json.loads((folder / "index.json").read_text(encoding="utf-8"))
    trials, methods, conditions = index["trials"], index["methods"], index["conditions"]
    length = trials * len(methods) * len(conditions)
    numpy = numpy_or_none()

    def spread(values, before, after):
        """Repeats each value `after` times, and the resulting list `before` times."""
        if numpy:
            return numpy.tile(numpy.repeat(numpy.array(values), after), before)
        return [value for _ in range(before) for value in values for _ in range(after)]

    def texts(name, names):
        places = read_npy(folder / f"{name}.npy")
        if numpy:
            return numpy.array(names, dtype=object)[places]
        return [names[place] for place in places]

    def numbers(name):
        return read_npy(folder / f"{name}.npy")

    here = {path.stem for path in folder.glob("*.npy")}
    named = [text or None for text in index["texts"]]
    # Make readers of the settings and of each cell's condition, trial and method. The index stores each of these values
    # once, so `spread` repeats them for all cells.
    readers = {}
    for key in conditions[0] if conditions else ():
        of_conditions = [_as_row_has_it(each[key]) for each in conditions]
        readers[key] = lambda values=of_conditions: spread(values, 1, trials * len(methods))
    readers["scenario"] = lambda: spread([index["scenario"]], 1, length)
    readers["condition"] = lambda: spread([condition_text(each) for each in conditions], 1, trials * len(methods))
    readers["trial"] = lambda: spread(range(trials), len(conditions), len(methods))
    readers["method"] = lambda: spread(methods, len(conditions) * trials, 1)
    readers["status"] = lambda: texts("status", index["statuses"])
    for name in ("clip", "reason"):
        if name in here:
            readers[name] = lambda name=name: texts(name, named)
    # Make readers of the metrics. A metric without a file has no value in any cell.
    wanted = list(dict.fromkeys(name for kind in index["kinds"] for name in kind["metrics"]))
    nulls = {}
    for name in wanted:
        if name in here:
            readers[name] = lambda name=name: numbers(name)
        else:
            whys = {kind["why"][kind["metrics"].index(name)] for kind in index["kinds"] if name in kind["metrics"]}
            nulls[name] = "; ".join(sorted(named[why] or "" if why is not None and why >= 0 else "the cell's own reason"
                                           for why in whys))
    digests = sorted(name for name in here if name.startswith("digest_"))
    for name in digests:
        readers[name] = lambda name=name: numbers(name)

    def reasons(name):
        kinds = read_npy(folder / "kind.npy")
        own = read_npy(folder / "reason.npy") if "reason" in here else None

        def why(i):
            kind = index["kinds"][kinds[i]]
            place = kind["why"][kind["metrics"].index(name)] if name in kind["metrics"] else -1
            found = named[place] if place is not None and place >= 0 else own is not None and named[own[i]]
            return found or "is not measured in such a cell"

        return why

    return index["scenario"], Table(index["scenario"], index["task"], length, readers, nulls, metrics, reasons, digests)


def _as_row_has_it(text):
    """Converts a swept value from the index, which stores texts, to the value in rows: a number if the text is one."""
    try:
        return float(text)
    except ValueError:
        return text


def condition_text(condition):
    """Returns `key=value,key=value` as in rows, or "-" without a sweep."""
    items = condition.items() if isinstance(condition, dict) else [(each["key"], each["value"]) for each in condition]
    return ",".join(f"{key}={value:g}" if isinstance(value, float) else f"{key}={value}" for key, value in items) or "-"

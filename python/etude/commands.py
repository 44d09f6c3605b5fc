"""Runs, reports, gates, compares and scores scenarios by calling the program."""
import contextlib
import hashlib
import json
import os
import pathlib
import re
import warnings
from dataclasses import dataclass

from etude.conversation import Player, spec_of
from etude.program import EtudeError, cache_folder, call
from etude.results import load
from etude.shipping import ship, write_once


def run(scenario, *, methods=(), metrics=(), trials=None, output=None, seed=None, clips=(), jobs=None, overwrite=False,
        resume=False, fenced=True, progress=True, program=None):
    """Runs a scenario, and returns the Run (etude.load) of the result folder.

    scenario: a file, a folder of files, the name of a scenario that comes with etude (`"quick/ik"`), or a dict with the
    keys of a scenario. methods: further methods, made by @etude.method or dicts with the keys of a scenario's entry; a
    method made by @etude.method is added to the scenarios of its task. metrics: further metrics of every scenario, made
    by @etude.metric or dicts; the scenario's headline metrics stay. output: the result folder, by default
    out/NAME-SEED; this folder must be new unless `overwrite` or `resume` is true. progress: True shows the progress on
    standard error; a function is called with (cells done, cells).

    Warns if no cell is ok. Raises EtudeError; the error's `run` is set if the run finished but a method has no answer
    (exit code 1).
    """
    if isinstance(scenario, dict) or methods or metrics:
        scenario = _write_scenario(scenario, methods, metrics, program)
    arguments = ["run", os.fspath(scenario)]
    for flag, value in (("--trials", trials), ("-o", output), ("--seed", seed), ("--jobs", jobs)):
        if value is not None:
            arguments += [flag, os.fspath(value) if isinstance(value, os.PathLike) else str(value)]
    if clips:
        arguments += ["--clips", *map(os.fspath, clips)]
    arguments += ["--overwrite"] * overwrite + ["--resume"] * resume + ["--no-fence"] * (not fenced)
    code, printed, said = call(*arguments, program=program, progress=progress, allowed=(0, 1))
    next_ = re.search(r"^Next: etude report (.*)$", printed, re.MULTILINE)
    folder = output if output is not None else next_ and next_[1].strip("'\"")
    if folder is None:
        raise EtudeError("the run printed no result folder; set the folder with output=", code, printed + said)
    found = load(folder, program=program)
    return _judged(found, code, printed, said)


def _judged(found, code, printed, said):
    """Returns the run. Raises EtudeError if a method has no answer; warns if no cell is ok."""
    if code == 0:
        return found
    lines = [line.strip() for line in (said + printed).splitlines()]
    causes = [line for line in lines if "has an answer" in line or " × " in line]
    if causes:
        raise EtudeError("; ".join(dict.fromkeys(causes)), code, printed + said, found)
    warnings.warn(next((line for line in lines if "cells ok" in line), "no cell is ok"), stacklevel=3)
    return found


def _write_scenario(scenario, methods, metrics, program):
    """Writes a scenario or a folder of scenarios, with the methods and metrics added, and returns the written path."""
    measures = [each if isinstance(each, dict) else _metric(each) for each in metrics]
    entries = [(spec_of(each).task, ship(each)) if not isinstance(each, dict) else (None, each) for each in methods]
    if isinstance(scenario, dict):
        told = dict(scenario)
        told["methods"] = [*told.get("methods", []), *_fitting(entries, told.get("task"))]
        if measures:
            told["metrics"] = [*told.get("metrics", []), *measures]
        _refuse_unused(entries, {told.get("task")})
        return _keep({f"{told.get('scenario', 'scenario')}.yaml": json.dumps(told, indent=1, ensure_ascii=False)})
    texts = _texts_of(os.fspath(scenario), program)
    tasks = {name: _value_of("task", text) for name, text in texts.items()}
    _refuse_unused(entries, set(tasks.values()))
    kept = _keep({name: _with_metrics(name, _with_methods(name, text, _fitting(entries, tasks[name])), measures)
                  for name, text in texts.items()},
                 os.path.splitext(os.path.basename(os.fspath(scenario)))[0])
    return kept


def _fitting(entries, task):
    return [entry for wanted, entry in entries if wanted in (None, task)]


def _refuse_unused(entries, tasks):
    for wanted, entry in entries:
        if wanted is not None and wanted not in tasks:
            raise EtudeError(f"method '{entry['name']}' is of task '{wanted}'; the scenario's tasks are "
                             f"{', '.join(sorted(map(str, tasks)))}")


def _texts_of(scenario, program):
    """Returns the texts of a file, a folder or a scenario that comes with etude, by file name."""
    import tempfile
    path = pathlib.Path(scenario)
    with contextlib.ExitStack() as stack:
        files = sorted(path.glob("*.yaml")) if path.is_dir() else [path] if path.exists() else []
        if not files:  # use the shipped scenario, even if a folder without scenarios has its name
            scratch = stack.enter_context(tempfile.TemporaryDirectory())
            call("scenario", "copy", scenario, scratch, program=program)
            files = sorted(pathlib.Path(scratch).rglob("*.yaml"))
        return {file.name: file.read_text(encoding="utf-8") for file in files}


def _value_of(key, text):
    found = re.search(rf"^{key}:\s*['\"]?([\w-]+)", text, re.MULTILINE)
    return found[1] if found else None


def _with_methods(name, text, entries):
    """Returns `text`, the text of a scenario, with `entries` added at the end of its list of methods. The rest of the
    text stays unchanged."""
    if re.search(r"^include:", text, re.MULTILINE):
        raise EtudeError(f"{name}: the scenario includes another file, which a copy of the scenario would not "
                         "find; write the methods into the scenario")
    if not entries:
        return text
    lines = text.splitlines(keepends=True)
    heads = [i for i, line in enumerate(lines) if re.match(r"methods:\s*(#.*)?$", line.rstrip("\n"))]
    if len(heads) != 1:
        raise EtudeError(f"{name}: methods can only be added to a list `methods` with one line per entry")
    # The list ends before the first line that is neither indented nor an entry.
    end = heads[0] + 1
    indent = None
    for i in range(end, len(lines)):
        item = re.match(r"(\s*)- ", lines[i])
        if indent is None and item:
            indent = item[1]
        if lines[i].strip() and not lines[i].lstrip().startswith("#") and not lines[i].startswith(" ") and \
                not (item and item[1] == indent):
            break
        if lines[i].strip() and not lines[i].lstrip().startswith("#"):
            end = i + 1
    added = [f"{indent or ''}- {json.dumps(entry, ensure_ascii=False)}\n" for entry in entries]
    if not lines[end - 1].endswith("\n"):
        lines[end - 1] += "\n"
    return "".join(lines[:end] + added + lines[end:])


def _metric(each):
    if spec_of(each).task != "metric":
        raise TypeError(f"'{spec_of(each).name}' is not a metric; write @etude.metric(…) above the function")
    return ship(each)


def _with_metrics(name, text, entries):
    """Returns the text of a scenario in which entries are added at the end of the list of metrics, otherwise
    unchanged."""
    if not entries:
        return text
    added = ", ".join(json.dumps(entry, ensure_ascii=False) for entry in entries)
    heads = list(re.finditer(r"^metrics:[ \t]*(.*)$", text, re.MULTILINE))
    if not heads:
        return text.rstrip("\n") + f"\nmetrics: [{added}]\n"
    listed = re.compile(r"^metrics:[ \t]*\[([^\[\]{}#]*)\]", re.MULTILINE).match(text, heads[0].start())
    if len(heads) > 1 or not listed:
        raise EtudeError(f"{name}: metrics can only be added to one list `metrics` in brackets")
    names = listed[1].strip().rstrip(",")
    return text[:listed.start()] + f"metrics: [{names}{', ' if names else ''}{added}]" + text[listed.end():]


def _keep(texts, suite=None):
    """Writes scenario files to the cache, in a folder named by the files' digest, and returns the path to run."""
    digest = hashlib.sha256(json.dumps(sorted(texts.items())).encode()).hexdigest()[:16]
    folder = cache_folder() / "scenarios" / digest
    if len(texts) > 1:
        folder /= suite or "suite"
    for name, text in texts.items():
        write_once(folder / name, text.encode())
    return folder if len(texts) > 1 else folder / next(iter(texts))


def report(run, *, video=True, progress=True, program=None):
    """Writes a run's page, tables and films. Returns the path of the page."""
    folder = pathlib.Path(getattr(run, "folder", run))
    call("report", folder, *([] if video else ["--no-video"]), program=program, progress=progress)
    return folder / "report" / "index.html"


@dataclass(frozen=True)
class Gate:
    """The verdict of a gate; true if the run passed. `text` is the gate's whole output, one line per check."""
    passed: bool
    text: str

    def __bool__(self):
        return self.passed


def gate(run, baseline=None, *, update=False, program=None):
    """Judges a run by its expectations and a baseline. Raises EtudeError if the run cannot be judged (exit code 3:
    incomplete)."""
    flags = [] if baseline is None else ["--baseline", os.fspath(baseline)]
    code, printed, _ = call("gate", getattr(run, "folder", run), *flags, *["--update"] * update, program=program,
                            allowed=(0, 1))
    return Gate(code == 0, printed.strip())


def compare(a, b, *, program=None):
    """Returns the differences between two runs of the same worlds as text."""
    return call("compare", getattr(a, "folder", a), getattr(b, "folder", b), program=program)[1].strip()


def score(target, predictions, output, *, name=None, alone=False, allow_missing=False, allow_exec=False, jobs=None,
          progress=True, program=None):
    """Scores answers, and returns the Run (etude.load) of the result folder.

    target: a data set written by `etude export`. allow_exec: allows the data set's own programs, such as metrics, to
    run. predictions: a folder of answers, or a method made by @etude.method. Such a method runs in this process
    without the sandbox. If it takes batches, it gets all problems of a setting at once. Its answers are kept in the
    folder `output` + ".answers".
    """
    if hasattr(predictions, "__etude__"):
        name = name or spec_of(predictions).name
        answers = pathlib.Path(f"{os.fspath(output)}.answers")
        _answer_all(pathlib.Path(target), predictions, answers, progress)
        predictions, allow_missing = answers, True
    arguments = ["score", os.fspath(target), os.fspath(predictions), "-o", os.fspath(output)]
    arguments += ["--name", name] if name else []
    arguments += ["--alone"] * alone + ["--allow-missing"] * allow_missing + ["--allow-exec"] * allow_exec
    arguments += ["--jobs", str(jobs)] if jobs is not None else []
    code, printed, said = call(*arguments, program=program, progress=progress, allowed=(0, 1))
    found = load(output, program=program)
    return _judged(found, code, printed, said)


def _answer_all(target, method, answers, progress):
    """Asks a method all those problems of a data set that belong to the method's task. Problems without an answer stay
    missing."""
    from etude.conversation import NoAnswer
    from etude.messages import to_json_text
    player, spec, inputs = Player(method), spec_of(method), target / "inputs"
    if not inputs.is_dir():
        raise EtudeError(f"{target}: is not a data set that `etude export` wrote, because there is no folder 'inputs'")
    settings = [path for path in sorted(inputs.rglob("setting.json")) if _task_of(inputs, path) == spec.task]
    if not settings:
        raise EtudeError(f"{target}: the data set has no problem of task '{spec.task}'")
    for done, path in enumerate(settings):
        player.set(json.loads(path.read_text()), spec.options, str(path.parent))
        own = path.parent / "problem.json"  # a recorded person's problem has its own setting, in the same folder
        files = [own] if own.exists() else sorted(path.parent.glob("*/problem.json"))
        found = player.answers([json.loads(file.read_text()) for file in files], [str(file.parent) for file in files])
        for file, answer in zip(files, found):
            if not isinstance(answer, NoAnswer):
                kept = answers / file.parent.parent.relative_to(inputs) / f"{file.parent.name}.json"
                kept.parent.mkdir(parents=True, exist_ok=True)
                kept.write_text(to_json_text(answer))
        if callable(progress):
            progress(done + 1, len(settings))


def _task_of(inputs, setting):
    """Returns the task of a setting's scenario, from the index beside the setting."""
    import csv
    scenario = setting.relative_to(inputs).parts[0]
    with open(inputs / "index.csv", newline="") as file:
        return next((row["task"] for row in csv.DictReader(file) if row["scenario"] == scenario), None)

"""Judges motions, in files or arrays, by their truth (`etude evaluate`)."""
import array
import io
import itertools
import json
import math
import os
import pathlib
import re
import warnings
import zipfile

from etude.program import EtudeError, call
from etude.results import load


class DoubtWarning(UserWarning):
    """Something looks wrong in a judged file or array, such as its up axis, its unit or its sides."""


class LimitWarning(UserWarning):
    """A motion exceeds the limits that were given to evaluate(alone=True, limits=…)."""


def evaluate(truth=None, *, names=None, rate_hz=None, pairs=None, joints=None, people=None, lag=None, statistics=None,
             music_beats=None, metrics=(), alone=False, floor=None, limits=None, output=None, overwrite=False, jobs=None,
             progress=True, program=None, unit=None, up=None, **answers):
    """Judges answers by their truth, or without a truth (`alone`), and returns the Run (etude.load) of the result
    folder.

    truth, and each answer by its method's name: a motion file, a folder or a pattern; or an array of positions, frames
    × joints × 3 in metres with Y up, NaN where a joint was not seen. Arrays need `names` (of their joints) and
    `rate_hz`; joint names state the roles, as marker names in a file do. Give `unit` ("cm") if arrays are not in
    metres, and `up` ("z") if Y does not point up; without arrays, `unit` and `up` apply to all files. Arrays are kept
    as .npz files in the folder `output` + ".motions". pairs: a CSV file of pairs, given instead of truth and answers.
    joints, people, lag, statistics, music_beats, metrics: as the options of `etude evaluate`. alone: there is no truth;
    floor and limits are then the options of `etude evaluate --alone`, and the metric within_limits says which clips
    keep the limits. output: the result folder; by default the first free folder of out/evaluate-1, out/evaluate-2, …

    Raises EtudeError, also if a method has no answer that can be judged; the error's `run` is then set. Raises
    TypeError or ValueError for arguments that cannot be used, before anything is written. Warns of pairs and
    motions that are not judged, with a LimitWarning of motions beyond the limits, and with a DoubtWarning of what looks
    wrong in the motions.
    """
    output = _free_folder(overwrite) if output is None else pathlib.Path(output)
    if alone and (truth is not None or pairs is not None or not answers):
        raise TypeError("evaluate(alone=True) needs motions as keyword arguments, and no truth")
    if not alone and ((truth is None) != (pairs is not None) or (pairs is None) != bool(answers)):
        raise TypeError("evaluate needs a truth and answers as keyword arguments, or pairs")

    arrays = {}
    names = names if names is None or isinstance(names, str) else list(names)

    def reference(motion, name):
        if motion is None:
            raise TypeError(f"the motion of {name} is None; allowed: a file, a folder, a pattern or an array")
        if isinstance(motion, (str, os.PathLike)):
            return os.fspath(motion)
        if names is None or rate_hz is None:
            raise TypeError(f"the array of {name} needs names and rate_hz")
        if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", name):
            raise ValueError(f"{name!r} is not the name of a method; allowed: letters, digits, '_', '.', '-'")
        if isinstance(names, str) or not all(isinstance(joint, str) for joint in names):
            raise TypeError("names must be a list of the joints' names")
        path = pathlib.Path(f"{output}.motions") / f"{name}.npz"
        arrays[path] = _npz(motion, names, rate_hz, {"unit": unit, "up": up}, name)
        return str(path)

    arguments = ["evaluate", "--alone"] if alone else ["evaluate"]
    if truth is not None:
        arguments.append(reference(truth, "truth"))
    arguments += [f"{name}={reference(each, name)}" for name, each in answers.items()]
    for flag, value in (("--pairs", pairs), ("--floor", floor), ("--limits", limits), ("--joints", joints),
                        ("--people", people), ("--lag", lag), ("--statistics", statistics),
                        ("--music-beats", music_beats), ("--jobs", jobs)):
        arguments += [flag, os.fspath(value) if isinstance(value, os.PathLike) else str(value)] if value is not None else []
    if not arrays:
        for flag, value in (("--unit", unit), ("--up", up)):
            arguments += [flag, str(value)] if value is not None else []
    for metric in [metrics] if isinstance(metrics, str) else metrics:
        arguments += ["--metric", metric]
    arguments += ["-o", str(output)] + ["--overwrite"] * overwrite + ["--json"]
    if arrays and not overwrite and (output / "manifest.json").exists():  # do not replace the arrays of an earlier run
        raise EtudeError(f"{output} already exists; use overwrite=True to replace it", 2)
    for path, content in arrays.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    code, printed, said = call(*arguments, program=program, progress=progress, allowed=(0, 1))
    found = load(output, program=program)
    kinds = {}
    facts = json.loads(printed)
    for doubt in facts["doubts"]:  # "METHOD, CLIP: DOUBT", or "CLIP: the truth: DOUBT"
        whose, _, text = doubt.partition(": ")
        method = "" if text.startswith("the truth: ") else whose.partition(", ")[0]
        kinds.setdefault((method, re.sub(r"[\d.]+", "", text)), []).append(doubt)  # but for numbers, one kind
    kinds.update({left: [left] for left in facts["left_out"]})
    for first, *similar in kinds.values():
        warnings.warn(first + (f" (and {len(similar)} similar)" if similar else ""), DoubtWarning, stacklevel=2)
    if code != 0:
        rows = [json.loads(line) for line in (output / "cells.jsonl").read_text(encoding="utf-8").splitlines()]
        rows.sort(key=lambda row: row["status"] == "skipped")  # skipped cells last: their reasons say least
        missed = [row for row in rows if row["status"] != "ok"]
        said_of = [f"{row['method']}, {row['clip']}: {row['reason']}" for row in missed]
        judged = {row["method"] for row in rows if row["status"] == "ok"}
        silent = [text for row, text in zip(missed, said_of) if row["method"] not in judged]
        if silent:
            raise EtudeError("a method has no answer that can be judged: " + silent[0], code, printed + said, found)
        if missed and not alone:
            warnings.warn(f"{len(missed)} of {len(rows)} pairs are not judged: {said_of[0]}", stacklevel=2)
    if alone:
        counts = f"of {sum(status != 'skipped' for status in found['evaluate']['status'])} motions"
        if facts["not_judged"]:
            warnings.warn(f"{len(facts['not_judged'])} {counts} are not judged: {facts['not_judged'][0]}", stacklevel=2)
        if facts.get("beyond_limits"):
            warnings.warn(f"{len(facts['beyond_limits'])} {counts} are beyond the limits: {facts['beyond_limits'][0]}",
                          LimitWarning, stacklevel=2)
    return found


def _free_folder(overwrite):
    """Returns the first of the folders out/evaluate-1, … that holds no run and no arrays of a failed call; with
    overwrite, out/evaluate-1."""
    for number in itertools.count(1):
        folder = pathlib.Path(f"out/evaluate-{number}")
        if overwrite or not (folder.exists() or pathlib.Path(f"{folder}.motions").exists()):
            return folder


def _shape(nested):
    """Returns the shape of nested lists: the length of the list, of its first item, of that item's first item, …"""
    return (len(nested), *_shape(nested[0])) if hasattr(nested, "__len__") and len(nested) else ()


def _npz(positions, names, rate_hz, said, title):
    """Returns positions, names and rate as the bytes of an .npz file, with every digit. Masked values are not seen."""
    try:
        rate_hz = array.array("d", [rate_hz])
    except TypeError:
        raise TypeError(f"rate_hz is {rate_hz!r}; allowed: a number") from None
    if hasattr(positions, "filled"):  # a masked array (numpy.ma)
        positions = positions.astype(float).filled(math.nan)
    if not len(positions) or any(len(frame) != len(names) or any(len(point) != 3 for point in frame) for frame in positions):
        shape = getattr(positions, "shape", None) or _shape(positions)
        raise ValueError(f"the array of {title} must have the shape frames × {len(names)} joints (the number of names) "
                         "× 3, not " + " × ".join(map(str, shape)))
    frames = len(positions)
    try:
        numbers = array.array("d", (x for frame in positions for point in frame for x in point))
    except TypeError as error:
        raise TypeError(f"the array of {title} contains values that are not numbers ({error}); use NaN for a joint "
                        "that was not seen") from None
    texts = []
    for key, words in [("names", names), *((key, [str(word)]) for key, word in said.items() if word is not None)]:
        width = max(map(len, words))
        letters = "".join(word.ljust(width, "\0") for word in words)
        texts.append((key, f"<U{width}", (len(words),), letters.encode("utf-32-le")))
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, kind, shape, data in [("positions", "<f8", (frames, len(names), 3), numbers.tobytes()),
                                        ("rate_hz", "<f8", (), rate_hz.tobytes()), *texts]:
            head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
            archive.writestr(f"{name}.npy", b"\x93NUMPY\1\0" + len(head).to_bytes(2, "little") + head + data)
    return content.getvalue()

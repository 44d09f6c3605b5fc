"""Judges motions, in files or arrays, by their truth (`etude evaluate`)."""
import json
import os
import pathlib
import re

from etude.program import EtudeError, call
from etude.results import load


def evaluate(truth=None, *, names=None, rate_hz=None, pairs=None, joints=None, people=None, lag=None, statistics=None,
             music_beats=None, metrics=(), output=None, overwrite=False, jobs=None, progress=True, program=None, **answers):
    """Judges answers by their truth and returns the Run, as load does.

    truth, and each answer by its method's name: a motion file, a folder or a pattern; or an array of positions, frames
    × joints × 3 in metres with Y up, NaN where a joint was not seen. Arrays need `names` of their joints and `rate_hz`;
    they are kept as TRC files in the folder `output` + ".motions". pairs: a CSV of pairs instead. joints, people, lag,
    statistics, music_beats, metrics: as the options of `etude evaluate`.

    Raises EtudeError, also if a method has no answer that can be judged; its `run` is then set.
    """
    output = pathlib.Path("out/evaluate-1" if output is None else output)
    if (truth is None) != (pairs is not None) or (pairs is None) != bool(answers):
        raise TypeError("evaluate needs a truth and answers by name, or pairs, one of the two")

    def reference(motion, name):
        if isinstance(motion, (str, os.PathLike)):
            return os.fspath(motion)
        if names is None or rate_hz is None:
            raise TypeError(f"the array of {name} needs names and rate_hz")
        path = pathlib.Path(f"{output}.motions") / f"{name}.trc"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(_trc(motion, list(names), rate_hz, name), encoding="utf-8")
        return str(path)

    arguments = ["evaluate"]
    if pairs is None:
        arguments += [reference(truth, "truth"), *(f"{name}={reference(each, name)}" for name, each in answers.items())]
    for flag, value in (("--pairs", pairs), ("--joints", joints), ("--people", people), ("--lag", lag),
                        ("--statistics", statistics), ("--music-beats", music_beats), ("--jobs", jobs)):
        arguments += [flag, os.fspath(value) if isinstance(value, os.PathLike) else str(value)] if value is not None else []
    for metric in metrics:
        arguments += ["--metric", metric]
    arguments += ["-o", str(output)] + ["--overwrite"] * overwrite
    code, printed, said = call(*arguments, program=program, progress=progress, allowed=(0, 1))
    found = load(output, program=program)
    if code != 0:
        rows = (json.loads(line) for line in (output / "cells.jsonl").read_text(encoding="utf-8").splitlines())
        why = next((f": {row['method']}, {row['reason']}" for row in rows if row["status"] != "ok"), "")
        raise EtudeError("a method has no answer that can be judged" + why, code, printed + said, found)
    return found


def _trc(positions, names, rate_hz, name):
    """Returns the text of a TRC file in metres that holds every digit."""
    frames = [[[float(x) for x in point] for point in frame] for frame in positions]
    if not frames or any(len(frame) != len(names) or any(len(point) != 3 for point in frame) for frame in frames):
        raise ValueError(f"the array of {name} must be frames × {len(names)} joints × 3")
    wrong = [each for each in names if not re.fullmatch(r"[^\t\r\n]+", each)]
    if wrong:
        raise ValueError(f"{wrong[0]!r} is no name of a joint")
    lines = [f"PathFileType\t4\t(X/Y/Z)\t{name}.trc",
             "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames",
             f"{rate_hz!r}\t{rate_hz!r}\t{len(frames)}\t{len(names)}\tm\t{rate_hz!r}\t1\t{len(frames)}",
             "Frame#\tTime\t" + "\t\t\t".join(names) + "\t\t",
             "\t\t" + "\t".join(f"{axis}{i + 1}" for i in range(len(names)) for axis in "XYZ"), ""]
    for f, frame in enumerate(frames):
        cells = ["" if any(x != x for x in point) else repr(x) for point in frame for x in point]
        lines.append(f"{f + 1}\t{f / rate_hz!r}\t" + "\t".join(cells))
    return "\n".join(lines) + "\n"

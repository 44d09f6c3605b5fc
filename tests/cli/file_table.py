"""Prints, for each motion file, what the program reads, and how far its joints lie from second readers' positions.

    ETUDE=build/release/etude python3 tests/cli/file_table.py FOLDER            # a line of Markdown per file
    ETUDE=build/release/etude python3 tests/cli/file_table.py --rows FOLDER     # and a transition and a capture of each

A role is compared in every frame in which a joint of the file plays it: the second reader's position, in the unit and
axes that the program reports, against `etude clip convert`, minus one floor height. Roles at points between markers are
not compared. `--rows`: `played` makes a transition from the clip to `builtin:wave`, and the clip is filmed for a fifth
of a second and captured with adaptive weights, as in scenarios/quick.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

import second_readers as readers

SECOND = {"BVH": readers.read_bvh, "Acclaim": readers.read_acclaim, "DeepMimic": readers.read_deepmimic}


def call(*arguments):
    return subprocess.run([os.environ["ETUDE"], *map(str, arguments)], capture_output=True, text=True)


def converted(source, rate):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "joints.csv"
        result = call("clip", "convert", source, out, "--rate", rate)
        if result.returncode != 0:
            raise ValueError(result.stderr)
        rows = list(csv.reader(out.read_text().splitlines()))
    names = [name[:-4] for name in rows[0] if name.endswith("_x_m")]
    numbers = numpy.array([[float(v) for v in row[len(row) - 3 * len(names):]] for row in rows[1:]])
    return dict(zip(names, numbers.reshape(len(numbers), -1, 3).transpose(1, 0, 2)))


def worst_mm(path, facts):
    """Returns a joint's largest distance (mm) from the second reader's, and the number of joints; None without a
    second reader."""
    body, rate = facts["body"], facts["rate_hz"]
    if facts["format"] in ("GLB", "glTF"):
        theirs = readers.read_gltf(path, facts["source"].partition("#")[2], rate, facts["frames"])
    elif facts["format"] in SECOND:
        theirs = SECOND[facts["format"]](path)
    else:
        return None
    ours = converted(facts["source"], rate)
    turned = numpy.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]) if body["up"] == "z" else numpy.eye(3)
    apart = []
    for role, told in body["roles"].items():
        # The program puts the hip centre between the hips, wherever the file has it. In some formats limb ends have no
        # name.
        if told["composed"] or role == "hip_centre" or told["joint"] not in theirs:
            continue
        # The program may drop one leading frame (a T-pose), and reports it.
        place = theirs[told["joint"]][:facts["frames"]] @ turned.T * body["metres_per_unit"]
        dropped = len(place) - len(ours[role])
        assert dropped == 0 or (body["dropped_t_pose"] and dropped > 0), (path, dropped)
        apart.append(ours[role] - place[dropped:])
    apart = numpy.array(apart)
    apart[..., 1] -= apart[..., 1].mean()  # subtract the floor's height, which `info` finds at another rate
    return 1000 * numpy.linalg.norm(apart, axis=2).max(), len(apart)


SCENARIOS = """defaults: {trials: 1}
scenarios:
"""
SCENARIO = """  - {{scenario: t{number}, question: q, task: transition, clips: [{clip}, 'builtin:wave'],
     methods: [{{name: played, choice: played, join: planted-feet}}]}}
  - {{scenario: c{number}, question: q, task: capture, duration_s: 0.2, clips: [{clip}],
     methods: [{{name: adaptive, segmenter: hue, calibration: dlt, solver: ccd, weights: adaptive}}]}}
"""


def run_rows(sources):
    """Runs a transition and a capture of each source in one run; returns {source: results}."""
    with tempfile.TemporaryDirectory() as folder:
        suite, out = pathlib.Path(folder) / "s.yaml", pathlib.Path(folder) / "out"
        suite.write_text(SCENARIOS + "".join(SCENARIO.format(number=i, clip=json.dumps(source)) for i, source in enumerate(sources)))
        result = call("run", suite, "-o", out)
        if not (out / "cells.jsonl").exists():
            raise ValueError(result.stderr)
        told = {source: [] for source in sources}
        for line in (out / "cells.jsonl").read_text().splitlines():
            row = json.loads(line)
            metric = "jump_cm" if row["task"] == "transition" else "mpjpe_mm"
            value = row["status"] if row.get(metric) is None else f"{row[metric]:.1f} {metric.rpartition('_')[2]}"
            told[sources[int(row["scenario"][1:])]].append(value)
    return {source: ", ".join(values) for source, values in told.items()}


def rows_of(path):
    told = call("clip", "info", path, "--json")
    if not told.stdout:
        yield {"file": path, "complaint": told.stderr.strip()}
        return
    for facts in json.loads(told.stdout)["clips"]:
        if facts["complaint"] or not facts.get("body"):
            yield {"file": path, "complaint": facts["complaint"]}
            continue
        body = facts["body"]
        played = sum(not role["composed"] for role in body["roles"].values())
        yield {"file": path, "source": facts["source"], "format": facts["format"], "roles": played, "stature_m": body["stature_m"],
               "unit": body["unit"], "metres_per_unit": body["metres_per_unit"], "up": body["up"], "frames": facts["frames"],
               "slide_m_s": body["foot_slide_m_s"], "note": body["note"], "worst_mm": worst_mm(path, facts)}


def main():
    folders = [pathlib.Path(word) for word in sys.argv[1:] if word != "--rows"]
    paths = [path for folder in folders for path in ([folder] if folder.is_file() else folder.rglob("*")) if path.is_file()]
    rows = [row for path in sorted(paths) for row in rows_of(path)]
    ran = run_rows([row["source"] for row in rows if "format" in row]) if "--rows" in sys.argv else {}
    for row in rows:
        if "format" not in row:
            print(f"| {row['file']} | refused: {row['complaint']} |")
            continue
        worst = "" if row["worst_mm"] is None else "{:.3g} of {}".format(*row["worst_mm"])
        print(f"| {row['source']} | {row['format']} | {row['roles']} | {row['stature_m']:.2f} | {row['unit']} | "
              f"{row['metres_per_unit']:.4g} | {row['up']} | {worst} | {ran.get(row['source'], '')} | {row['note']} |")


if __name__ == "__main__":
    main()

"""Runs worlds of every task on this machine's CPU and on emulated ones, and compares every cell's bytes.

The control: another seed must give other bytes. Skipped (exit code 77) where qemu-user is not installed.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ETUDE = os.environ["ETUDE"]
CPUS = ["Nehalem", "Haswell", "max"]
WORLDS = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 5], [3, 0, 0], [3, 0, 7]]  # capture, detection, ik, transition


def set_up(scratch):
    """A suite as its manifest tells it, and the environment that its workers ran in."""
    suite = scratch / "suite"
    suite.mkdir()
    for path in sorted(pathlib.Path("scenarios/quick").glob("*.yaml")):
        (suite / path.name).write_text(path.read_text().replace("duration_s: 5", "duration_s: 0.4"))
    out = scratch / "out"
    subprocess.run([ETUDE, "run", suite, "--trials", "1", "-o", out], check=True, capture_output=True)
    manifest = json.loads((out / "manifest.json").read_text())
    host = json.loads((out / "host.json").read_text())
    environment = dict(os.environ, **dict(setting.split("=", 1) for setting in host["pinned_environment"]))
    methods = {}  # of each scenario
    for line in (out / "cells.jsonl").read_text().splitlines():
        row = json.loads(line)
        methods.setdefault(row["scenario"], {})[row["method"]] = None
    orders = [{"world": world, "methods": list(range(len(methods[manifest["scenarios"][world[0]]["name"]])))}
              for world in WORLDS]
    return {key: manifest[key] for key in ("suite", "seed", "scenarios", "sources")}, orders, environment


def cells(launcher, setup, orders, environment):
    """The cells of every world as a worker wrote them, what they took left out."""
    lines = [json.dumps({"setup": setup, "error_folder": ""}), *map(json.dumps, orders)]
    result = subprocess.run([*launcher, ETUDE, "worker"], input="\n".join(lines) + "\n", env=environment,
                            capture_output=True, text=True)
    worlds = result.stdout.split("built\n")[1:]
    assert len(worlds) == len(orders), f"{launcher}: {len(worlds)} worlds; {result.stderr[-500:]}"
    answers = []
    for order, text in zip(orders, worlds):
        answers.append([{key: value for key, value in json.loads(line).items() if key != "usage"}
                        for line in text.splitlines()])
        assert len(answers[-1]) == len(order["methods"]), f"{launcher}: {order}; {result.stderr[-500:]}"
    return [json.dumps(answer) for answer in answers]


def main():
    emulator = shutil.which("qemu-x86_64")
    if emulator is None:
        print("qemu-x86_64 is not installed: nothing was compared")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        setup, orders, environment = set_up(pathlib.Path(folder))
        for scenario in setup["scenarios"]:
            scenario["trials"] = 8
        here = cells([], setup, orders, environment)
        other = json.loads(json.dumps(setup))
        for scenario in other["scenarios"]:
            scenario["seed"] = 2
        assert all(a != b for a, b in zip(here, cells([], other, orders, environment))), "the control: another seed, same bytes"
        for cpu in CPUS:
            there = cells([emulator, "-cpu", cpu], setup, orders, environment)
            for world, a, b in zip(WORLDS, here, there):
                assert a == b, f"world {world} differs on {cpu}"
            print(f"{cpu}: {len(WORLDS)} worlds, same bytes")


if __name__ == "__main__":
    main()

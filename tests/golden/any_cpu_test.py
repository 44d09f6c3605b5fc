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
    return {key: manifest[key] for key in ("suite", "seed", "scenarios")}, environment


def cells(launcher, setup, environment):
    """The cells of every world as a worker wrote them."""
    lines = [json.dumps(setup), *map(json.dumps, WORLDS)]
    result = subprocess.run([*launcher, ETUDE, "worker"], input="\n".join(lines) + "\n", env=environment,
                            capture_output=True, text=True)
    answers = [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]
    assert len(answers) == len(WORLDS), f"{launcher}: {len(answers)} answers; {result.stderr[-500:]}"
    return [json.dumps(answer["cells"]) for answer in answers]


def main():
    emulator = shutil.which("qemu-x86_64")
    if emulator is None:
        print("qemu-x86_64 is not installed: nothing was compared")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        setup, environment = set_up(pathlib.Path(folder))
        for scenario in setup["scenarios"]:
            scenario["trials"] = 8
        here = cells([], setup, environment)
        other = json.loads(json.dumps(setup))
        for scenario in other["scenarios"]:
            scenario["seed"] = 2
        assert all(a != b for a, b in zip(here, cells([], other, environment))), "the control: another seed, same bytes"
        for cpu in CPUS:
            there = cells([emulator, "-cpu", cpu], setup, environment)
            for world, a, b in zip(WORLDS, here, there):
                assert a == b, f"world {world} differs on {cpu}"
            print(f"{cpu}: {len(WORLDS)} worlds, same bytes")


if __name__ == "__main__":
    main()

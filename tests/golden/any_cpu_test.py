"""Runs worlds of every task and every solver of inverse kinematics on this machine's CPU and on emulated ones, and
compares every cell's bytes. Tests that compare solvers in lanes with their scalar form also run on every CPU.

The control: another seed must give other bytes. Skipped (exit code 77) without qemu-user.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

ETUDE = os.environ["ETUDE"]
PROGRAM = pathlib.Path(ETUDE).resolve().with_name("etude_program")  # an emulator would not emulate what ETUDE starts
LANE_TESTS = [os.environ["SOLVER_TESTS"], "--gtest_filter=GaussNewtonBatch.*LastBit:GaussNewton.Is*"]
# Intel's CPUs that introduced AVX (SandyBridge), F16C (IvyBridge), FMA and AVX2 (Haswell), ADX (Broadwell); AMD's with FMA4
# (Opteron_G4) and AVX2 (EPYC); all that the emulator supports (max). The oldest one is x86-64-v2.
CPUS = ["Nehalem", "SandyBridge", "IvyBridge", "Haswell", "Broadwell", "Skylake-Client", "Opteron_G4", "EPYC", "max"]
WORLDS = [  # scenario, condition, trial
    ("capture", 0, 0),
    ("coach-policy", 0, 0),
    ("detection-weights", 0, 0),
    ("ik-weights", 0, 0),
    ("ik-weights", 1, 5),
    ("transition-weights", 0, 0),
    ("transition-weights", 0, 7),
    ("every-solver", 0, 0),
    ("every-solver", 1, 3),
    ("every-solver-tracks", 0, 0),
    ("every-switch", 0, 0),
    ("every-switch", 0, 5),
    ("every-distance", 0, 0),
    ("every-capture", 0, 0),
    ("furnished-capture", 0, 0),
]
EVERY_SOLVER = """defaults: {seed: 1, methods: [METHODS]}
scenarios:
  - {scenario: every-solver, task: ik, max_sweeps: 60, stop_at: tight, sweep: {poses: [0.5, 1]},
     record: [effector_errors, angle_changes, effector_curves], metrics: [solved_tight], question: 'Same bytes?'}
  - {scenario: every-solver-tracks, task: tracking, max_sweeps: 5, duration_s: 0.4, clips: ['builtin:*'],
     metrics: [mpjpe_mm], question: 'Same bytes?'}
  - {scenario: every-distance, task: pose-distance, pairs: frames, pairs_per_world: 50, clips: ['builtin:*'],
     metrics: [close_auc], question: 'Same bytes?',
     methods: [{name: fuzzy}, {name: adaptive, weights: adaptive}, {name: genetic, weights: genetic},
               {name: cloud, distance: point-cloud}, {name: joints, distance: joint-positions}]}
  - {scenario: every-switch, task: transition, clips: ['builtin:*'], metrics: [jump_cm], question: 'Same bytes?',
     methods: [{name: paper}, {name: genetic, weights: genetic, join: crossfade},
               {name: kovar, choice: fuzzy-kovar, join: inertialised-quintic}, {name: window, choice: fuzzy-window},
               {name: cloud, choice: point-cloud, join: inertialised-spring}, {name: matching, choice: motion-matching},
               {name: standing, choice: through-standing, join: crossfade}, {name: end, choice: wait-for-end},
               {name: played, choice: played, join: planted-feet},
               {name: natural, choice: unbroken}]}
  - {scenario: every-capture, task: capture, duration_s: 0.1, clips: ['builtin:boxing'], rig: ring, cameras: 3,
     radial_distortion: -0.05, sync_offset_ms: 20, metrics: [mpjpe_mm], question: 'Same bytes?',
     methods: [{name: fitted, segmenter: hue-gated, outliers: reject, sync: estimated},
               {name: paper, segmenter: hue, body: paper, solver: ccd}, {name: refined, calibration: refined, segmenter: ratio},
               {name: ends, segmenter: rgb, recovery: ends, smoothing: rts}, {name: bundle, recovery: bundle},
               {name: lengths, segmenter: running, recovery: bundle, lengths: measured, smoothing: rts},
               {name: silhouettes, segmenter: hue-gated, recovery: silhouettes}]}
  - {scenario: furnished-capture, task: capture, duration_s: 0.1, clips: ['builtin:boxing'], scene: 0.5, clothes: coded,
     calibration_target: boards, metrics: [mpjpe_mm], question: 'Same bytes?',
     methods: [{name: annotator, segmenter: rgb, pieces: large}, {name: colours, segmenter: rgb, pieces: large, marks: colours},
               {name: bundle, segmenter: rgb, pieces: large, marks: colours, recovery: bundle},
               {name: live, segmenter: rgb, marks: colours, causal: true}]}
"""


def every_solver():
    """Returns a suite file with everything that `etude list methods` lists."""
    listed = subprocess.run([ETUDE, "list", "methods"], check=True, capture_output=True, text=True).stdout
    ik = listed[re.search(r"^ik ", listed, re.MULTILINE).start():]
    solvers = re.search(r"solver: (.*)", ik)[1].split(", ")
    assert "ceres-lm" in solvers, solvers
    return EVERY_SOLVER.replace("METHODS", ", ".join(f"{{name: {name}, solver: {name}}}" for name in solvers))


def set_up(scratch):
    """Returns a suite as in its manifest, and the environment of its workers."""
    suite = scratch / "suite"
    suite.mkdir()
    for path in sorted(pathlib.Path("scenarios/quick").glob("*.yaml")):
        (suite / path.name).write_text(path.read_text().replace("duration_s: 5", "duration_s: 0.4"))
    (suite / "every_solver.yaml").write_text(every_solver())
    out = scratch / "out"
    run = subprocess.run([ETUDE, "run", suite, "--trials", "1", "-o", out], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    manifest = json.loads((out / "manifest.json").read_text())
    host = json.loads((out / "host.json").read_text())
    environment = {"PATH": os.environ["PATH"], **dict(setting.split("=", 1) for setting in host["pinned_environment"])}
    methods = {}  # methods of each scenario
    for line in (out / "cells.jsonl").read_text().splitlines():
        row = json.loads(line)
        methods.setdefault(row["scenario"], {})[row["method"]] = None
    names = [scenario["name"] for scenario in manifest["scenarios"]]
    assert set(names) == {name for name, _, _ in WORLDS}, f"of every scenario, a world: {names}"
    orders = [{"world": [names.index(name), condition, trial], "first_cell": 0, "methods": list(range(len(methods[name])))}
              for name, condition, trial in WORLDS]
    return {key: manifest[key] for key in ("suite", "seed", "scenarios", "sources")}, orders, environment


def cells(launcher, setup, orders, environment):
    """Returns the cells of every world as a worker wrote them, without their usage and checksums."""
    lines = [json.dumps({"setup": setup, "error_folder": "", "fence": {"program": "", "hidden": [], "kept": [], "groups": "", "programs": 1}}), *map(json.dumps, orders)]
    result = subprocess.run([*launcher, PROGRAM, "worker"], input="\n".join(lines) + "\n", env=environment,
                            capture_output=True, text=True)
    worlds = result.stdout.split("built\n")[1:]
    assert len(worlds) == len(orders), f"{launcher}: {len(worlds)} worlds; {result.stderr[-500:]}"
    answers = []
    for order, text in zip(orders, worlds):
        answers.append([{key: value for key, value in json.loads(line).items() if key not in ("usage", "sum")}
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

        def compare(cpu):
            there = cells([emulator, "-cpu", cpu], setup, orders, environment)
            for world, a, b in zip(WORLDS, here, there):
                assert a == b, f"world {world} differs on {cpu}"
            lanes = subprocess.run([emulator, "-cpu", cpu, *LANE_TESTS], capture_output=True, text=True)
            assert lanes.returncode == 0 and "[  PASSED  ]" in lanes.stdout, f"{cpu}: {lanes.stdout[-500:]}"
            return cpu

        with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            for cpu in pool.map(compare, CPUS):
                print(f"{cpu}: {len(WORLDS)} worlds, same bytes", flush=True)


if __name__ == "__main__":
    main()

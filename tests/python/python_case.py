"""Parts that the package's tests share: the package in the path, scratch folders, and a run that is made once."""
import json
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ETUDE = os.environ["ETUDE"]
os.environ["PATH"] = "/usr/bin:" + os.environ["PATH"]  # a fence shows no Python in a home folder
os.environ["PYTHONPATH"] = str(ROOT / "python")
sys.path.insert(0, str(ROOT / "python"))
CACHE = tempfile.TemporaryDirectory()
os.environ["XDG_CACHE_HOME"] = CACHE.name

SCENARIO = {
    "scenario": "ik", "question": "Does it run?", "task": "ik", "poses": {"uniform": 0.5}, "trials": 6,
    "sweep": {"joint_noise_deg": [5, 15]},
    "methods": [{"name": "fixed", "solver": "ccd", "weights": "fixed"},
                {"name": "adaptive", "solver": "ccd", "weights": "adaptive"},
                {"name": "least-squares", "solver": "damped-least-squares"}],
    "metrics": ["orientation_error_deg", "position_error_cm", "solved_practical", "iterations"],
    "max_sweeps": 50,
    "video": {"compare": ["fixed", "adaptive"], "trials": [0]},
}


def rows_of(folder):
    return [json.loads(line) for line in (pathlib.Path(folder) / "cells.jsonl").read_text().splitlines()]


class PythonCase(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    @classmethod
    def shared_folder(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        return pathlib.Path(scratch.name)

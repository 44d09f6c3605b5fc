"""Checks which folder may include which. A room is a folder with a CMakeLists.txt; it may include only the rooms in its
DEPENDS, of etude_folder(…). A room in DEPENDS that no file includes is an error, and so is a circle of rooms.
"""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
ANY = ["cli", "bench/micro", "bench/peers"]  # programs, which may include anything


def may_include(root=ROOT):
    """Returns for each room the other rooms that its files may include; None for any."""
    table = {room: None for room in ANY}
    for layer in ["engine", "sim", "io", "bench", "tools", "reports"]:
        for path in sorted((root / layer).rglob("CMakeLists.txt")):
            if call := re.search(r"^etude_folder\((.*?)\)", path.read_text(), re.M | re.S):
                depends = re.search(r"\bDEPENDS\s+(.*?)\s*(?:\b(?:PRIVATE_)?LIBRARIES\b|$)", call[1], re.S)
                table[path.parent.relative_to(root).as_posix()] = depends[1].split() if depends else []
    return table


# Rooms that know tasks: they make worlds, run methods in them, or read what people wrote.
TASKS = "bench/tasks bench/scenario bench/outside bench/run bench/finished_runs bench/dataset bench/replay bench/training"
# Rooms from which some task's worlds are made.
MATERIAL = "io/clips engine/document engine/formats engine/recognition engine/retargeting sim/choreography sim/performer"

# (rooms with all below them, rooms that none of their files may include, even indirectly). Folders include their
# subfolders.
NEVER_INCLUDES = [
    ("engine/base", "engine/motion engine/document engine/cameras"),
    ("bench/model", "bench/metrics bench/results bench/statistics bench/gate bench/recordings reports"),
    ("bench/model bench/recordings bench/results bench/statistics bench/metrics bench/gate reports", TASKS),
    ("bench/model bench/recordings bench/results bench/statistics bench/metrics bench/gate", MATERIAL),
    ("reports/words reports/growth reports/transitions reports/paper", "io/clips engine/retargeting sim"),
    ("reports/films io/drawing", "io/clips"),
]

"""Checks which folder may include which. A room is a folder with a CMakeLists.txt; it may include only the rooms in its
DEPENDS, of etude_folder(…). A room that is listed but that no file needs is an error, too. The rooms form no circle.
"""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
ANY = ["cli", "bench/micro", "bench/peers"]  # programs: they may include whatever they like


def may_include(root=ROOT):
    """room: the other rooms that its files may include; None for any."""
    table = {room: None for room in ANY}
    for layer in ["engine", "sim", "io", "bench", "tools", "reports"]:
        for path in sorted((root / layer).rglob("CMakeLists.txt")):
            if call := re.search(r"^etude_folder\((.*?)\)", path.read_text(), re.M | re.S):
                depends = re.search(r"\bDEPENDS\s+(.*?)\s*(?:\b(?:PRIVATE_)?LIBRARIES\b|$)", call[1], re.S)
                table[path.parent.relative_to(root).as_posix()] = depends[1].split() if depends else []
    return table


# What makes worlds, asks methods in them, or reads what people wrote: all that knows a task.
TASKS = "bench/tasks bench/scenario bench/outside bench/run bench/finished_runs bench/dataset bench/replay bench/training"
# What worlds of some task are made of.
MATERIAL = "io/clips engine/document engine/formats engine/recognition engine/retargeting sim/choreography sim/performer"

# (rooms with all below them, what none of their files may include even through others). Folders hold for all below.
NEVER_INCLUDES = [
    ("engine/base", "engine/motion engine/document engine/cameras"),
    ("bench/model", "bench/metrics bench/results bench/statistics bench/gate bench/recordings reports"),
    ("bench/model bench/recordings bench/results bench/statistics bench/metrics bench/gate reports", TASKS),
    ("bench/model bench/recordings bench/results bench/statistics bench/metrics bench/gate", MATERIAL),
    ("reports/words reports/growth reports/transitions reports/paper", "io/clips engine/retargeting sim"),
    ("reports/films io/drawing", "io/clips"),
]

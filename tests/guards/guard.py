#!/usr/bin/env python3
"""Guards: rules of the architecture that a compiler does not check.

    guard.py RULE ROOT              complains about every file of ROOT that breaks RULE; exit code 1
    guard.py RULE ROOT --must-flag  the control: fails unless every file of ROOT is complained about

Rules: imports, doors, determinism. Prints how many files it checked, so that a guard that looks at
nothing cannot pass for one that finds nothing.
"""
import pathlib
import re
import sys

LAYERS = ["engine", "sim", "bench", "reports", "cli"]

# Heavy libraries, by the start of their include, and the only folders that may know them.
DOORS = {
    "yaml-cpp/": ["engine/document"],
    "GL/": ["sim/render"],
    "tiny_gltf.h": ["engine/formats/gltf"],
    "OpenEXR/": ["sim/sensors"],
    "Imf": ["sim/sensors"],
    "png.h": ["sim/sensors"],
    "cairo": ["reports"],
    "CLI/": ["cli"],
    "Random123/": ["sim/random"],
    "xxhash.h": ["engine/base"],
    "nlohmann/": ["bench", "reports"],
    "boost/": ["bench/statistics"],
    "hwy/": ["engine/kinematics/solvers", "engine/transitions/search"],
    "libxml/": ["engine/transitions/tags_file"],
    "pagmo/": ["bench/training"],
    "nanoflann.hpp": ["bench/micro"],
    "ceres/": ["engine/kinematics/solvers"],
    "glog/": ["engine/kinematics/solvers"],
    "kdl/": ["bench/micro"],
    "Simbody.h": ["bench/micro"],
}
# What a header may include from outside: small, or only names.
LIGHT_HEADERS = ("glm/", "fmt/", "tl/", "nlohmann/json_fwd.hpp")

BANNED = [
    (r"std::hash\b", "differs between standard libraries; use Fingerprint"),
    (r"std::unordered_|#include <unordered_", "iterates in an order that differs between standard libraries"),
    (r"std::(random_device|mt19937|default_random_engine|\w+_distribution)\b|\bs?rand\(",
     "differs between standard libraries; use RandomStream"),
    (r"std::execution|std::(transform_)?reduce\b", "sums in an order of its own"),
    (r"std::fma\b|__builtin_fma|GLM_FORCE_INTRINSICS", "rounds differently where the CPU has no fused multiply-add"),
    (r"system_clock|\btime\(nullptr\)|\bgettimeofday\b", "the wall clock has no place in a result"),
    (r"std::(jthread|async)\b|std::thread\b(?!::hardware_concurrency)",
     "runs in an order of its own; work in parallel is done by worker processes"),
    (r"-ffast-math|-march=native|-Ofast", "gives other bytes on another machine"),
]
# Also banned, but only below these folders.
BANNED_BELOW = [
    (("engine", "sim"), r"steady_clock|clock_gettime", "engine and sim know no clock"),
    (("engine",), r"\bRandomStream\b", "engine is pure: randomness belongs to sim"),
    (("engine",), r"std::(i|o)?fstream\b|\bfopen\(", "engine reads bytes, not files"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def code_lines(path):
    """The lines of a file with comments removed, numbered from 1."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", lambda match: "\n" * match.group().count("\n"), text, flags=re.S)
    for number, line in enumerate(text.splitlines(), 1):
        yield number, re.sub(r"(^|\s)//.*", "", line)


def includes(path):
    for number, line in code_lines(path):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def check_imports(relative, path):
    layer = relative.parts[0]
    for number, target in includes(path):
        other = target.split("/")[0]
        if other in LAYERS and LAYERS.index(other) > LAYERS.index(layer):
            yield number, f"{layer} may not include {target}: imports run {' <- '.join(LAYERS)}"


def check_doors(relative, path):
    folder = relative.parent.as_posix()
    for number, target in includes(path):
        at_its_door = False
        for start, rooms in DOORS.items():
            if not target.startswith(start):
                continue
            at_its_door = any(folder == room or folder.startswith(room + "/") for room in rooms)
            if not at_its_door:
                yield number, f"{target} has one door: {', '.join(rooms)}"
        # A third-party header is one that no room of ours and no standard library has: it has a dot or a slash.
        outside = target.split("/")[0] not in LAYERS and ("." in target or "/" in target)
        system = target.startswith("sys/") or target in {"unistd.h", "signal.h", "fcntl.h", "poll.h"}
        light = system or at_its_door or target.startswith(LIGHT_HEADERS)
        if path.suffix == ".h" and outside and not light:
            yield number, f"{target} in a header: third-party headers stay in .cc files"


def check_determinism(relative, path):
    for number, line in code_lines(path):
        for pattern, why in BANNED:
            if re.search(pattern, line):
                yield number, f"'{re.search(pattern, line).group()}' {why}"
        for layers, pattern, why in BANNED_BELOW:
            if relative.parts[0] in layers and re.search(pattern, line):
                yield number, f"'{re.search(pattern, line).group()}': {why}"


RULES = {"imports": check_imports, "doors": check_doors, "determinism": check_determinism}


def main():
    rule, root = RULES[sys.argv[1]], pathlib.Path(sys.argv[2])
    must_flag = sys.argv[3:] == ["--must-flag"]
    checked, flagged = 0, set()
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*")):
            is_build_file = path.name == "CMakeLists.txt" and rule is check_determinism
            if path.suffix not in {".h", ".cc"} and not is_build_file:
                continue
            checked += 1
            for number, message in rule(path.relative_to(root), path):
                flagged.add(path)
                print(f"{path}:{number}: {message}")
    print(f"{sys.argv[1]}: {checked} files checked, {len(flagged)} flagged")
    if checked == 0:
        sys.exit("nothing was checked")
    if must_flag:
        sys.exit(0 if len(flagged) == checked else "a file that must be flagged was not")
    sys.exit(1 if flagged else 0)


if __name__ == "__main__":
    main()

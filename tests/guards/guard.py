#!/usr/bin/env python3
"""Guards: rules of the architecture that a compiler does not check.

    guard.py RULE ROOT              complains about every file of ROOT that breaks RULE; exit code 1
    guard.py RULE ROOT --must-flag  the control: fails unless it complains about every file of ROOT

Rules: imports (between top folders), rooms (folders with a CMakeLists.txt: rooms.py), doors (folders that alone may
include a heavy library), installed (headers that users of the library get), determinism, types (two types of one name,
which the linker would merge), pages (files that .md files mention), words (house words in code and pages for which the
field has a term). Prints the number of checked files, so that a guard that checks nothing cannot pass unnoticed.
"""
import fnmatch
import functools
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # write no cache into the source tree
from rooms import NEVER_INCLUDES, may_include

# For each layer, the other layers whose headers it may include.
MAY_INCLUDE = {
    "engine": [],
    "sim": ["engine"],
    "io": ["engine", "sim"],
    "bench": ["engine", "sim", "io"],
    "tools": ["engine", "sim", "io"],
    "reports": ["engine", "sim", "io", "bench"],
    "cli": ["engine", "sim", "io", "bench", "tools", "reports"],
}
LAYERS = list(MAY_INCLUDE)
NO_LAYERS = ["build", "cmake", "examples", "out", "python", "tests"]  # may hold C++ that no layer includes
FOLDERS = LAYERS + ["tests", "docs", "scripts", "scenarios", "examples", "cmake", "ci"]  # folders that pages mention

# Heavy libraries, by the beginning of their includes, and the only folders that may include them.
DOORS = {
    "yaml-cpp/": ["engine/document"],
    "toml++/": ["engine/cameras"],
    "EGL/": ["sim/render"],
    "GL/": ["sim/render"],
    "tiny_gltf.h": ["engine/formats/gltf"],
    "OpenEXR/": ["io/images"],
    "Imf": ["io/images"],
    "png.h": ["io/images"],
    "jpeglib.h": ["sim/camera"],
    "cairo": ["io/drawing"],
    "CLI/": ["cli"],
    "Random123/": ["sim/random"],
    "xxhash.h": ["engine/base"],
    "zlib.h": ["io/clips/assimp"],
    "zip.h": ["engine/formats/npz.cc"],
    "sodium.h": ["bench/results"],
    "nlohmann/": ["bench", "cli", "io", "tools", "engine/formats/deepmimic.cc", "engine/formats/gltf", "engine/formats/json_text.cc",
                  "engine/formats/json_text.h", "engine/streams", "reports"],
    "boost/": ["bench/statistics"],
    "hwy/": ["engine/kinematics/solvers", "engine/silhouettes", "engine/transitions/search", "engine/vision", "sim/random"],
    "libxml/": ["engine/cameras", "engine/transitions/tags_file"],
    "pagmo/": ["bench/training"],
    "assimp/": ["io/clips/assimp", "bench/peers"],
    "ceres/": ["engine/bundle_adjustment", "engine/cameras", "engine/kinematics/solvers"],
    "glog/": ["engine/bundle_adjustment", "engine/kinematics/solvers"],
    "kdl/": ["bench/peers"],
    "Simbody.h": ["bench/peers"],
    "opencv2/": ["bench/peers", "engine/boards/opencv"],
}
# Third-party headers that our headers may include: small ones, or ones that only declare names.
LIGHT_HEADERS = ("etude/", "glm/", "fmt/", "tl/", "nlohmann/json_fwd.hpp")

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
]
# Banned everywhere except in this folder: rival implementations there are built for speed.
BANNED_BUT_IN = [
    ("bench/peers", r"-ffast-math|-march=native|-Ofast", "gives other bytes on another machine"),
]
# Banned only below these folders.
BANNED_BELOW = [
    (("engine", "sim"), r"steady_clock|clock_gettime", "engine and sim know no clock"),
    (("engine",), r"\bRandomStream\b", "engine is pure: randomness belongs to sim"),
    (("engine",), r"std::(i|o)?fstream\b|\bfopen\(", "engine reads bytes, not files"),
]

# Files are written by io/files only, as a whole and synchronised. The other WRITERS write files that grow line by line,
# or files that are not regular.
WRITES = re.compile(r"std::o?fstream\b|\bfopen\(|\bO_CREAT\b|\bcreat\(")
WRITERS = ["io/files", "bench/outside/watched_program.cc", "io/process/child_process.cc",
           "bench/run/cell_runner.cc", "bench/run/journal.cc", "bench/run/used_keys.cc",
           "bench/run/run_folder.cc"]  # run_folder.cc makes an empty lock file

DRAW = re.compile(r"\b(\w+)\.(?:Bits|Chance|IndexBelow|Normal3?|Uniform)(?=\()|(?<=[(, ])(random|dice)(?=[,)])")
INNERMOST = re.compile(r"([({\[])([^(){}\[\]]*)[)}\]]")

INSTALLED = re.compile(r"^namespace \[\[gnu::visibility", re.M)
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def code_lines(path):
    """Returns a file's lines without comments, numbered from 1."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", lambda match: "\n" * match.group().count("\n"), text, flags=re.S)
    for number, line in enumerate(text.splitlines(), 1):
        yield number, re.sub(r"(^|\s)//.*", "", line)


def includes(path):
    for number, line in code_lines(path):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


class Rooms:
    """Finds which room includes which, directly and through other files."""

    def __init__(self, root):
        self.root = root
        self.includes_of = {}
        self.seen, self.used = set(), set()
        self.followed = 0
        self.may_include = may_include()
        if circle := find_circle(self.may_include):
            sys.exit(f"rooms: a circle: {' > '.join(circle)}")

    def room_of(self, file):
        """Returns the nearest folder above that is a room."""
        while file and file not in self.may_include:
            file = file.rpartition("/")[0]
        return file

    def own_includes(self, file):
        """Returns the files of this project that a file includes, with line numbers."""
        if file not in self.includes_of:
            found = includes(self.root / file) if (self.root / file).is_file() else []
            self.includes_of[file] = [(n, target) for n, target in found if target.split("/")[0] in LAYERS]
        return self.includes_of[file]

    def ways_from(self, file):
        """Returns every file included directly or indirectly, with the shortest way to it (breadth first)."""
        ways, queue = {}, [(file, [])]
        while queue:
            here, way = queue.pop(0)
            for _, target in self.own_includes(here):
                self.followed += 1
                if target not in ways:
                    ways[target] = way + [target]
                    queue.append((target, ways[target]))
        return ways

    def check_own(self, room, file):
        for number, target in self.own_includes(file):
            other = self.room_of(target)
            if other == room:
                continue
            self.used.add((room, other))
            allowed = self.may_include[room]
            if allowed is not None and other not in allowed:
                yield number, f"{room} may not include {target} (its DEPENDS: {' '.join(allowed) or 'no other room'})"

    def check_through_others(self, room, file):
        banned = [other for rooms, others in NEVER_INCLUDES for other in others.split() if lies_in(room, rooms.split())]
        for target, way in self.ways_from(file).items():
            if lies_in(target, banned):
                yield 1, f"{room} may know nothing of what it includes here: {' > '.join(way)}"
                return

    def __call__(self, relative, _):
        file = relative.as_posix()
        room = self.room_of(file)
        if not room:
            yield 1, f"{relative.parent} is no room: no CMakeLists.txt has an etude_folder(…) for it"
            return
        self.seen.add(room)
        yield from self.check_own(room, file)
        yield from self.check_through_others(room, file)

    def unused(self):
        """Yields the rooms without code, and the rooms in a DEPENDS that no file includes."""
        for room, others in self.may_include.items():
            if room not in self.seen:
                yield f"the room {room} holds no code"
            for other in others or []:
                if (room, other) not in self.used:
                    yield f"{room}/CMakeLists.txt: nothing of it includes {other}"


def find_circle(table):
    """Returns rooms that include each other in a circle, or nothing."""
    done = set()

    def follow(room, way):
        if room in way:
            return way[way.index(room):] + [room]
        if room in done or room not in table:
            return []
        for other in table[room] or []:
            if circle := follow(other, way + [room]):
                return circle
        done.add(room)
        return []

    return next((circle for room in table if (circle := follow(room, []))), [])


def lies_in(path, folders):
    return any(path == folder or path.startswith(folder + "/") for folder in folders)


def check_imports(relative, path):
    layer = relative.parts[0]
    if layer not in LAYERS:
        yield 1, f"{layer}/ is no layer, so that no guard reads it; allowed: {', '.join(LAYERS)}, or without rules {', '.join(NO_LAYERS)}"
        return
    for number, target in includes(path):
        other = target.split("/")[0]
        if other in LAYERS and other not in [layer, *MAY_INCLUDE[layer]]:
            yield number, f"{layer} may not include {target}; allowed: {', '.join([layer, *MAY_INCLUDE[layer]])}"


def check_doors(relative, path):
    for number, target in includes(path):
        at_its_door = False
        for start, rooms in DOORS.items():
            if not target.startswith(start):
                continue
            at_its_door = any(f"{relative}/".startswith(f"{room}/") for room in rooms)
            if not at_its_door:
                yield number, f"{target} has one door: {', '.join(rooms)}"
        # A third-party header belongs to no layer and not to the standard library: its name has a dot or a slash.
        outside = target.split("/")[0] not in LAYERS and ("." in target or "/" in target)
        system = target.startswith("sys/") or target in {"unistd.h", "signal.h", "fcntl.h", "poll.h"}
        light = system or at_its_door or target.startswith(LIGHT_HEADERS)
        if path.suffix == ".h" and outside and not light:
            yield number, f"{target} in a header: third-party headers stay in .cc files"


def check_installed(relative, path):
    root = path.parents[len(relative.parts) - 1]
    def is_installed(file):
        return "api/etude/" in file or ((root / file).is_file() and INSTALLED.search((root / file).read_text()))
    for number, target in includes(path) if path.suffix == ".h" and is_installed(relative.as_posix()) else ():
        ours = target.split("/")[0] in LAYERS
        if not is_installed(target) if ours else re.search("[./]", target) and not target.startswith(("glm/", "etude/")):
            yield number, f"{target} in a header that is installed; allowed: installed ones and GLM's"


def statements(path):
    """Returns a file's statements, each with the number of its last line."""
    text = ""
    for number, line in code_lines(path):
        text += " " + line.strip()
        if line.rstrip().endswith((";", "{", "}", ":")):
            yield number, text
            text = ""


def draws_in_any_order(statement):
    """Returns a stream that two arguments of a call, or both sides of an operator, draw from; compilers may evaluate
    either first."""
    text = DRAW.sub(r"\1\2!", statement)  # "!" marks a stream that draws
    while True:
        if mixed := re.search(r"(\w+)!(?!\()[^,;?&|=<>]*[-+*/][^,;?&|=<>]*\b\1!", INNERMOST.sub("", text)):
            return mixed[1]
        if not (group := INNERMOST.search(text)):
            return None
        thrown = [set(re.findall(r"(\w+)!", argument)) for argument in group[2].split(",")]
        twice = [dice for dice in set().union(*thrown) if sum(dice in one for one in thrown) > 1]
        if twice and group[1] == "(":
            return twice[0]
        text = text[: group.start()] + "".join(f" {dice}!" for dice in sorted(set().union(*thrown))) + text[group.end() :]


def check_determinism(relative, path):
    for number, statement in statements(path) if path.suffix in (".cc", ".h") else ():
        if dice := draws_in_any_order(statement):
            yield number, f"'{dice}' is thrown twice in no order; a variable for each"
    for number, line in code_lines(path):
        for pattern, why in BANNED:
            if re.search(pattern, line):
                yield number, f"'{re.search(pattern, line).group()}' {why}"
        for folder, pattern, why in BANNED_BUT_IN:
            if relative.parent.as_posix() != folder and re.search(pattern, line):
                yield number, f"'{re.search(pattern, line).group()}' {why}"
        for layers, pattern, why in BANNED_BELOW:
            if relative.parts[0] in layers and re.search(pattern, line):
                yield number, f"'{re.search(pattern, line).group()}': {why}"
        if relative.parts[0] in ("io", "bench", "tools", "reports", "cli") and not lies_in(relative.as_posix(), WRITERS):
            if found := WRITES.search(line):
                yield number, f"'{found.group()}' may leave half a file; WriteFileAtomically leaves none"


@functools.lru_cache
def known_names(root):
    """Returns every file and folder of the tree, by every tail of its path, with and without the extension."""
    paths = [path.relative_to(root) for folder in FOLDERS for path in [root / folder, *(root / folder).rglob("*")]]
    ends = {"/".join(path.parts[i:]) for path in paths for i in range(len(path.parts))}
    return ends | {re.sub(r"\.\w+$", "", end) for end in ends if "/" in end}


def check_pages(relative, path):
    names = known_names(path.parents[len(relative.parts) - 1])
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        for name in re.findall(r"`([\w.*/-]+?)/?`", line):
            in_tree = name.split("/")[0] in FOLDERS and "/" in name
            is_source = re.search(r"[\w*]\.(h|cc|py)$", name)
            if (in_tree or is_source) and name not in names and not fnmatch.filter(names, name):
                yield number, f"mentions {name}, which does not exist"


# House words and the field's terms. A word of the glossary's column "not" is added here once no text uses it.
WORDS = [
    (r"\bk(?:Most|Least|Fewest|Longest|Largest|Shortest|Smallest)[A-Z]\w*", "kMax… or kMin…"),
    (r"(?<!with )\bseams?\b(?! along)", "transition point"),  # except seams of cloth
    (r"manyeth|\bevery so many\b", "every n-th"),
    (r"\bis no number\b", "is not a number"),
    (r"\b(?:whence|whereof|thereof)\b", "a relative clause"),
    (r"\bfor who\b", "for the person who"),
    (r"\b(?:exhibit|looker|physique)s?\b", "the glossary's word (CONTRIBUTING.md)"),
]
GLOSSARY = "CONTRIBUTING.md"  # lists the words that are not to be used


def check_words(relative, path):
    text = path.read_text(encoding="utf-8")
    for number, line in enumerate(text.splitlines(), 1):
        for pattern, better in WORDS:
            if found := re.search(pattern, line, re.I if pattern.islower() else 0):
                yield number, f"'{found.group()}'; write: {better}"
    # A public comment begins with a full sentence about its subject.
    for start in re.finditer(r"(?m)^(?! *///).*\n *///(?!<) (Whether|Of|So that|And|Which|That|Then)\b", text):
        yield text.count("\n", 0, start.end()) + 1, f"the comment begins with '{start[1]}'; write: subject, verb, object"


class Types:
    """Finds two types of the same name in headers, whose members the linker would merge silently."""

    DEFINITION = re.compile(r"(?:class|struct) ([A-Z]\w*) *(?:final )?(?:: .*)?\{")
    OWN_NAMES = "/api/etude/"  # types there are in their own namespaces

    def __init__(self, root):
        self.places = {}
        for layer in LAYERS:
            for path in (root / layer).rglob("*.h"):
                for _, name in self.definitions(path):
                    self.places.setdefault(name, set()).add(path)

    def definitions(self, path):
        for number, line in enumerate(path.read_text().splitlines(), 1) if self.OWN_NAMES not in path.as_posix() else ():
            if found := self.DEFINITION.match(line):
                yield number, found.group(1)

    def __call__(self, relative, path):
        for number, name in self.definitions(path) if path.suffix == ".h" else ():
            if others := sorted(str(place) for place in self.places[name] - {path}):
                yield number, f"{name} is a type in {', '.join(others)}, too"


RULES = {"imports": check_imports, "doors": check_doors, "installed": check_installed, "determinism": check_determinism, "pages": check_pages, "words": check_words}


def main():
    root = pathlib.Path(sys.argv[2])
    of_the_tree = {"rooms": Rooms, "types": Types}
    rule = of_the_tree[sys.argv[1]](root) if sys.argv[1] in of_the_tree else RULES[sys.argv[1]]
    must_flag = sys.argv[3:] == ["--must-flag"]
    checked, flagged = 0, set()
    folders = {check_pages: FOLDERS, check_words: LAYERS + ["python", "docs", "scripts", "ci", "examples"]}.get(rule, LAYERS)
    if rule is check_imports:  # finds folders that are not listed
        folders = sorted(path.name for path in root.iterdir() if path.is_dir() and path.name[0] != "." and path.name not in NO_LAYERS)
    for layer in folders:
        for path in sorted((root / layer).rglob("*")):
            is_build_file = path.name == "CMakeLists.txt" and rule is check_determinism
            kinds = {check_pages: {".md"}, check_words: {".h", ".cc", ".py", ".pyi", ".js", ".md", ".yaml"}}.get(rule, {".h", ".cc"})
            if (path.suffix not in kinds and not is_build_file) or {"must_flag", "node_modules"} & set(path.relative_to(root).parts):
                continue
            checked += 1
            for number, message in rule(path.relative_to(root), path):
                flagged.add(path)
                print(f"{path}:{number}: {message}")
    print(f"{sys.argv[1]}: {checked} files checked, {len(flagged)} flagged")
    stale = []
    if isinstance(rule, Rooms):
        stale = list(rule.unused())
        print(f"rooms: {len(rule.may_include)} rooms, {len(rule.used)} pairs of rooms in use, {len(stale)} allowed in vain, "
              f"{rule.followed} includes followed")
    if checked == 0:
        sys.exit("nothing was checked")
    if must_flag:
        if isinstance(rule, Rooms) and not (stale and find_circle({"a": ["b"], "b": ["c"], "c": ["b"]})):
            sys.exit("a table that allows too much, or goes round in a circle, was not noticed")
        sys.exit(0 if len(flagged) == checked else "a file that must be flagged was not")
    if stale:
        sys.exit("\n".join(stale))
    sys.exit(1 if flagged else 0)


if __name__ == "__main__":
    main()

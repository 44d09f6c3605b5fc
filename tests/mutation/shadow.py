"""Makes and builds the mutated engine: a copy of the tree with the mutants of a sample.

`<work>/tree` links to the project's files, except engine/, which is rewritten with a sample's mutants; all mutants
at once would slow the compiler and the tests down several times. Operators with meaningless mutants leave notes in
object files; other mutants that do not compile are found by the compiler's messages. All these are left out, and
`<work>/dropped.json` lists them by their file's content."""

import hashlib
import json
import os
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

import rewrite
import sites

HERE = Path(__file__).resolve().parent
MUTATOR = ("tokens.py", "source.py", "sites.py", "rewrite.py", "shadow.py")
_MESSAGE = re.compile(r"^(?P<path>[^:\s]+):(?P<line>\d+):\d+: +(?P<kind>error|note):(?P<text>.*)$", re.MULTILINE)
_IMPOSSIBLE = re.compile(rb"etude: no mutant (\d+);")


def impossible(objects):
    """Returns the numbers of meaningless sites, from the notes that mutant.h left in object files."""
    return {int(number) for path in objects for number in _IMPOSSIBLE.findall(Path(path).read_bytes())}


def write_when_changed(path, text):
    """Writes a file only if its text changed, to avoid recompiling."""
    if path.is_symlink() or not path.exists() or path.read_text(encoding="utf-8") != text:
        path.unlink(missing_ok=True)
        path.write_text(text, encoding="utf-8")


@dataclass(frozen=True)
class Mutant:
    number: int
    file: str  # engine/…
    line: int
    column: int
    original: str
    mutation: str
    code: str  # the site's line
    site: int = 0  # number of the first mutant of its site

    @property
    def folder(self):
        return os.path.dirname(self.file)


class Shadow:
    def __init__(self, root, work):
        self.root, self.tree, self.build, self.work = Path(root), Path(work) / "tree", Path(work) / "build", Path(work)
        self.files = self._list_files()
        self.numbered, number = {}, 1  # file → [(site, number of its first mutant)]
        for file in self._engine_files():
            text = self._read(file)
            if file.endswith(".h"):
                found = sites.find_defaults(text)
            else:
                header = self.root / (file[:-3] + ".h")
                found = sites.find_sites(text, header.read_text() if header.exists() else "")
            pairs = []
            for site in found:
                pairs.append((site, number))
                number += len(site.mutations)
            self.numbered[file] = pairs
            number = -(-number // 64) * 64 + 1  # leave gaps, so that a changed file renumbers few others
        self.dropped = self._load_dropped()
        self.wanted = set()  # numbers of the sites to write: only a sample's, so that most code stays unchanged

    # --- files ---------------------------------------------------------------------------------------------------
    def _list_files(self):
        command = ["git", "-C", self.root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return sorted(file for file in listed.split("\0") if file and (self.root / file).is_file())

    def _engine_files(self):
        """Returns the files that can be mutated; files that Highway compiles once per instruction set cannot."""
        files = [f for f in self.files if f.startswith("engine/") and f.endswith((".cc", ".h"))]
        return [f for f in files if not re.search(r"foreach_target|-inl\.h|HWY_", f + self._read(f))]

    def _read(self, file):
        return (self.root / file).read_text(encoding="utf-8")

    def digest(self):
        """Returns a digest of everything that outcomes depend on, except the tests."""
        rooms = ("engine/", "tests/support/", "tests/mutation/", "sim/", "cmake/")
        return self._digest(lambda file: file.startswith(rooms) or re.match(r"tests/engine/.*\.h$", file))

    def tests_digest(self, folder):
        """Returns a digest of the tests of one of the engine's folders."""
        return self._digest(lambda file: os.path.dirname(file) == "tests/" + folder)

    def _digest(self, is_used):
        state = hashlib.sha256()
        for file in self.files:
            if is_used(file) and file.endswith((".cc", ".h", ".txt", ".cmake", *MUTATOR)):
                state.update(file.encode() + b"\0" + (self.root / file).read_bytes())
        return state.hexdigest()[:16]

    def write(self):
        wanted = set()
        for file in self.files:
            target = self.tree / file
            wanted.add(target)
            target.parent.mkdir(parents=True, exist_ok=True)
            if file in self.numbered:
                self._write_mutated(file)
            elif not target.is_symlink():
                target.unlink(missing_ok=True)
                target.symlink_to(self.root / file)
        for folder, _, names in os.walk(self.tree):
            for name in names:
                if Path(folder) / name not in wanted:
                    (Path(folder) / name).unlink()

    def _write_mutated(self, file):
        kept = [(site, n) for site, n in self.numbered[file] if self._is_there(n)]
        write_when_changed(self.tree / file, rewrite.rewrite(self._read(file), kept))

    def _is_there(self, number):
        return number in self.wanted and number not in self.dropped

    # --- mutants that do not compile -----------------------------------------------------------------------------
    def _key(self, file, site):
        content = hashlib.sha256(self._read(file).encode()).hexdigest()[:12]
        return f"{file}:{content}:{site.line}:{site.column}:{site.original}"

    def _load_dropped(self):
        path = self.work / "dropped.json"
        known = set(json.loads(path.read_text())) if path.exists() else set()
        return {n for file, pairs in self.numbered.items() for site, n in pairs if self._key(file, site) in known}

    def _save_dropped(self):
        keys = [self._key(f, site) for f, pairs in self.numbered.items() for site, n in pairs if n in self.dropped]
        (self.work / "dropped.json").write_text(json.dumps(keys))

    def _blamed(self, output):
        """Returns the numbers of the sites that the compiler's messages are about."""
        lines, types = {}, set()
        for found in _MESSAGE.finditer(output):
            file = os.path.relpath(self.build / found["path"], self.tree)  # ninja's path, relative to the build folder
            if found["kind"] == "error" and "etude_mutation::On" in found["text"]:
                types |= self._types_of_constant(file, int(found["line"]))
            about_mutants = found["kind"] == "error" or "etude_mutation" in found["text"]
            if about_mutants and file in self.numbered:
                lines.setdefault(file, set()).add(int(found["line"]))
        near = set().union(*(self._nearest(file, its) for file, its in lines.items()))
        return near | set().union(*(self._in_type(name) for name in types))

    def _types_of_constant(self, file, line):
        """Returns the types named by the constexpr variable, or static_assert, that ends in this line; their
        members' defaults must be constants."""
        if not (self.tree / file).is_file():
            return set()
        above = (self.tree / file).read_text().split("\n")[max(line - 40, 0):line]
        heads = [text for text in above if re.search(r"\b(constexpr|static_assert)\b", text)]
        return set(re.findall(r"\b[A-Z]\w+", heads[-1])) if heads else set()

    def _in_type(self, name):
        """Returns the remaining sites in the body of a struct or class of this name."""
        found = set()
        for file, pairs in self.numbered.items():
            lines = self._read(file).split("\n")
            for first, text in enumerate(lines, 1):
                if not re.match(rf"\s*(struct|class) {name}\b.*\{{", text):
                    continue
                last = next((n for n, end in enumerate(lines[first:], first + 1) if end.strip() == "};"), first)
                found |= {n for site, n in pairs if first <= site.line <= last and self._is_there(n)}
        return found

    def _nearest(self, file, lines):
        """Returns the remaining sites in the lines; if there are none, the nearest ones."""
        here = [(min(abs(site.line - line) for line in lines), n) for site, n in self.numbered[file]
                if self._is_there(n)]
        least = min(here, default=(99, 0))[0]
        return {n for away, n in here if away == least and least <= 12}

    # --- the build -----------------------------------------------------------------------------------------------
    def test_folders(self):
        return sorted({os.path.dirname(f) for f in self.files if re.match(r"tests/engine/.*\.cc$", f)})

    def compile(self, folders, jobs, log):
        """Builds the test programs of these folders, and drops what does not compile. Raises for other errors."""
        self.write()
        write_when_changed(self.work / "mutant.h", (HERE / "mutant.h").read_text())
        flags = f"-O1 -DNDEBUG -D_GLIBCXX_ASSERTIONS -include {self.work}/mutant.h -Werror=vla -fmax-errors=0"
        options = ["-DETUDE_TESTS=ON", "-DETUDE_UNITY=ON", "-DCMAKE_BUILD_TYPE=Mutation",
                   f"-DCMAKE_CXX_FLAGS_MUTATION={flags}"]
        subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", *options],
                       check=True, stdout=log, stderr=log)
        targets = ["etude_" + folder.replace("/", "_") for folder in folders]
        for _ in range(40):
            output = self.work / "build.output"
            with output.open("w") as file:
                ninja = ["nice", "-n", "10", "ninja", "-C", self.build, f"-j{jobs}", "-k0"]
                code = subprocess.run([*ninja, *targets], stdout=file, stderr=subprocess.STDOUT).returncode
            if code == 0:
                self.dropped |= impossible(self._objects(targets))
                return
            blamed = self._blamed(output.read_text())
            if not blamed:
                raise RuntimeError("The mutated engine does not compile, not because of a mutant: see build.output.")
            self.dropped |= blamed
            self._save_dropped()
            self.write()
        raise RuntimeError("The mutated engine still does not compile: see build.output.")

    def _objects(self, targets):
        command = ["ninja", "-C", self.build, "-t", "inputs", *targets]
        shown = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return [self.build / line.strip() for line in shown.splitlines() if line.strip().endswith(".o")]

    def mutants(self):
        """Returns all mutants, including those that do not compile."""
        for file, pairs in sorted(self.numbered.items()):
            lines = self._read(file).split("\n")
            for site, first in pairs:
                code = lines[site.line - 1].strip()
                for k, mutation in enumerate(site.mutations):
                    yield Mutant(first + k, file, site.line, site.column, site.original, mutation, code, first)

    def dropped_count(self):
        """Returns the number of wanted mutants that cannot be built."""
        dropped = self.dropped & self.wanted
        return sum(len(site.mutations) for pairs in self.numbered.values() for site, n in pairs if n in dropped)

"""Tests that a power cut loses nothing that a run has counted. A run's system calls are recorded (strace) and
replayed onto a model of a disk that keeps only synchronised data. The power is cut at every call, and the run is
resumed with the disk's contents. ETUDE_CUTS is the number of different disks to try (the heavy test tries all)."""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import unittest

from etude_case import ETUDE, HEAVY, EtudeCase, heavy, ik_scenario

CUTS = int(os.environ.get("ETUDE_CUTS", "100000" if HEAVY else "4"))
SCENARIO = ik_scenario(trials=6, question="Does it survive?") + "video: {compare: [fixed], trials: [0]}\n"
CALLS = "openat,creat,write,pwrite64,writev,ftruncate,fsync,fdatasync,rename,renameat,renameat2,unlink,unlinkat,mkdir,mkdirat,rmdir,close"
LINE = re.compile(r"^(\d+) +(\w+)\((.*)\) += (-?\d+)")


def unescaped(text):
    return bytes.fromhex(text.replace("\\x", ""))


def strings_of(arguments):
    return [unescaped(text) for text in re.findall(r'"((?:\\x[0-9a-f]{2})*)"', arguments)]


def recorded(command, trace, of_all=False):
    """Returns the system calls of a program's first process, or of all processes with its files: (name, arguments,
    result)."""
    subprocess.run(["strace", "-f", "-xx", "-s", "10000000", "-e", f"trace={CALLS}", "-o", trace, *command],
                   check=True, capture_output=True, timeout=300)
    calls, first, unfinished = [], None, {}
    for line in pathlib.Path(trace).read_text(errors="replace").splitlines():
        begun = re.match(r"^(\d+) +(.*) <unfinished \.\.\.>$", line)
        if begun:
            unfinished[begun[1]] = begun[2]
            continue
        resumed = re.match(r"^(\d+) +<\.\.\. \w+ resumed>(.*)$", line)
        if resumed and resumed[1] in unfinished:
            line = f"{resumed[1]} {unfinished.pop(resumed[1])}{resumed[2]}"
        match = LINE.match(line)
        if match:
            first = first or match[1]
            if (of_all or match[1] == first) and int(match[4]) >= 0:
                calls.append((match[2], match[3], int(match[4])))
    return calls


class File:
    def __init__(self):
        self.now = b""
        self.safe = None  # content that is certainly on the disk


class Disk:
    """A folder as the system shows it, and the part of it that survives a power cut."""

    def __init__(self, root):
        self.root = os.fsencode(str(root))
        self.now, self.safe, self.moved = {}, {}, {}  # names: files map to a File, folders to None
        self.open = {}

    def inside(self, path):
        return path == self.root or path.startswith(self.root + b"/")

    def paths_of(self, arguments):
        """Returns the paths that a call names, alone or in an open folder."""
        paths = []
        for folder, text in re.findall(r'(?:(\w+), )?"((?:\\x[0-9a-f]{2})*)"', arguments):
            above = self.open.get(int(folder)) if folder.isdigit() else None
            paths.append(above + b"/" + unescaped(text) if isinstance(above, bytes) else unescaped(text))
        return paths

    @staticmethod
    def move(names, paths):
        """Moves everything in the first folder to the second."""
        for path in [path for path in names if path.startswith(paths[0] + b"/")] if paths[0] else []:
            names[paths[1] + path[len(paths[0]):]] = names.pop(path)

    def apply(self, name, arguments, result):
        paths = strings_of(arguments) if name.startswith(("write", "pwrite")) else self.paths_of(arguments)
        handle = int(arguments.split(",")[0]) if re.match(r"^\d+\b", arguments) else None
        if name in ("openat", "creat"):
            path = paths[0]
            if not self.inside(path):
                self.open.pop(result, None)
            elif "O_CREAT" in arguments or name == "creat" or path in self.now:
                if "O_DIRECTORY" not in arguments and self.now.get(path) is None and "O_CREAT" in arguments:
                    self.now[path] = File()
                if "O_TRUNC" in arguments:
                    self.now[path].now = b""
                self.open[result] = path if self.now.get(path) is None else self.now[path]
            else:
                self.open[result] = path
        elif name in ("write", "pwrite64") and isinstance(self.open.get(handle), File):
            self.open[handle].now += paths[0][:result]
        elif name == "writev" and isinstance(self.open.get(handle), File):
            self.open[handle].now += b"".join(paths)[:result]
        elif name == "ftruncate" and isinstance(self.open.get(handle), File):
            self.open[handle].now = self.open[handle].now[:int(arguments.split(",")[1])]
        elif name in ("fsync", "fdatasync"):
            opened = self.open.get(handle)
            if isinstance(opened, File):
                opened.safe = opened.now
            elif opened is not None:
                here = {path for path in {*self.now, *self.safe} if os.path.dirname(path) == opened}
                for path in here:
                    self.safe.pop(path, None)
                    if path in self.now:
                        self.safe[path] = self.now[path]
                    self.move(self.safe, self.moved.pop(path, (b"", b"")))
        elif name.startswith("rename") and self.inside(paths[0]):
            self.now[paths[1]] = self.now.pop(paths[0])
            if self.now[paths[1]] is None:
                self.move(self.now, paths)
                self.moved[paths[1]] = paths  # its safe content moves when the parent folder is synchronised
        elif name.startswith("unlink") or name == "rmdir":
            self.now.pop(paths[0], None)
        elif name.startswith("mkdir") and self.inside(paths[0]):
            self.now[paths[0]] = None
        elif name == "close":
            self.open.pop(handle, None)

    def after_a_cut(self, way):
        """Returns the files by name: "least" has only synchronised data; "names" has all names, but only
        synchronised contents (as journalling file systems leave it); "most" has everything."""
        names = self.safe if way == "least" else self.now
        left = {}
        for path, file in names.items():
            folders = path[len(self.root) + 1:].split(b"/")[:-1]
            parents = [self.root + b"/" + b"/".join(folders[:i + 1]) for i in range(len(folders))]
            if file is not None and all(parent in names for parent in parents):
                left[path[len(self.root) + 1:]] = file.now if way == "most" else file.safe or b""
        return left


def counted(arguments):
    """Returns the number of finished cells in a progress line."""
    said = re.findall(rb"(\d+)/\d+ cells", b"".join(strings_of(arguments)))
    return int(said[-1]) if said else 0


def cells_on(files):
    if b"cells.jsonl" in files and b"journal.jsonl" not in files:
        return files[b"cells.jsonl"].count(b"\n")
    return max(0, files.get(b"journal.jsonl", b"").count(b"\n") - 2)


@unittest.skipUnless(shutil.which("strace") and subprocess.run(["strace", "-o", "/dev/null", "true"]).returncode == 0,
                     "needs strace, and a system that allows it")
class PowerCut(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario, cls.whole = cls.run_once(SCENARIO)

    def disks(self, command):
        """Returns every different disk that a power cut may leave, with the number of cells counted before."""
        disk, counts, found, cuts = Disk(self.out), 0, {}, 0
        for name, arguments, result in recorded(command, self.folder / "trace"):
            if name == "write" and re.match(r"^[12]\b", arguments):
                counts = max(counts, counted(arguments))
            disk.apply(name, arguments, result)
            for way in ("least", "names", "most"):
                files = disk.after_a_cut(way)
                cuts += 1
                found[tuple(sorted(files.items()))] = max(counts, found.get(tuple(sorted(files.items())), 0))
        return found, cuts

    def put(self, files):
        shutil.rmtree(self.out, ignore_errors=True)
        for name, content in files:
            path = self.out / os.fsdecode(name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)

    def sample(self, found):
        chosen = list(found.items())
        random.Random(1).shuffle(chosen)
        return chosen[:CUTS]

    def check(self, command, go_on):
        found, cuts = self.disks(command)
        self.assert_same_results(self.whole, self.out)
        tried = self.sample(found)
        for files, counts in tried:
            self.assertGreaterEqual(cells_on(dict(files)), counts, "cells that were counted are lost")
            self.put(files)
            self.ends(0, *go_on)
            self.assert_same_results(self.whole, self.out)
        print(f"{cuts} cuts, {len(found)} different disks, {len(tried)} tried")
        return found

    def test_a_run_goes_on_after_a_cut_at_any_call(self):
        run = ["run", self.scenario, "-o", str(self.out), "-j", "1", "--sync-seconds", "0"]
        self.check([ETUDE, *run], [*run, "--resume"])

    @heavy
    def test_a_merge_is_done_again_after_a_cut_at_any_call(self):
        shards = [self.folder / f"shard-{i}" for i in (1, 2)]
        for i, shard in enumerate(shards, 1):
            self.ends(0, "run", self.scenario, "-o", shard, "--shard", f"{i}/2")
        merge = ["merge", *map(str, shards), "-o", str(self.out)]
        self.check([ETUDE, *merge], [*merge, "--overwrite"])

    def test_what_exit_0_has_told_is_on_the_disk(self):
        found, _ = self.disks([ETUDE, "run", self.scenario, "-o", str(self.out), "-j", "1"])
        files = dict(list(found)[-1])
        self.assertNotIn(b"journal.jsonl", files)
        self.assertEqual(files[b"cells.jsonl"], (self.whole / "cells.jsonl").read_bytes())
        self.assertIn(b"seal.json", files)

    def test_what_other_commands_write_is_on_the_disk_when_they_have_ended(self):
        shutil.copytree(self.whole, self.out)
        shutil.rmtree(self.out / "report", ignore_errors=True)
        cell = json.loads((self.out / "cells.jsonl").read_text().splitlines()[0])["cell"]
        for written, command in (("report", ["report", "--no-video", self.out]),
                                 ("new/baseline.json", ["gate", self.whole, "--update", "--baseline"]),
                                 ("rows.jsonl", ["rows", self.whole, "-o"]),
                                 ("cell.pack", ["replay", self.whole, "--cell", cell, "--pack"]),
                                 ("data", ["export", self.scenario, "--trials", "1", "-o"]),
                                 ("clap.bvh", ["clip", "convert", "builtin:clap"])):
            with self.subTest(command=command[0]):
                path, disk = self.out / written, Disk(self.out)
                words = [*command, *([] if command[0] == "report" else [path])]
                for call in recorded([ETUDE, *map(str, words)], self.folder / "trace", of_all=True):
                    disk.apply(*call)
                left = disk.after_a_cut("least")
                files = [path] if path.is_file() else [file for file in path.rglob("*") if file.is_file()]
                self.assertGreater(len(files), 0)
                for file in files:
                    self.assertEqual(left.get(os.fsencode(str(file.relative_to(self.out)))), file.read_bytes(), file)

    def test_the_model_finds_what_is_not_synchronised(self):
        """The control: without its calls to synchronise, the disk loses counted cells."""
        disk, counts = Disk(self.out), 0
        run = [ETUDE, "run", self.scenario, "-o", str(self.out), "-j", "1", "--sync-seconds", "0"]
        for name, arguments, result in recorded(run, self.folder / "trace"):
            if name == "write" and re.match(r"^[12]\b", arguments):
                counts = max(counts, counted(arguments))
            if name not in ("fsync", "fdatasync"):
                disk.apply(name, arguments, result)
        self.assertGreater(counts, cells_on(disk.after_a_cut("least")))
        self.assertGreater(counts, cells_on(disk.after_a_cut("names")))


if __name__ == "__main__":
    unittest.main()

"""A method that looks the truth up: `lookup.py DEN SEEDS…` brings its own copy of Etude, and a copy of the scenario in
DEN.

Inside the fence it runs the scenario itself under every likely seed, and compares the problems of its own copy
(`lookup.py spy FILE`) with its own problems. It searches files, descriptors and /proc for scenarios, runs and their
names, and for notes that it left when it answered another condition. It reports what it finds on standard error, in
lines that begin with LOOKUP. In task ik it answers the truth if it has found it, else the start pose. In task tracking
it answers the truth of the known frame whose ends have the same distances from each other, whatever the body's heading,
position and size.

`lookup.py carry NOISE…` gets worlds of ik twice, with two strengths of noise, and computes the pose without noise. It
remembers problems between its starts in the page cache: by which pages of the file `memory` beside it, which it can
only read, are in memory. (Etude reads the files that `exec` names to compute their digests; `memory` is none of them.) It also reads `notes.json` beside it, if there is one, and logs its own. `lookup.py tell` is a
metric that encodes the truth of its cell in locks on files of the system, which it may open for reading; `lookup.py
listen` is a method of detection that answers what the locks encode.
"""
import ctypes
import fcntl
import hashlib
import itertools
import json
import math
import mmap
import os
import pathlib
import re
import struct
import subprocess
import sys

MEMORY = [pathlib.Path(folder) / "lookup-memory" for folder in ("/tmp", "/var/tmp", "/dev/shm")]
OWN = pathlib.Path("/tmp/lookup-own")


def found(what):
    print("LOOKUP " + what, file=sys.stderr, flush=True)


def content_of(message):
    """Returns a digest of a message without its id; messages without measured numbers identify no world."""
    if not re.search(r"\d\.\d{3}", json.dumps(message[message["type"]])) and not message.get("files"):
        return "nothing"
    told = hashlib.sha256(json.dumps(message[message["type"]], sort_keys=True).encode())
    for file in sorted(pathlib.Path(message["files"]).iterdir()) if message.get("files") else []:
        told.update(file.name.encode() + file.read_bytes())
    return told.hexdigest()


def converse(asked):
    """Speaks the protocol; `asked` returns the answer to a problem or a step, or None."""
    for line in sys.stdin:
        message = json.loads(line)
        reply = {"hello": {"type": "hello", "protocol": 1, "name": "lookup", "version": "1"}}.get(
            message["type"], {"type": "ready"})
        if message["type"] in ("setting", "begin"):
            asked(message)
        elif message["type"] in ("problem", "step"):
            answer = asked(message)
            reply = {"type": "answer", "answer": answer} if answer else {"type": "no_answer", "reason": "unknown"}
            reply["id"] = message["id"]
            if "number" in message:
                reply["number"] = message["number"]
        print(json.dumps(reply), flush=True)


def spy(file):
    def note(message):
        if message["type"] in ("problem", "step"):
            with open(file, "a") as known:
                known.write(content_of(message) + "\n")
    converse(note)


def shape_of(frame, joints):
    """Returns the distances of root and targets from each other, divided by the length of all limbs."""
    size = sum(math.hypot(*joint["offset_m"]) for joint in joints)
    places = [frame["root"]["position_m"]] + [target["position_m"] for target in frame["targets"]]
    return [math.dist(a, b) / size for a, b in itertools.combinations(places, 2)]


def is_tracking(problem):
    return "joints" in problem and "frames" in problem


def run_own_copy(den, seeds):
    """Returns what every world of the scenario is asked under these seeds: contents, the truth by content, and for
    tracking the shape of every frame with its true angles."""
    known, truth, frames = set(), {}, []
    scenario = (den / "own.txt").read_text().replace("DEN", str(den)).replace("KNOWN", str(OWN / "known"))
    OWN.mkdir()
    (OWN / "own.yaml").write_text(scenario)
    for seed in seeds:
        for command in (["run", "--no-fence", "--jobs", "1", "-o", OWN / f"run-{seed}"], ["export", "-o", OWN / f"set-{seed}"]):
            done = subprocess.run([den / "etude", command[0], OWN / "own.yaml", "--seed", seed, *command[1:]],
                                  capture_output=True, text=True, cwd=OWN)
            if done.returncode > 1 and "etude cannot write the problem before the session" not in done.stderr:
                print(f"own copy: {done.stderr}", file=sys.stderr, flush=True)
        for problem in OWN.glob(f"set-{seed}/inputs/*/*/*/problem.json"):
            asked = json.loads(problem.read_text())
            content = content_of({"type": "problem", "problem": asked})
            known.add(content)
            place = problem.parent.relative_to(OWN / f"set-{seed}" / "inputs")
            truth[content] = json.loads((OWN / f"set-{seed}" / "truth" / place / "truth.json").read_text())
            if is_tracking(asked):
                shapes = [shape_of(frame, asked["joints"]) for frame in asked["frames"]]
                frames += zip(shapes, truth[content]["angles_deg"])
    if (OWN / "known").exists():
        known |= set((OWN / "known").read_text().split())
    return known, truth, frames


def look_around(den):
    for memory in MEMORY:
        if memory.exists():
            found(f"a memory of another setting: {memory}")
        memory.write_text("asked before")
    names = [pathlib.Path(file).read_bytes() for file in ("/proc/1/cmdline", "/proc/1/environ", "/proc/self/mountinfo",
                                                          "/proc/self/environ", "/proc/self/cgroup")]
    words = b"\n".join(names).replace(str(den).encode(), b"").replace(str(den.resolve()).encode(), b"")
    for secret in (b"lookup-run", b"lookup-secret", b"lookup.yaml"):
        if secret in words:
            found(f"a name in /proc: {secret.decode()}")
    for folder in pathlib.Path("/proc").glob("[0-9]*/fd"):
        try:
            targets = [os.readlink(entry) for entry in folder.iterdir()]
        except OSError:
            continue
        for target in targets:
            if "/lookup-" in target and "lookup-memory" not in target and str(den) not in target:
                found(f"a descriptor: {target}")
    for top, folders, files in os.walk("/"):
        folders[:] = [name for name in folders if os.path.join(top, name) not in ("/proc", "/sys", "/usr", str(den), str(OWN))]
        for name in files:
            if name in ("manifest.json", "cells.jsonl", "journal.jsonl", "lookup.yaml", "key") or name.startswith("etude"):
                found(f"a file: {os.path.join(top, name)}")


def attack(den, seeds):
    look_around(den)
    known, truth, frames = run_own_copy(den, seeds)
    state = {"settings": 0}

    def asked(message):
        if re.search(r"lookup|=|/|^[a-z]?\d{1,4}$", message["id"]):
            found(f"an id that tells something: {message['id']}")
        if message["type"] == "setting":
            state["settings"] += 1
            if state["settings"] > 1:
                found("another setting in the same process")
            return None
        if message["type"] == "begin":
            return None
        content = content_of(message)
        if content in known - {"nothing"}:
            found(f"the world of {message['id']}")
        problem = message.get("problem", {})
        angles = problem.get("start_angles_deg")
        if frames and is_tracking(problem):
            shapes = [shape_of(frame, problem["joints"]) for frame in problem["frames"]]
            return {"angles_deg": [min(frames, key=lambda known: math.dist(shape, known[0]))[1] for shape in shapes]}
        if "targets" not in problem:
            return None
        return truth.get(content) or {"angles_deg": angles}

    converse(asked)


class PageMemory:
    """Writes texts by reading pages of a file: a page in memory is a one. A region holds one text."""
    REGION = 1 << 15  # pages

    def __init__(self, file):
        descriptor = os.open(file, os.O_RDONLY)
        self.size = os.fstat(descriptor).st_size
        self.pages = mmap.mmap(descriptor, self.size, prot=mmap.PROT_READ | mmap.PROT_WRITE, flags=mmap.MAP_PRIVATE)
        self.pages.madvise(mmap.MADV_RANDOM)  # reads no page except the touched one

    def read(self):
        """Returns all texts written, or None if the kernel does not report pages."""
        held = (ctypes.c_ubyte * (self.size // mmap.PAGESIZE))()
        start = ctypes.addressof(ctypes.c_char.from_buffer(self.pages))
        if ctypes.CDLL(None, use_errno=True).mincore(ctypes.c_void_p(start), ctypes.c_size_t(self.size), held) != 0:
            return None
        texts = []
        for first in range(0, len(held), self.REGION):
            bits = [page & 1 for page in held[first:first + self.REGION]]
            whole = bytes(sum(bit << place for place, bit in enumerate(bits[at:at + 8])) for at in range(0, len(bits), 8))
            length, = struct.unpack("<I", whole[:4])
            if 0 < length < len(whole) - 12 and hashlib.sha256(whole[:4 + length]).digest()[:8] == whole[4 + length:12 + length]:
                texts.append(whole[4:4 + length])
        return texts

    def write(self, region, text):
        told = struct.pack("<I", len(text)) + text
        told += hashlib.sha256(told).digest()[:8]
        for place in range(8 * len(told)):
            if told[place // 8] >> place % 8 & 1:
                self.pages[(region * self.REGION + place) * mmap.PAGESIZE]


def carry(noises):
    """Answers with the pose that two strengths of the same noise have in common."""
    memory = PageMemory(pathlib.Path(__file__).with_name("memory"))
    texts = memory.read()
    if texts is None:
        found("no memory: the kernel does not tell which pages it holds")
        texts = []
    notes = pathlib.Path(__file__).with_name("notes.json")
    known = [json.loads(text) for text in texts] + (json.loads(notes.read_text()) if notes.exists() else [])
    found(f"remembers {sum(len(each) for each in known)} worlds")
    asked_now = {}

    def asked(message):
        if message["type"] == "setting" and asked_now:  # with plain seeds one start gets all conditions
            known.append(dict(asked_now))
            asked_now.clear()
        if message["type"] != "problem":
            return None
        problem = message["problem"]
        start = problem["start_angles_deg"]
        # The targets do not depend on the noise, so their digest identifies the world.
        world = hashlib.sha256(json.dumps(problem["targets"]).encode()).hexdigest()[:8]
        asked_now[world] = start
        for before, other in enumerate(known):
            if world in other:
                found("a world that was met before")
                near, far = noises[before], noises[len(known)]
                return {"angles_deg": [(far * a - near * b) / (far - near) for a, b in zip(other[world], start)]}
        return {"angles_deg": start}

    converse(asked)
    if asked_now:  # before a run, each program is started once and only greeted
        memory.write(len(texts), json.dumps(asked_now).encode())
    print("NOTES " + json.dumps(asked_now), file=sys.stderr, flush=True)


LIVES = 64  # the lock that a running method holds


def locks():
    """Returns files that every program may open for reading, the same for all."""
    files = sorted(pathlib.Path("/usr/lib").glob("python3*/*.py"))[:LIVES + 1]
    return [os.open(file, os.O_RDONLY) for file in files]


def is_locked(descriptor):
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    fcntl.flock(descriptor, fcntl.LOCK_UN)
    return False


def tell():
    """Holds the first lock of a pair for a right event, else the second; the metric's value says whether a method is
    running."""
    files = locks()

    def asked(message):
        if message["type"] != "problem":
            return None
        for file in files:
            fcntl.flock(file, fcntl.LOCK_UN)
        for event, told in enumerate(message["problem"]["extras"]["events"]):
            fcntl.flock(files[2 * event + (told["truth"] != "right")], fcntl.LOCK_EX | fcntl.LOCK_NB)
        return {"value": float(is_locked(files[LIVES]))}

    converse(asked)


def listen():
    files = locks()
    fcntl.flock(files[LIVES], fcntl.LOCK_EX | fcntl.LOCK_NB)

    def asked(message):
        if message["type"] != "problem":
            return None
        calls = []
        for event, window in enumerate(message["problem"]["events"]):
            is_right, is_wrong = is_locked(files[2 * event]), is_locked(files[2 * event + 1])
            if is_right != is_wrong:
                found("a metric told of an event")
            calls.append({"right_at_frame": window["begin_frame"] if is_right else None, "score": float(is_right)})
        return {"events": calls, "alarms": []}

    converse(asked)


if __name__ == "__main__":
    if sys.argv[1] == "spy":
        spy(sys.argv[2])
    elif sys.argv[1] == "carry":
        carry([float(noise) for noise in sys.argv[2:]])
    elif sys.argv[1] in ("tell", "listen"):
        {"tell": tell, "listen": listen}[sys.argv[1]]()
    else:
        attack(pathlib.Path(sys.argv[1]), sys.argv[2:])

"""Kills a run, its workers and the launchers of its methods, alone and together, at random moments of the first 300
ms after the last of them has started (in every second round: after a fence has been made). A process that still
lives five seconds later was left behind for good. The round's number seeds its moment."""
import contextlib
import itertools
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

TARGETS = [combination for size in (1, 2, 3) for combination in itertools.combinations(("run", "worker", "launcher"), size)]
SCENARIO = """scenario: attack
question: Who is left?
task: ik
trials: 4
methods:
  - {name: hangs, exec: [sh, -c, 'sleep 900 & exec sleep 900']}
"""
WINDOW_S, PATIENCE_S = 0.3, 5


def children(process):
    try:
        return [int(number) for task in os.listdir(f"/proc/{process}/task")
                for number in pathlib.Path(f"/proc/{process}/task/{task}/children").read_text().split()]
    except OSError:
        return []


def marked(mark):
    """Returns a round's living processes, which have its home folder in their environment."""
    found = {}
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if b"HOME=" + mark.encode() + b"\0" in process.joinpath("environ").read_bytes():
                found[int(process.name)] = process.joinpath("cmdline").read_bytes().replace(b"\0", b" ").decode()[:120]
        except OSError:
            continue  # it has just ended, or it is not a process of ours
    return found


def kill_once(etude, targets, moment_s, at_fence=False):
    """Plays one round; the moment counts from the last target's start, or from a fence's. Returns the processes
    left, and the number killed."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="attack-"))
    try:
        (folder / "attack.yaml").write_text(SCENARIO)
        environment = {"HOME": str(folder), "PATH": os.environ["PATH"]}
        run = subprocess.Popen([etude, "run", folder / "attack.yaml", "-o", folder / "out", "--jobs", "2"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment, cwd=folder)
        deadline, workers, launchers = time.monotonic() + 60, [], []
        while run.poll() is None and time.monotonic() < deadline:
            workers = children(run.pid)
            launchers = [launcher for worker in workers for launcher in children(worker)]
            if at_fence:
                if any(children(launcher) for launcher in launchers):
                    break
                continue  # The state lasts only milliseconds, so look again at once.
            if targets == ("run",) or (workers if "launcher" not in targets else launchers):
                break
            time.sleep(0.002)
        time.sleep(moment_s)
        workers = children(run.pid)
        launchers = [launcher for worker in workers for launcher in children(worker)]
        victims = ([run.pid] if "run" in targets else []) + (workers if "worker" in targets else [])
        victims += launchers if "launcher" in targets else []
        # Every process that is now below a victim must end. A process that replaces it later may live on.
        below, look = set(), list(victims)
        while look:
            process = look.pop()
            if process not in below:
                below.add(process)
                look += children(process)
        for victim in victims:
            with contextlib.suppress(ProcessLookupError):
                os.kill(victim, 9)
        deadline = time.monotonic() + PATIENCE_S
        if "run" in targets:
            run.wait()
            while (left := marked(str(folder))) and time.monotonic() < deadline:
                time.sleep(0.05)
        else:
            def alive():
                return {number: words for number, words in marked(str(folder)).items() if number in below}
            while (left := alive()) and time.monotonic() < deadline:
                time.sleep(0.05)
            run.kill()
            run.wait()
            deadline = time.monotonic() + PATIENCE_S
            while (late := marked(str(folder))) and time.monotonic() < deadline:
                time.sleep(0.05)
            left |= late
        for process in left:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, 9)
        return left, len(victims)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def round_of(etude, targets, number):
    name = "+".join(targets)
    moment = WINDOW_S * random.Random(f"{name}/{number}").random() ** 3  # most kills are early
    left, victims = kill_once(etude, targets, moment, at_fence=number % 2 == 1)
    return {"kind": name, "round": number, "moment_s": round(moment, 4), "killed": victims, "wrong": sorted(left.values())}


def loads(count):
    """Starts `count` processes that keep a processor busy; they end with this program."""
    spin = "import ctypes; ctypes.CDLL(None).prctl(1, 9, 0, 0, 0)\nwhile True: pass"
    return [subprocess.Popen([sys.executable, "-c", spin]) for _ in range(count)]

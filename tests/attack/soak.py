"""Attacks Etude as root and as an ordinary user: runs tests at their full length, kills processes of a run, and
damages files. Each round is a line of out/soak/attack/WHO/rounds.jsonl, so that an interrupted soak continues where
it ended. Prints a table of all rounds, for docs/findings/faults.md."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import damage
import kills

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOBODY = 65534
# The attacks that are tests, too: the test's file below tests/, run here with its heavy cases.
TESTS = {
    "the fence": "zoo/zoo_test.py",
    "answers looked up": "zoo/lookup_test.py",
    "secret worlds": "cli/secret_test.py",
    "metrics that tell": "cli/metrics_test.py",
    "forged runs": "cli/verify_test.py",
    "links in others' folders": "cli/links_test.py",
    "a run replaced amid reading": "cli/overwrite_test.py",
    "full and forbidden places": "cli/full_disk_test.py",
    "faults of the machine": "cli/machine_test.py",
    "kills and cut journals": "cli/survival_test.py",
    "power cuts": "cli/power_cut_test.py",
    "interruption": "cli/interrupt_test.py",
    "bad input": "cli/errors_test.py",
}
# The targets of kills at random moments of a run's start.
KILLS = {
    "kills of a run": [("run",)],
    "kills of workers and launchers": [("worker",), ("launcher",), ("worker", "launcher")],
}
DAMAGE = "damaged files"


class Record:
    """The rounds that one user has played."""

    def __init__(self, folder, hours):
        folder.mkdir(parents=True, exist_ok=True)
        self.path, self.end = folder / "rounds.jsonl", time.monotonic() + 3600 * hours
        lines = self.path.read_text().splitlines() if self.path.exists() else []
        self.done = {(entry["attack"], entry["round"]): entry for entry in map(json.loads, lines)}

    def play(self, attack, number, of):
        if (attack, number) in self.done or time.monotonic() > self.end:
            return
        began = time.monotonic()
        entry = {"attack": attack, "round": number} | of()
        entry["seconds"] = round(time.monotonic() - began, 1)
        self.done[attack, number] = entry
        with self.path.open("a") as out:
            out.write(json.dumps(entry) + "\n")
        if entry["wrong"]:
            print(f"{attack}, round {number}: {entry['wrong']}", flush=True)


def tested(options, test):
    """Runs a test; returns how many of its cases ran, and the names of the failed cases."""
    result = subprocess.run([sys.executable, ROOT / "tests" / test], cwd=ROOT, capture_output=True, text=True,
                            env=os.environ | {"ETUDE": options.etude, "ETUDE_HEAVY": "1"})
    said = result.stdout + result.stderr
    failed = re.findall(r"^(?:FAIL|ERROR): (\S+)", said, re.MULTILINE)
    ran, skipped = re.search(r"^Ran (\d+) test", said, re.MULTILINE), re.search(r"skipped=(\d+)", said)
    what = f"{ran[1] if ran else 0} tests" + (f", {skipped[1]} of them skipped" if skipped else "")
    return {"what": what, "wrong": failed or ([said[-500:]] if result.returncode else [])}


def all_kills(options, record):
    load = kills.loads(options.load)
    try:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            games = [pool.submit(record.play, attack, number, lambda targets=targets[number % len(targets)], number=number:
                                 kills.round_of(options.etude, targets, number))
                     for attack, targets in KILLS.items() if attack in options.only for number in range(options.kills)]
            for game in games:
                game.result()
    finally:
        for process in load:
            process.kill()


def all_damage(options, record):
    with tempfile.TemporaryDirectory() as folder:
        made = damage.Damage(options.etude, folder)
        for number in range(options.mutants):
            record.play(DAMAGE, number, lambda: made.round(number))


def summary(entries):
    if "killed" in entries[0]:
        return f"{sum(entry['killed'] for entry in entries)} processes killed"
    if "damaged" in entries[0]:
        kinds = len({entry["file"] for entry in entries})
        return f"{kinds} kinds; {sum(entry['exit'] == 2 for entry in entries)} refused, the others read aright"
    return entries[-1]["what"]


def rows_of(record, who):
    for attack in dict.fromkeys(attack for attack, _ in record.done):
        entries = [entry for (of, _), entry in record.done.items() if of == attack]
        wrong = sum(len(entry["wrong"]) if isinstance(entry["wrong"], list) else bool(entry["wrong"]) for entry in entries)
        yield (f"| {attack} | {who} | {len(entries)} | {summary(entries)} | {wrong} | "
               f"{sum(entry['seconds'] for entry in entries):.0f} |"), wrong


def play_all(options, record):
    if set(KILLS) & set(options.only):
        all_kills(options, record)
    if DAMAGE in options.only:
        all_damage(options, record)
    for attack, test in TESTS.items():
        if attack in options.only:
            record.play(attack, 0, lambda: tested(options, test))


def play_as_nobody(options):
    """Plays the same attacks as a user without any rights, whose processes own no file of ours. Returns the exit
    code."""
    folder = options.out / "user"
    folder.mkdir(parents=True, exist_ok=True)
    scratch = tempfile.mkdtemp(prefix="attack-user-")
    try:
        for path in (folder, *folder.iterdir(), scratch):
            os.chown(path, NOBODY, NOBODY)
        python = shutil.which("python3", path="/usr/bin:/bin") or sys.executable  # not a Python in root's home
        return subprocess.run([python, __file__, *sys.argv[1:], "--as-user"], user=NOBODY, group=NOBODY, extra_groups=[],
                       env=os.environ | {"HOME": scratch, "TMPDIR": scratch, "PYTHONDONTWRITEBYTECODE": "1"}).returncode
    finally:
        shutil.rmtree(scratch)


def main():
    attacks = [*KILLS, DAMAGE, *TESTS]
    parser = argparse.ArgumentParser(prog="scripts/soak attack", description=__doc__)
    parser.add_argument("--only", nargs="+", choices=attacks, default=attacks, metavar="ATTACK", help="of: " + ", ".join(attacks))
    parser.add_argument("--kills", type=int, default=300, help="rounds of each kind of kill")
    parser.add_argument("--mutants", type=int, default=900, help="damaged files")
    parser.add_argument("--load", type=int, default=4, help="processes that want a processor while kills go on, beside them")
    parser.add_argument("--jobs", type=int, default=8, help="kills at a time: they are each other's load, too")
    parser.add_argument("--hours", type=float, default=24, help="after which it stops, to go on another time")
    parser.add_argument("--etude", default=os.environ.get("ETUDE", "build/release/etude"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/soak/attack"))
    parser.add_argument("--as-user", action="store_true", help=argparse.SUPPRESS)  # set if root started this process
    options = parser.parse_args()
    options.etude, is_root = os.path.abspath(options.etude), os.getuid() == 0
    record = Record(options.out / ("root" if is_root else "user"), options.hours)
    play_all(options, record)
    if options.as_user:
        return 0
    records = {"root" if is_root else "user": record}
    ended = play_as_nobody(options) if is_root else 0
    if is_root:
        records["user"] = Record(options.out / "user", 0)
    else:
        print("Not root: what root alone can try was not tried.", flush=True)
    print("\n| attack | as | rounds | what | wrong | s |\n|---|---|---|---|---|---|")
    rows = [row for who, played in records.items() for row in rows_of(played, who)]
    print("\n".join(text for text, _ in rows))
    if ended:
        print(f"\nThe attacks as a user did not come to their end: exit code {ended}.")
    return int(ended != 0 or any(wrong for _, wrong in rows))


if __name__ == "__main__":
    sys.exit(main())

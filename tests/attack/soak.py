"""What Etude is attacked with, counted: kills of a run's processes, damaged files, power cuts, and settings of a machine that hinder
it. A round is a line of out/soak/attack/rounds.jsonl, so that this goes on where it was ended."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import damage
import kills

ROOT = pathlib.Path(__file__).resolve().parents[2]
TESTS = {  # what is a test, too: here with more of its cases
    "cuts": ("power_cut_test.py", r"\d+ cuts, \d+ different disks, \d+ tried"),
    "settings": ("machine_test.py", r"Ran \d+ tests.*"),
}


def main():
    parser = argparse.ArgumentParser(prog="scripts/soak attack", description=__doc__)
    parser.add_argument("--only", nargs="+", choices=["kills", "damage", *TESTS], default=["kills", "damage", *TESTS])
    parser.add_argument("--rounds", type=int, default=500, help="of each kind of kill, and of cuts; four times as many of damage")
    parser.add_argument("--load", type=int, default=4, help="processes that want a processor while kills go on, beside them")
    parser.add_argument("--jobs", type=int, default=8, help="kills at a time: they are each other's load, too")
    parser.add_argument("--hours", type=float, default=24, help="after which it stops, to go on another time")
    parser.add_argument("--etude", default=os.environ.get("ETUDE", "build/release/etude"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/soak/attack"))
    options = parser.parse_args()
    options.etude = os.path.abspath(options.etude)
    options.out.mkdir(parents=True, exist_ok=True)
    record = options.out / "rounds.jsonl"
    lines = record.read_text().splitlines() if record.exists() else []
    done = {(entry["kind"], entry["round"]): entry for entry in map(json.loads, lines)}
    end = time.monotonic() + 3600 * options.hours
    with record.open("a") as out:
        def play(kind, number, of):
            if (kind, number) in done or time.monotonic() > end:
                return
            entry = done[kind, number] = {"kind": kind, "round": number} | of()
            out.write(json.dumps(entry) + "\n")
            out.flush()
            if entry["wrong"]:
                print(f"{kind}, round {number}: {entry['wrong']}", flush=True)

        if "kills" in options.only:
            all_kills(options, play)
        if "damage" in options.only:
            with tempfile.TemporaryDirectory() as folder:
                made = damage.Damage(options.etude, folder)
                for number in range(4 * options.rounds):
                    play("damage", number, lambda: made.round(number))
        for name in set(TESTS) & set(options.only):
            play(name, options.rounds, lambda: tested(options, *TESTS[name]))
    print(f"{'attack':<22} {'rounds':>7} {'of it':<60} {'wrong':>7}")
    for kind in dict.fromkeys(kind for kind, _ in done):
        entries = [entry for (of, _), entry in done.items() if of == kind]
        print(f"{kind:<22} {len(entries):>7} {summary(entries):<60} {sum(bool(entry['wrong']) for entry in entries):>7}")
    return any(entry["wrong"] for entry in done.values())


def all_kills(options, play):
    load = kills.loads(options.load)
    try:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            games = [pool.submit(play, "+".join(targets), number,
                                 lambda targets=targets, number=number: kills.round_of(options.etude, targets, number))
                     for number in range(options.rounds) for targets in kills.TARGETS]
            for game in games:
                game.result()
    finally:
        for process in load:
            process.kill()


def tested(options, test, counts):
    result = subprocess.run([sys.executable, ROOT / "tests/cli" / test], cwd=ROOT, capture_output=True, text=True,
                            env=os.environ | {"ETUDE": options.etude, "ETUDE_CUTS": str(options.rounds)})
    said = result.stdout + result.stderr
    return {"counts": re.findall(counts, said), "wrong": said[-2000:] if result.returncode else ""}


def summary(entries):
    if "killed" in entries[0]:
        return f"{sum(entry['killed'] for entry in entries)} processes killed"
    if "damaged" in entries[0]:
        return f"{sum(entry['exit'] == 2 for entry in entries)} refused, {sum(entry['exit'] != 2 for entry in entries)} read aright"
    return "; ".join(entries[-1]["counts"])


if __name__ == "__main__":
    sys.exit(main())

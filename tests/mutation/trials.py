"""Runs tests against mutants: finds which tests reach which mutants, and whether one of them fails."""

import contextlib
import json
import math
import os
import signal
import subprocess
import tempfile
import threading
from dataclasses import dataclass, replace
from pathlib import Path

SLOWER = 5  # a mutant whose tests take this many times as long counts as noticed, because they may never end


@dataclass(frozen=True)
class Test:
    folder: str  # the mirrored folder, engine/…
    command: tuple  # includes the pinned environment, but no filter
    name: str  # Suite.Name
    seconds: float = 0  # of processor time
    reached: frozenset = frozenset()


def list_tests(build, folders):
    """Returns the tests that ctest runs for these folders, without the heavy ones."""
    command = ["ctest", "--test-dir", build, "--show-only=json-v1"]
    shown = subprocess.run(command, check=True, capture_output=True, text=True)
    tests, known = [], set()
    for entry in json.loads(shown.stdout)["tests"]:
        folder = entry["name"]
        known.add("tests/" + folder)
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        if "tests/" + folder in folders and "heavy" not in properties.get("LABELS", []):
            command = tuple(entry["command"])
            tests += [Test(folder, command, name) for name in names_of_tests(command)]
    if not known.issuperset(folders):
        raise RuntimeError(f"ctest knows no test of {', '.join(sorted(set(folders) - known))}")
    return tests


def names_of_tests(command):
    """Returns a GoogleTest program's tests as Suite.Name, without the disabled ones."""
    listed = subprocess.run([*command, "--gtest_list_tests"], check=True, capture_output=True, text=True)
    names, suite = [], ""
    for line in listed.stdout.splitlines():
        name = line.partition("#")[0].rstrip()
        if not name.startswith(" "):
            suite = name if name.endswith(".") else ""  # other lines come from GoogleTest's main
        elif suite and "DISABLED_" not in suite + name:
            names.append(suite + name.strip())
    return names


def run_program(command, environment, cwd, cpu_seconds):
    """Returns the exit code (negative: the signal that ended it) and the processor time in seconds."""
    limits = ["prlimit", f"--cpu={cpu_seconds}:{cpu_seconds + 1}", f"--as={8 << 30}", "--core=0", f"--fsize={1 << 28}"]
    with tempfile.TemporaryDirectory() as scratch:
        process = subprocess.Popen([*limits, "nice", "-n", "10", *command], cwd=cwd, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                                   env=os.environ | environment | {"TMPDIR": scratch})
        ended = threading.Event()
        threading.Thread(target=end_when_asleep, args=(process.pid, ended), daemon=True).start()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        ended.set()
        return process.returncode, used.ru_utime + used.ru_stime


def end_when_asleep(session, ended, seconds=60):
    """Ends processes that wait for what never comes; returns true if it ended them. Processes that wait for a
    processor are not asleep, so the machine's load changes no outcome. `ended` is an event."""
    naps = 0
    while not ended.wait(seconds / 10):
        naps = naps + 1 if _all_asleep(session) else 0
        if naps == 10:
            os.killpg(session, signal.SIGXCPU)
            return True
    return False


def _all_asleep(session):
    states = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            fields = path.read_text().rpartition(")")[2].split()
            if int(fields[3]) == session:
                states.append(fields[0])
    return all(state in "SZT" for state in states)


def record(test, cwd):
    """Returns the test with its time and all mutants that it reaches. Without a mutant it must pass."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "reached"
        command = [*test.command, "--gtest_filter=" + test.name]
        code, seconds = run_program(command, {"ETUDE_MUTANTS_REACHED": str(path)}, cwd, 600)
        if code != 0 or not path.exists():
            raise RuntimeError(f"{test.folder}: {test.name} fails without a mutant (exit code {code})")
        return replace(test, seconds=seconds, reached=frozenset(map(int, path.read_text().split())))


def in_batches(tests, first=0.5, growth=8):
    """Returns batches of one program each, the quickest tests first, with growing total seconds. Quick tests kill
    most mutants, so slow ones seldom run. A batch takes one start of the program."""
    program, batches = {}, []  # each folder has one program, but this is not assumed
    for test in sorted(tests, key=lambda test: test.seconds):
        program.setdefault(test.command, []).append(test)
    for chosen in program.values():
        spent, limit, batch = 0, first, []
        for test in chosen:
            if batch and spent + test.seconds > limit:
                batches.append(batch)
                batch, limit = [], growth * (spent + test.seconds)
            batch.append(test)
            spent += test.seconds
        batches.append(batch)
    return batches


def home_of(mutant, tests):
    """Returns the folder whose tests judge the mutant: the mirrored one or the nearest parent with tests; "" for
    none."""
    home, folders = mutant.folder, {test.folder for test in tests}
    while home and home not in folders:
        home = os.path.dirname(home)
    return home


def judge(mutant, tests, cwd):
    """"killed" (a test failed), "crashed", "too slow", "survived", or "unreached", by the mirrored folder's tests."""
    home = home_of(mutant, tests)
    reaching = [test for test in tests if mutant.number in test.reached and test.folder == home]
    if not reaching:
        return "unreached"
    for chosen in in_batches(reaching):
        command = chosen[0].command
        limit = math.ceil(SLOWER * sum(test.seconds for test in chosen)) + 1
        names = ":".join(test.name for test in chosen)
        code, _ = run_program([*command, "--gtest_fail_fast", "--gtest_filter=" + names],
                              {"ETUDE_MUTANT": str(mutant.number)}, cwd, limit)
        if code in (-signal.SIGXCPU, -signal.SIGKILL):
            return "too slow"
        if code != 0:
            return "killed" if code == 1 else "crashed"
    return "survived"

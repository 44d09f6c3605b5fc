"""Tests hostile programs as outside methods, each in a run of its own, with and without a fence. It watches a
process, its files and sockets, the folders for temporary files, the run, and the processes that remain when the run
has ended."""
import ctypes
import fcntl
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ETUDE = os.environ["ETUDE"]
ZOO = pathlib.Path(__file__).with_name("zoo.py")
SCRATCH = [pathlib.Path(folder) for folder in ("/tmp", "/var/tmp", "/dev/shm")]

SCENARIO = """scenario: zoo
question: Who gets out?
task: ik
trials: 2
limits: {{time_s: 60, memory_mb: {memory_mb}}}
methods:
  - {{name: neighbour, solver: damped-least-squares}}
  - {{name: specimen, exec: [{python}, {zoo}, {name}, {den}], files: [{zoo}, {den}], time_s: {time_s}}}
"""


def sure(result):
    """Returns the result of a C function, or raises if it is an error."""
    if result < 0:
        raise OSError(result)
    return result


class Victim:
    """A bystander unrelated to the run: a process with a file, a home, sockets and shared memory."""

    def __init__(self, folder):
        self.folder = folder
        self.connections = 0
        self.home = folder / "home"
        self.home.mkdir()
        (self.home / "profile").write_text("mine\n")
        (folder / "file").write_text("mine\n")
        self.process = subprocess.Popen(
            [sys.executable, "-c", "import signal, time\n"
             "signal.signal(signal.SIGUSR1, lambda *_: print('hit', flush=True))\n"
             "print('ready', flush=True)\ntime.sleep(3600)\n"], stdout=subprocess.PIPE, text=True, start_new_session=True)
        self.process.stdout.readline()
        self.listeners = [socket.create_server(("127.0.0.1", 0)), socket.socket(socket.AF_UNIX), socket.socket(socket.AF_UNIX)]
        self.listeners[1].bind(str(folder / "socket"))
        self.listeners[2].bind("\0zoo-" + folder.name)
        for listener in self.listeners:
            listener.listen()
            threading.Thread(target=self.accept, args=(listener,), daemon=True).start()
        self.libc = ctypes.CDLL(None)
        self.key = 0x5A000000 | os.getpid()
        self.shared_memory = self.libc.shmget(self.key, 4096, 0o1600)
        self.missed, self.has_ended = set(), threading.Event()
        self.needing = threading.Thread(target=self.need, daemon=True)
        self.needing.start()
        self.before = self.look()

    def accept(self, listener):
        while True:
            try:
                listener.accept()
            except OSError:
                return
            self.connections += 1

    def need(self):
        """Repeatedly takes one of everything that the kernel counts by user or by machine, and notes what it did not
        get for half a second. (Etude ends a greedy program, but not at once.)"""
        needs = {"an inotify instance": lambda: os.close(sure(self.libc.inotify_init1(0))),
                 "a pipe of full size": self.fill_pipe, "a timer": self.make_timer,
                 "a semaphore": lambda: self.libc.semctl(sure(self.libc.semget(0, 1, 0o1600)), 0, 0),
                 "a terminal": lambda: os.close(os.open("/dev/ptmx", os.O_RDWR | os.O_NOCTTY)),
                 "an asynchronous request": self.make_request, "to pass a file on": self.send_file}
        since = dict.fromkeys(needs, time.monotonic())
        while not self.has_ended.wait(0.03):
            for name, take in needs.items():
                try:
                    take()
                    since[name] = time.monotonic()
                except OSError:
                    if time.monotonic() > since[name] + 0.5:
                        self.missed.add(name)

    def fill_pipe(self):
        pipe = os.pipe()
        size = fcntl.fcntl(pipe[1], 1032)  # F_GETPIPE_SZ
        for end in pipe:
            os.close(end)
        sure(-1 if size < 65536 else 0)

    def make_timer(self):
        timer = ctypes.c_void_p()
        sure(-abs(self.libc.timer_create(1, None, ctypes.byref(timer))))
        self.libc.timer_delete(timer)

    def make_request(self):
        numbers, context = {"x86_64": (206, 207), "aarch64": (0, 1)}[os.uname().machine], ctypes.c_ulong(0)
        sure(self.libc.syscall(numbers[0], 1, ctypes.byref(context)))
        self.libc.syscall(numbers[1], context)

    def send_file(self):
        one, other = socket.socketpair()
        with one, other:
            socket.send_fds(one, [b"x"], [0])

    def tell(self, den):
        (den / "victim.json").write_text(json.dumps({
            "pid": self.process.pid, "port": self.listeners[0].getsockname()[1], "socket": str(self.folder / "socket"),
            "abstract": "zoo-" + self.folder.name, "shared_memory": self.key, "home": str(self.home),
            "file": str(self.folder / "file"), "processes": os.readlink("/proc/self/ns/pid"),
            "network": os.readlink("/proc/self/ns/net")}))

    def look(self):
        """Returns everything that a hostile program could have changed."""
        stat = (self.folder / "file").stat()
        return {"file": ((self.folder / "file").read_text(), stat.st_mode, stat.st_nlink),
                "home": {path.name: path.read_text() for path in self.home.iterdir()},
                "alive": self.process.poll() is None,
                "priority": os.getpriority(os.PRIO_PROCESS, self.process.pid),
                "connections": self.connections, "needs": sorted(self.missed)}

    def end(self):
        self.has_ended.set()
        self.needing.join()
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        for listener in self.listeners:
            listener.close()
        self.libc.shmctl(self.shared_memory, 0, None)


def specimens():
    return os.environ.get("ETUDE_SPECIMENS", "").split() or subprocess.run(
        [sys.executable, ZOO, "list", "/"], capture_output=True, text=True, check=True).stdout.split()


def left_in_scratch():
    return sorted(str(path) for folder in SCRATCH for path in folder.glob("zoo-*") if not path.name.startswith("zoo-test-"))


def clear_scratch():
    for path in left_in_scratch():
        shutil.rmtree(path, ignore_errors=True) if os.path.isdir(path) else os.unlink(path)


def processes_of(den):
    """Returns the processes that a specimen started, by their command line or by a variable that it has set."""
    found, mark = [], str(den).encode()
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        if int(process.name) == os.getpid():
            continue
        try:
            if process.joinpath("stat").read_text().rsplit(")", 1)[1].split()[0] == "Z":
                continue
            if mark in process.joinpath("cmdline").read_bytes() or b"ZOO_DEN=" + mark in process.joinpath("environ").read_bytes():
                found.append(int(process.name))
        except OSError:
            continue  # the process has just ended
    return found


class Zoo(unittest.TestCase):
    longMessage = True

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="zoo-test-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        clear_scratch()
        self.addCleanup(clear_scratch)

    def release(self, name, *options, memory_mb=400, time_s=None):
        """Runs a specimen; returns its statuses, what it did to others and to files elsewhere, and what survived."""
        time_s = time_s or (60 if name.startswith(("opens_all", "forks_eighty", "splits_memory_in")) else
                            15 if name.startswith(("hides", "splits", "holds", "takes")) else 3)
        with tempfile.TemporaryDirectory(prefix="zoo-test-victim-") as others:
            victim = Victim(pathlib.Path(others))
            den = self.folder / f"{name}{''.join(options)}"
            (den / "marks").mkdir(parents=True)
            victim.tell(den)
            scenario = den / "zoo.yaml"
            scenario.write_text(SCENARIO.format(python=sys.executable, zoo=ZOO, name=name, den=den, memory_mb=memory_mb, time_s=time_s))
            out = den / "out"
            run = subprocess.run([ETUDE, "run", scenario, "-o", out, "--jobs", "1", *options], capture_output=True, text=True,
                                 timeout=300, cwd=ZOO.parent)
            deadline = time.monotonic() + 60
            while (survivors := processes_of(den)) and time.monotonic() < deadline:
                time.sleep(0.02)
            for process in survivors:
                os.kill(process, signal.SIGKILL)
            victims, rows = [], []
            if run.returncode in (0, 1):  # 1 means that it gave no answer
                rows = [json.loads(line) for line in (out / "cells.jsonl").read_text().splitlines()]
                seen = subprocess.run([ETUDE, "report", out, "--no-video"], capture_output=True, text=True)
            if run.returncode not in (0, 1) or seen.returncode != 0:
                victims.append("the run is not whole: " + (seen if run.returncode in (0, 1) else run).stderr.splitlines()[-1])
            for log in (out / "stderr").glob("*"):
                victims += [line.split(": ", 1)[1] for line in log.read_text(errors="replace").splitlines()
                            if line.startswith("ZOO-VICTIM ")]
            now = victim.look()
            victims += [f"its {key} changed: {now[key]}" for key in now if now[key] != victim.before[key]]
            victim.end()
            neighbours = [row for row in rows if row["method"] == "neighbour"]
            if neighbours != self.neighbours():
                victims.append("its neighbour's rows changed")
            elsewhere = left_in_scratch() + sorted(path.name for path in (den / "marks").iterdir())
            elsewhere += sorted(path.name for path in out.iterdir() if path.name not in {
                "manifest.json", "host.json", "cells.jsonl", "timings.jsonl", "summary.json", "series", "recordings", "seal.json", "stderr",
                "report", "journal.jsonl"})
            clear_scratch()
            statuses = [row["status"] for row in rows if row["method"] == "specimen"] or ["no row"]
            return statuses, victims, survivors, elsewhere

    def neighbours(self):
        """Returns the rows of the other, harmless method."""
        if not hasattr(Zoo, "alone"):
            scenario = self.folder / "alone.yaml"
            scenario.write_text(SCENARIO.format(python="python3", zoo="", name="", den="", memory_mb=400, time_s=3).rsplit("\n", 2)[0] + "\n")
            subprocess.run([ETUDE, "run", scenario, "-o", self.folder / "alone"], check=True, capture_output=True)
            Zoo.alone = [json.loads(line) for line in (self.folder / "alone" / "cells.jsonl").read_text().splitlines()]
        return Zoo.alone

    def test_nobody_gets_out(self):
        names = specimens()
        fenced = subprocess.run([ETUDE, "check-method", "--task", "ik", "--", "true"], capture_output=True, text=True)
        if not fenced.stdout.startswith("fence: bubblewrap"):
            self.skipTest(fenced.stdout)
        for name in names:
            with self.subTest(name):
                statuses, victims, survivors, elsewhere = self.release(name)
                print(f"fenced    {name}: {statuses[0]}", flush=True)
                self.assertEqual((victims, survivors, elsewhere), ([], [], []), name)
        if "ETUDE_SPECIMENS" not in os.environ:
            self.assertGreaterEqual(len(names), 50)

    @unittest.skipUnless(os.geteuid() == 0, "not run by root: what a fence keeps from root's methods alone is not tried")
    def test_root_may_do_no_more_than_others(self):
        for name in {"opens_all_for_writing", "reads_secrets_of_the_machine", "reads_who_runs_it"}.intersection(specimens()):
            with self.subTest(name):
                self.assertEqual(self.release(name)[:2], (["unsolved", "unsolved"], []))
                self.assertNotEqual(self.release(name, "--no-fence")[1], [], "the control")

    def test_who_has_many_children_and_little_memory_is_left_alone(self):
        heavy = [] if "ETUDE_SPECIMENS" in os.environ else ["splits_memory_in_seventeen_of_seventy_children"]
        for name in ["forks_eighty_idle_children", *heavy]:
            with self.subTest(name):
                self.assertEqual(self.release(name)[:2], (["unsolved", "unsolved"], []))

    def test_who_hides_memory_can_hold_it_where_there_is_enough(self):
        """The control: with a higher limit they hold the memory, so the limit stops them. The fence itself refuses
        descriptors and segments of memory."""
        for name, *options in (["in_files"], ["behind_descriptors", "--no-fence"]):
            with self.subTest(name):
                self.assertIn(f"held 540 MB {name.replace('_', ' ')}",
                              self.release(f"hides_memory_{name}", *options, memory_mb=4000, time_s=60)[1])

    def test_without_a_fence_nobody_survives(self):
        harm = {}
        names = specimens()
        for name in names:
            with self.subTest(name):
                statuses, victims, survivors, elsewhere = self.release(name, "--no-fence")
                print(f"unfenced  {name}: {statuses[0]}; victims {victims}; elsewhere {elsewhere}", flush=True)
                if victims or elsewhere:
                    harm[name] = victims + elsewhere
                self.assertEqual(survivors, [], name)
        print(f"{len(names)} specimens without a fence: {len(harm)} did harm, none survived")
        self.assertTrue(harm, "a zoo that harms nobody without a fence proves nothing of the fence")


if __name__ == "__main__":
    unittest.main()

"""Programs that try to leave the fence: `zoo.py SPECIMEN DEN`. Each answers its problems (task ik: all angles zero)
and, at its first problem or when its name says, does what a hostile program would do. DEN is a folder that zoo_test.py
watches.

In case the fence fails, every specimen limits itself: it starts few processes, each of which ends within seconds; it
takes few megabytes; and it sends signals only to processes that zoo_test.py started as targets.
"""
import contextlib
import ctypes
import fcntl
import json
import mmap
import os
import pathlib
import re
import resource
import select
import signal
import socket
import stat
import struct
import subprocess
import sys
import threading
import time

SPECIMEN, DEN = sys.argv[1], pathlib.Path(sys.argv[2])
HARMLESS_DEVICES = {os.makedev(1, minor) for minor in (3, 5, 7, 8, 9)} | {os.makedev(5, 0)}  # null, zero, full, random, urandom, tty
LIBC = ctypes.CDLL(None, use_errno=True)
LIFE_S = 20  # s, after which leftovers end by themselves
VICTIM = json.loads((DEN / "victim.json").read_text()) if (DEN / "victim.json").exists() else {}

resource.setrlimit(resource.RLIMIT_AS, (1 << 31, resource.getrlimit(resource.RLIMIT_AS)[1]))
resource.setrlimit(resource.RLIMIT_FSIZE, (64 << 20, 64 << 20))
resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
signal.alarm(LIFE_S)
os.environ["ZOO_DEN"] = str(DEN)  # marks processes for zoo_test.py


def say(**message):
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


def answer(problem):
    angles = [0] * say.angles
    say(type="answer", id=problem["id"], answer={"angles_deg": angles})


def is_fenced():
    """Returns true if this process is in another PID namespace than zoo_test.py."""
    return os.readlink("/proc/self/ns/pid") != VICTIM["processes"]


def live_on():
    """Acts as a daemon: leaves a visible mark, tries to do harm, and ends after LIFE_S."""
    signal.alarm(LIFE_S)
    harm("survivor")
    time.sleep(LIFE_S)
    os._exit(0)


def harm(what):
    """Leaves a mark outside the fence if it can."""
    for place in (DEN / "marks", pathlib.Path("/var/tmp")):
        with contextlib.suppress(OSError):
            (place / f"zoo-{SPECIMEN}-{what}").write_text("was here\n")


def victimise(what):
    """Reports that `what` succeeded, through the one file that everybody may write."""
    with contextlib.suppress(OSError):
        with open(DEN / "marks" / "victims", "a") as file:
            file.write(f"{SPECIMEN}: {what}\n")
    print(f"ZOO-VICTIM {SPECIMEN}: {what}", file=sys.stderr, flush=True)


def daemon(setsid=True, twice=True):
    if os.fork() == 0:
        if setsid:
            os.setsid()
        if twice and os.fork():
            os._exit(0)
        live_on()


# --- one call each ---------------------------------------------------------------------------------------------------
def reaches(family, address):
    with socket.socket(family) as link:
        link.settimeout(0.5)
        return link.connect_ex(address) == 0


def append(path):
    with open(path, "a") as file:
        file.write("zoo")


def is_etudes(process):
    return process > 1 and "etude" in pathlib.Path(f"/proc/{process}/comm").read_text()


PARENT, KEYS = os.getppid(), {"x86_64": 250, "aarch64": 219}  # number of the call keyctl
CALLS = {  # what a specimen has done if its call neither fails nor returns False
    "kills_the_victim": ("signalled another process", lambda: os.kill(VICTIM["pid"], signal.SIGUSR1)),
    "reads_its_parents_files": ("read its parent's open files", lambda: is_etudes(PARENT) and any(
        [os.readlink(f"/proc/{PARENT}/fd/{name}") for name in os.listdir(f"/proc/{PARENT}/fd")])),
    "reads_its_parents_environment": ("read its parent's environment", lambda: PARENT > 1 and
                                      pathlib.Path(f"/proc/{PARENT}/environ").read_bytes() != b""),
    "traces_the_victim": ("traced another process", lambda: LIBC.ptrace(16, VICTIM["pid"], 0, 0) == 0),
    "lists_processes": ("saw another process", lambda: str(VICTIM["pid"]) in os.listdir("/proc")),
    "writes_to_the_victims_output": ("opened another process's output", lambda: open(f"/proc/{VICTIM['pid']}/fd/1", "w").close()),
    "changes_the_victims_priority": ("changed another process's priority", lambda: os.setpriority(os.PRIO_PROCESS, VICTIM["pid"], 5)),
    "limits_the_victim": ("changed another process's limits",
                          lambda: resource.prlimit(VICTIM["pid"], resource.RLIMIT_CORE, (0, resource.RLIM_INFINITY))),
    "connects_to_a_port": ("reached a port of this machine", lambda: reaches(socket.AF_INET, ("127.0.0.1", VICTIM["port"]))),
    "connects_to_a_socket_file": ("reached a socket file", lambda: reaches(socket.AF_UNIX, VICTIM["socket"])),
    "connects_to_an_abstract_socket": ("reached an abstract socket", lambda: reaches(socket.AF_UNIX, "\0" + VICTIM["abstract"])),
    "asks_a_name_server": ("has a route to the network",  # TEST-NET-1: nobody answers; only a route is looked up
                           lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM).connect(("192.0.2.1", 53))),
    "opens_a_raw_socket": ("opened a raw socket", lambda: socket.socket(socket.AF_PACKET, socket.SOCK_RAW).close()),
    "finds_shared_memory": ("found shared memory", lambda: LIBC.shmget(VICTIM["shared_memory"], 1, 0) >= 0),
    "reads_the_run": ("read the manifest of the run", lambda: (DEN / "out" / "manifest.json").read_text() != ""),
    "removes_the_run": ("renamed a folder of the run", lambda: [
        os.rename(DEN / "out" / one, DEN / "out" / other) for one, other in (("stderr", "errors"), ("errors", "stderr"))]),
    "writes_into_its_folder": ("wrote into its folder", lambda: append(DEN / "marks" / "note.txt")),
    "writes_into_home": ("wrote into a home folder", lambda: append(pathlib.Path(VICTIM["home"]) / "profile")),
    "links_to_the_victims_file": ("linked to a file", lambda: os.link(VICTIM["file"], DEN / "marks" / "link")),
    "changes_a_mode": ("changed a file's mode", lambda: os.chmod(VICTIM["file"], 0o600)),
    "truncates_a_file": ("truncated a file", lambda: os.truncate(VICTIM["file"], 0)),
    "reads_others_temporary_files": ("read another's temporary file", lambda: pathlib.Path(VICTIM["file"]).read_text() != ""),
    "remounts_writable": ("made the system writable", lambda: is_fenced() and LIBC.mount(None, b"/", None, 32 | 4096, None) == 0),
    "makes_a_namespace": ("made a user namespace", lambda: LIBC.unshare(0x10000000) == 0),
    "gains_privileges": ("may gain privileges", lambda: LIBC.prctl(39, 0, 0, 0, 0) != 1),
    "leaves_its_root": ("changed its root", lambda: os.chroot("/tmp")),
    "speaks_to_the_host": ("opened a socket to the host of this machine", lambda: socket.socket(40, socket.SOCK_STREAM).close()),  # AF_VSOCK
    "reads_the_users_keys": ("reached the user's keys", lambda: LIBC.syscall(KEYS[os.uname().machine], 0, -3, 0) >= 0),
    # unshare(CLONE_FILES): the thread has open files that a count of its process's open files misses.
    "has_files_of_its_own_in_a_thread": ("has open files that nobody counts", lambda: LIBC.unshare(0x400) == 0),
    "keeps_memory_in_attributes": ("keeps memory in attributes", lambda: [
        append("/tmp/zoo-attributes"), os.setxattr("/tmp/zoo-attributes", "user.zoo", bytes(4096))]),
    "sizes_the_futex_table": ("took kernel memory for futexes", lambda: LIBC.prctl(78, 1, 1 << 10, 0, 0) == 0),
    "writes_to_its_input": ("wrote to its input", lambda: os.write(0, b"{}\n"))}


def caller(what, call):
    def specimen(_):
        with contextlib.suppress(OSError, ValueError):
            if call() is not False:
                victimise(what)
    return specimen


globals().update({name: caller(*row) for name, row in CALLS.items()})


# --- processes that stay ---------------------------------------------------------------------------------------------
def forks_once(problem):
    daemon(setsid=False, twice=False)


def forks_twice(problem):
    daemon()


def forks_twice_and_dies(problem):
    daemon()
    os._exit(0)


def forks_twice_and_is_killed(problem):
    daemon()
    os.kill(os.getpid(), signal.SIGKILL)


def forks_twice_when_input_ends():
    daemon()


def forks_thrice_when_input_ends():
    if os.fork() == 0:
        os.setsid()
        daemon()
        os._exit(0)


def forks_late_when_input_ends():
    if os.fork() == 0:
        os.setsid()
        time.sleep(0.3)
        daemon()
        os._exit(0)


def ignores_every_signal(problem):
    if os.fork() == 0:
        os.setsid()
        for number in range(1, 32):
            if number not in (signal.SIGKILL, signal.SIGSTOP, signal.SIGALRM):
                signal.signal(number, signal.SIG_IGN)
        live_on()


def renames_itself(problem):
    if os.fork() == 0:
        os.setsid()
        LIBC.prctl(15, b"kworker/0:1", 0, 0, 0)
        live_on()


def stops_itself_when_input_ends():
    if os.fork() == 0:
        os.setsid()
        os.kill(os.getpid(), signal.SIGSTOP)
        live_on()


def runs_from_stop_to_stop(problem):
    """Forks every 20 ms, so that every list of processes is outdated."""
    if os.fork() == 0:
        os.setsid()
        end = time.monotonic() + 5
        while time.monotonic() < end:
            time.sleep(0.02)
            if os.fork():
                os._exit(0)
        live_on()


def execs_another_program(problem):
    if os.fork() == 0:
        os.setsid()
        os.execvp("sleep", ["sleep", str(LIFE_S)])


def keeps_a_shell(problem):
    subprocess.Popen(["sh", "-c", f"trap '' HUP TERM INT; sleep {LIFE_S}"], start_new_session=True)


def is_not_reaped(problem):
    for _ in range(50):
        if os.fork() == 0:
            os._exit(0)


def becomes_subreaper(problem):
    LIBC.prctl(36, 1, 0, 0, 0)
    daemon()


def clears_its_death_signal(problem):
    LIBC.prctl(1, 0, 0, 0, 0)
    daemon()


def never_ends():
    time.sleep(LIFE_S)


def never_ends_in_a_thread():
    threading.Thread(target=live_on).start()


# --- others ----------------------------------------------------------------------------------------------------------
def kills_its_parent(problem):
    if is_etudes(PARENT):
        victimise("killed its parent")
        os.kill(PARENT, signal.SIGKILL)


def stops_its_parent(problem):
    """Stops its parent for a moment."""
    if is_etudes(PARENT):
        os.kill(PARENT, signal.SIGSTOP)
        victimise("stopped its parent")
        time.sleep(0.1)
        os.kill(PARENT, signal.SIGCONT)


def kills_all(problem):
    if is_fenced():
        os.kill(-1, signal.SIGKILL)  # does not signal itself
    else:
        globals()["kills_the_victim"](problem)


def kills_its_group(problem):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    os.kill(0, signal.SIGTERM)


def reads_its_parents_memory(problem):
    with contextlib.suppress(OSError, StopIteration):
        with open(f"/proc/{os.getppid()}/maps") as maps:
            line = next(line for line in maps if "[heap]" in line)
        start = int(line.split("-")[0], 16)
        with open(f"/proc/{os.getppid()}/mem", "rb") as memory:
            memory.seek(start)
            if memory.read(4096) and is_etudes(os.getppid()):
                victimise("read its parent's memory")


# --- network and messages --------------------------------------------------------------------------------------------
def listens_at_a_port(problem):
    listener = socket.create_server(("127.0.0.1", 0))
    if os.readlink("/proc/self/ns/net") == VICTIM["network"]:
        victimise(f"listens at port {listener.getsockname()[1]} of this machine")


def makes_shared_memory(problem):
    number = LIBC.shmget(0x5A006E57, 4096, 0o1600)
    if number >= 0 and not is_fenced():
        victimise("made shared memory that would outlive it")
        LIBC.shmctl(number, 0, None)


def makes_a_message_queue(problem):
    number = LIBC.msgget(0x5A006E58, 0o1600)
    if number >= 0 and not is_fenced():
        victimise("made a message queue that would outlive it")
        LIBC.msgctl(number, 0, None)


# --- files -----------------------------------------------------------------------------------------------------------
def writes_into_the_run(problem):
    for name in ("journal.jsonl", "manifest.json", "seal.json", "note.txt"):
        with contextlib.suppress(OSError):
            append(DEN / "out" / name)
            victimise(f"wrote {name} of the run")


def writes_into_tmp(problem):
    for folder in ("/tmp", "/var/tmp", "/dev/shm"):
        with contextlib.suppress(OSError):
            pathlib.Path(folder, "zoo-left-behind").write_text("zoo")


def opens_all_for_writing(problem):
    """Tries to open every path for writing, and to make a file in every folder. Writes nothing and opens no device;
    their access rights are reported instead. Without a fence it looks only where that does no harm."""
    allowed = re.compile(r"/(tmp|var/tmp|dev/shm)(/.*)?"
                         r"|/proc/[0-9]+/(task/[0-9]+/)?fd/[0-9]+")  # its own processes; the fence has no others
    found = []
    for root in "/" if is_fenced() else ("/proc/sys", str(DEN), VICTIM["home"]):
        for folder, _, names in os.walk(root):
            for path in [folder, *(os.path.join(folder, name) for name in names)]:
                if not allowed.fullmatch(path) and is_writable(path):
                    found.append(path)
    for path in found[:10]:
        victimise(f"could write {path}")
    if len(found) > 10:
        victimise(f"could write {len(found) - 10} more")


def is_writable(path):
    if os.path.islink(path):
        return False  # the link's target has a path of its own
    try:
        status = os.stat(path)
        if stat.S_ISDIR(status.st_mode):
            path = os.path.join(path, "zoo-made")
            os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL))
            os.unlink(path)
            return True
        if stat.S_ISCHR(status.st_mode) and status.st_rdev in HARMLESS_DEVICES:
            return False
        if not stat.S_ISREG(status.st_mode):
            return os.access(path, os.W_OK)
        os.close(os.open(path, os.O_WRONLY | os.O_NONBLOCK))
        return True
    except OSError:
        return False


def reads_secrets_of_the_machine(problem):
    """Reads files that only root may read."""
    for path in ("/etc/shadow", "/etc/gshadow", "/proc/slabinfo", "/proc/sys/kernel/usermodehelper/bset"):
        with contextlib.suppress(OSError):
            with open(path, "rb") as file:
                if file.read(1):
                    victimise(f"read {path}")


def reads_who_runs_it(problem):
    """Looks for the user's name and home, and the folder in which Etude was started, in every environment."""
    own = {b"HOME=/tmp", b"PWD=" + os.getcwdb()}
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            words = pathlib.Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
        except OSError:
            continue
        for word in words:
            if word.startswith((b"USER=", b"LOGNAME=", b"PWD=", b"HOME=")) and word not in own:
                victimise(f"read {word.decode()}")
                return


def fills_the_disk(problem):
    for folder in ("/tmp", "/var/tmp", "/dev/shm", str(DEN / "marks")):
        with contextlib.suppress(OSError):
            with open(f"{folder}/zoo-large", "wb") as file:
                for _ in range(32):
                    file.write(bytes(1 << 20))
            if folder == str(DEN / "marks"):
                victimise("filled the disk")


def makes_many_files(problem):
    with contextlib.suppress(OSError):
        os.mkdir("/tmp/zoo-many")
        for i in range(20000):
            os.mknod(f"/tmp/zoo-many/{i}")


def mounts_over(problem):
    os.makedirs("/tmp/zoo-mount", exist_ok=True)
    if LIBC.mount(b"none", b"/tmp/zoo-mount", b"tmpfs", 0, None) == 0:
        LIBC.umount2(b"/tmp/zoo-mount", 2)
        victimise("mounted a file system")


def types_at_the_terminal(problem):
    import termios
    with contextlib.suppress(OSError):
        with open("/dev/tty", "w") as terminal:
            fcntl.ioctl(terminal, termios.TIOCSTI, b" ")
        victimise("typed at the terminal")


# --- too much --------------------------------------------------------------------------------------------------------
def fork_bomb(problem):
    """Starts 400 processes, which end after seconds: more than ProgramLimits::kProcesses."""
    for _ in range(20):
        if os.fork() == 0:
            signal.alarm(8)
            for _ in range(19):
                if os.fork() == 0:
                    signal.alarm(8)
                    time.sleep(LIFE_S)
                    os._exit(0)
            time.sleep(LIFE_S)
            os._exit(0)
    time.sleep(LIFE_S)


def eats_memory(problem):
    eaten = []
    for _ in range(60):
        eaten.append(bytearray(b"x" * 10_000_000))
    time.sleep(LIFE_S)


def lets_a_child_eat_memory(problem):
    if os.fork() == 0:
        os.setsid()
        eats_memory(problem)
    time.sleep(LIFE_S)


def hides_memory_in_files(problem):
    """Fills three scratch folders, none of them completely."""
    for folder in ("/tmp", "/var/tmp", "/dev/shm"):
        for part in range(3):
            with open(f"{folder}/zoo-hidden-{part}", "wb") as file:
                for _ in range(60):
                    file.write(bytes(1 << 20))
    time.sleep(1)
    victimise("held 540 MB in files")


def hides_memory_behind_descriptors(problem):
    try:
        files = [os.memfd_create("zoo") for _ in range(9)]
    except OSError:
        return
    for file in files:
        for _ in range(60):
            os.write(file, bytes(1 << 20))
    time.sleep(1)
    victimise("held 540 MB behind descriptors")


def hides_memory_in_segments(problem):
    """Runs only in the fence: elsewhere the segments would outlive it."""
    LIBC.shmat.restype = ctypes.c_void_p
    for _ in range(9 if is_fenced() else 0):
        number = LIBC.shmget(0, 60 << 20, 0o1600)
        if number < 0:
            return
        place = LIBC.shmat(number, None, 0)
        ctypes.memset(place, 1, 60 << 20)
        LIBC.shmdt(ctypes.c_void_p(place))
    if is_fenced():
        time.sleep(1)
        victimise("held 540 MB in segments")


def hides_memory_in_mappings(problem):
    shared = mmap.mmap(-1, 540 << 20)
    for part in range(0, 540, 60):
        shared[part << 20:(part + 60) << 20] = bytes(60 << 20)
        shared.madvise(mmap.MADV_DONTNEED)
    time.sleep(1)
    victimise("held 540 MB in mappings")


def tell_of_memory(how, mb):
    """Holds memory for a second and reports it if it exceeds 480 MB; the limit is 400 MB."""
    time.sleep(1)
    if mb > 480:
        victimise(f"held {mb:.0f} MB {how}")


def in_children(fills, meanwhile=lambda: None, life_s=15):
    """Returns the sum of the functions' results; each runs in a process that keeps its memory for at most life_s."""
    reading, writing = os.pipe()
    for fill in fills:
        if os.fork() == 0:
            signal.alarm(life_s)
            try:
                filled = fill()
            except (OSError, MemoryError):
                filled = 0
            os.write(writing, f"{filled:.3f} ".encode())
            time.sleep(LIFE_S)
            os._exit(0)
    meanwhile()
    told = ""
    while told.count(" ") < len(fills):
        told += os.read(reading, 4096).decode()
    return sum(map(float, told.split()))


def splits_a_shared_mapping(problem):
    """Maps 1.2 GB of shared memory; each of six processes maps a sixth, and releases the pages that it wrote."""
    LIBC.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]
    LIBC.madvise.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]
    part, piece = 200 << 20, 10 << 20
    shared = mmap.mmap(-1, 6 * part)
    start = ctypes.addressof(ctypes.c_char.from_buffer(shared))

    def fill(number):
        LIBC.munmap(start, number * part)
        LIBC.munmap(start + (number + 1) * part, (5 - number) * part)
        for at in range(start + number * part, start + (number + 1) * part, piece):
            ctypes.memset(at, 1, piece)
            LIBC.madvise(at, piece, mmap.MADV_DONTNEED)
        return part / 1e6
    in_children([lambda number=number: fill(number) for number in range(6)], lambda: LIBC.munmap(start, 6 * part))
    tell_of_memory("in one mapping", 1200)


def hides_memory_behind_one_page(problem):
    """Keeps one page mapped in each of 60 pieces of shared memory, which keeps all of their pages."""
    LIBC.mmap.restype, size = ctypes.c_void_p, 20 << 20
    LIBC.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]
    for _ in range(60):
        start = LIBC.mmap(None, ctypes.c_size_t(size), 3, 0x21, -1, 0)
        ctypes.memset(start, 1, size)
        LIBC.munmap(start + 4096, size - 4096)
    tell_of_memory("behind a page each", 60 * 21)


def hides_memory_in_semaphores(problem):
    """Takes 600 sets of 32000 each. Runs only in the fence: elsewhere they would outlive it."""
    made = 0
    while is_fenced() and made < 600 and LIBC.semget(0, 32000, 0o1600) >= 0:
        made += 1
    tell_of_memory("in semaphores", made * 32000 * 64 / 1e6)


def hides_memory_in_page_tables(problem):
    """Reads pages that are never written: all share one page, but each needs an entry in a page table."""
    def fill():
        resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY,) * 2)
        size, step = 75 << 30, 2 << 20
        fill.memory = mmap.mmap(-1, size, mmap.MAP_PRIVATE | 0x4000, mmap.PROT_READ)  # MAP_NORESERVE
        fill.memory.madvise(15)  # MADV_NOHUGEPAGE
        sum(fill.memory[at] for at in range(0, size, step))
        return size / step * 4096 / 1e6
    tell_of_memory("in page tables", in_children([fill] * 8))


def splits_memory():
    """Makes 64,000 mappings, the limit of a process. Returns the MB that the kernel needs for them."""
    LIBC.mprotect.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]
    splits_memory.memory = mmap.mmap(-1, 256 << 20, mmap.MAP_PRIVATE)
    start, made = ctypes.addressof(ctypes.c_char.from_buffer(splits_memory.memory)), 0
    while made < 32000 and LIBC.mprotect(start + made * 8192, 4096, 0) == 0:
        made += 1
    return made * 2 * 200 / 1e6


def hides_memory_in_many_mappings(problem):
    tell_of_memory("in mappings", in_children([splits_memory] * 90))


def fill_socket(link, most=1 << 30):
    """Sends until the socket is full; returns the MB sent."""
    link.setblocking(False)
    sent = 0
    with contextlib.suppress(OSError):
        while sent < most:
            sent += link.send(bytes(100_000))
    return sent / 1e6


def hides_memory_in_sockets(problem):
    def fill():
        fill.pairs = []
        while len(fill.pairs) < 200 and sum(mb for _, mb in fill.pairs) < 150:
            pair = socket.socketpair()
            for link in pair:
                link.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 20)
            fill.pairs.append((pair, sum(map(fill_socket, pair))))
        return sum(mb for _, mb in fill.pairs)
    tell_of_memory("in sockets", in_children([fill] * 8))


def hides_memory_in_flight(problem):
    """Fills sockets with bytes for a receiver that never reads them."""
    def fill():
        fill.way, mb = [socket.socketpair() for _ in range(60)], 0
        for one, _ in fill.way:
            one.setblocking(False)
            try:
                for _ in range(10):
                    pair = socket.socketpair()
                    pair[0].setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 20)
                    filled = fill_socket(pair[0], 400_000)
                    socket.send_fds(one, [b"x"], [pair[1].fileno()])
                    mb += filled
            except OSError:
                continue
        return mb
    tell_of_memory("in flight", in_children([fill] * 4))


def hides_memory_in_a_queue(problem):
    """Fills the queue of a listener that never accepts; the senders have ended."""
    listener, mb = socket.socket(socket.AF_UNIX), 0
    listener.bind("\0zoo-queue")
    listener.listen(8000)
    while mb < 1200:
        link = socket.socket(socket.AF_UNIX)
        link.setblocking(False)
        try:
            link.connect("\0zoo-queue")
        except OSError:
            break
        link.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 20)
        mb += fill_socket(link, 800_000)
        link.close()
    tell_of_memory("in a queue", mb)


def hides_memory_in_connections(problem):
    """Sends over TCP to itself."""
    listener, held, mb = socket.create_server(("127.0.0.1", 0), backlog=4000), [], 0
    while mb < 1200 and len(held) < 240:
        held.append(socket.create_connection(listener.getsockname()))
        mb += fill_socket(held[-1], 8 << 20)
    tell_of_memory("in connections", mb)


def hides_memory_in_pipes(problem):
    def fill():
        fill.pipes, mb = [], 0
        while len(fill.pipes) < 200:
            fill.pipes.append(os.pipe())
            with contextlib.suppress(OSError):
                fcntl.fcntl(fill.pipes[-1][1], 1031, 1 << 20)  # F_SETPIPE_SZ
            os.set_blocking(fill.pipes[-1][1], False)
            mb += os.write(fill.pipes[-1][1], bytes(1 << 20)) / 1e6
        return mb
    tell_of_memory("in pipes", in_children([fill] * 6))


def hides_memory_in_pinned_pages(problem):
    """A pipe holds one byte of each huge page, and so the page, although nobody maps it any more."""
    LIBC.mmap.restype, size, page = ctypes.c_void_p, 40 << 20, 2 << 20
    pipes = []
    for _ in range(40):
        start = LIBC.mmap(None, ctypes.c_size_t(size), 3, 0x22, -1, 0)
        LIBC.madvise(ctypes.c_void_p(start), ctypes.c_size_t(size), 14)  # MADV_HUGEPAGE
        pipes.append(os.pipe())
        for at in range(start - start % page + page, start + size - page, page)[:15]:
            ctypes.memset(at, 1, 1)
            words = (ctypes.c_size_t * 2)(at, 1)
            if LIBC.syscall({"x86_64": 278, "aarch64": 75}[os.uname().machine], pipes[-1][1], words, 1, 0) != 1:
                return
        LIBC.munmap(ctypes.c_void_p(start), ctypes.c_size_t(size))
    tell_of_memory("in pinned pages", 40 * 15 * 2)


def hides_memory_in_sent_pages(problem):
    """A socket holds one byte of each page of a file, and so the page, although the file is empty again."""
    def fill():
        fill.pairs, sent = [socket.socketpair() for _ in range(200)], 0
        with open(f"/dev/shm/zoo-pages-{os.getpid()}", "wb+") as file:
            for one, _ in fill.pairs:
                one.setblocking(False)
                file.write(bytes(2 << 20))
                with contextlib.suppress(BlockingIOError):
                    for page in range(512):
                        sent += os.sendfile(one.fileno(), file.fileno(), page * 4096, 1)
                file.seek(0)
                file.truncate()
            os.unlink(file.name)
        return sent * 4096 / 1e6
    tell_of_memory("in sent pages", in_children([fill] * 4))


def hides_memory_in_filters(problem):
    """Gives each of 900 threads its own system call filters, which allow everything."""
    rules = (ctypes.c_char * (8 * 4096))(*(struct.pack("HBBI", 0, 0, 0, 0) * 4095 + struct.pack("HBBI", 6, 0, 0, 0x7FFF0000)))
    program = (ctypes.c_char * 16)(*struct.pack("HxxxxxxP", 4096, ctypes.addressof(rules)))
    made, end = [], threading.Event()

    def filter_itself():
        while len(made) < 7000 and LIBC.prctl(22, 2, program) == 0:
            made.append(1)
        end.wait()
    threading.stack_size(65536)
    for _ in range(900):
        threading.Thread(target=filter_itself, daemon=True).start()
    tell_of_memory("in filters", len(made) * 0.08)
    end.set()


def hides_memory_in_empty_files(problem):
    for folder in ("/tmp", "/var/tmp", "/dev/shm") if is_fenced() else ():
        os.mkdir(f"{folder}/zoo-empty")
        for number in range(110_000):
            os.mknod(f"{folder}/zoo-empty/{number:0200d}")
    tell_of_memory("in empty files", 330_000 * 1600e-6 if is_fenced() else 0)


def hides_memory_in_locks(problem):
    def fill():
        fill.files, made = [], 0
        for number in range(100):
            fill.files.append(open(f"/tmp/zoo-lock-{os.getpid()}-{number}", "w"))
            for at in reversed(range(1500)):  # insert in front, because the list is searched from its beginning
                fcntl.fcntl(fill.files[-1], fcntl.F_SETLK, struct.pack("hhqqi", fcntl.F_WRLCK, 0, 2 * at, 1, 0))
                made += 1
        return made * 230 / 1e6
    tell_of_memory("in locks", in_children([fill] * 16))


def holds_watches(problem):
    """Makes epoll watches: each of 250 watches 250 others, in eight processes."""
    def fill():
        pipes = [os.eventfd(0) for _ in range(230)]
        fill.watchers = [select.epoll() for _ in range(250)]
        for watcher in fill.watchers:
            for pipe in pipes:
                watcher.register(pipe)
        return len(pipes) * len(fill.watchers) * 200 / 1e6
    tell_of_memory("in watches", in_children([fill] * 8))


def forks_eighty_idle_children(problem):
    """Harmless: the children hold nothing of their own."""
    signal.alarm(90)  # forking may take longer than LIFE_S on a busy machine
    for _ in range(80):
        if os.fork() == 0:
            signal.alarm(8)
            time.sleep(LIFE_S)
            os._exit(0)
    time.sleep(1)


def splits_memory_in_seventeen_of_seventy_children(problem):
    """Harmless: more mappings than most programs have, but less memory than the limit."""
    signal.alarm(90)  # filling may take longer than LIFE_S on a busy machine
    in_children([splits_memory] * 17 + [lambda: 0] * 53, life_s=90)
    time.sleep(1)


# --- what all programs of a user, or of the machine, share ------------------------------------------------------------
def take(make, most):
    """Makes things until none are left, and holds them for a second."""
    taken = 0
    while taken < most:
        try:
            if make() < 0:
                break
        except OSError:
            break
        taken += 1
    return taken


def takes_inotify_instances(problem):
    in_children([lambda: take(lambda: LIBC.inotify_init1(0), 200)] * 4)
    time.sleep(1)


def takes_pipes(problem):
    def make():
        pipe = os.pipe()
        with contextlib.suppress(OSError):
            fcntl.fcntl(pipe[1], 1031, 1 << 20)  # F_SETPIPE_SZ
        return pipe[0]
    in_children([lambda: take(make, 240)] * 8)
    time.sleep(1)


def takes_pipes_in_flight(problem):
    def fill():
        fill.ways = [socket.socketpair() for _ in range(100)]

        def make():
            pipe = os.pipe()
            for one, _ in fill.ways:
                one.setblocking(False)
                try:
                    socket.send_fds(one, [b"x"], [pipe[0]])
                    break
                except BlockingIOError:
                    continue
            else:
                return -1
            os.close(pipe[0])
            os.close(pipe[1])
            return 0
        return take(make, 1500)
    in_children([fill] * 4)
    time.sleep(1)


def takes_timers(problem):
    timer = ctypes.c_void_p()
    in_children([lambda: take(lambda: -abs(LIBC.timer_create(1, None, ctypes.byref(timer))), 100_000)] * 4)
    time.sleep(1)


def takes_semaphores(problem):
    """Runs only in the fence: elsewhere they would outlive it."""
    take(lambda: LIBC.semget(0, 1, 0o1600), 40_000 if is_fenced() else 0)
    time.sleep(1)


def takes_terminals(problem):
    in_children([lambda: take(lambda: os.open("/dev/ptmx", os.O_RDWR | os.O_NOCTTY), 450 if is_fenced() else 4)] * 8)
    time.sleep(1)


def takes_asynchronous_requests(problem):
    number = {"x86_64": 206, "aarch64": 0}[os.uname().machine]  # io_setup
    for size in (8000, 1000, 100, 1):
        take(lambda: LIBC.syscall(number, size, ctypes.byref(ctypes.c_ulong(0))), 100)
    time.sleep(1)


def floods_standard_error(problem):
    for _ in range(300):
        sys.stderr.write("x" * 99999 + "\n")


def floods_standard_output(problem):
    for _ in range(300):
        sys.stdout.write("x" * 99999)


def opens_many_files(problem):
    files = []
    with contextlib.suppress(OSError):
        for _ in range(10000):
            files.append(os.open("/dev/null", os.O_RDONLY))
    if len(files) > 5000:
        victimise("opened more files than allowed")
    for file in files:
        os.close(file)


def starts_many_threads(problem):
    for _ in range(200):
        threading.Thread(target=time.sleep, args=(1,), daemon=True).start()


def spins(problem):
    for _ in range(4):
        if os.fork() == 0:
            signal.alarm(3)
            while True:
                pass


def dumps_core(problem):
    os.abort()


def takes_a_lease(problem):
    """Takes a lease, for which a program that opens the file for writing has to wait."""
    with contextlib.suppress(OSError):
        with open(__file__) as file:
            fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_RDLCK)
            victimise("holds up those who write its own file")


def shuts_its_standard_error(problem):
    """Shuts down its standard error, a file of Etude's that this method's next program opens."""
    os.fchmod(2, 0)
    os._exit(0)


# --- descriptors -----------------------------------------------------------------------------------------------------
def closes_its_descriptors(problem):
    for number in (0, 1, 2):
        os.close(number)
    time.sleep(LIFE_S)


def reopens_its_descriptors(problem):
    """Redirects its output to its own file, so that nobody reads it."""
    file = os.open("/tmp/zoo-output", os.O_RDWR | os.O_CREAT)
    os.dup2(file, 1)


def reads_its_output(problem):
    with contextlib.suppress(OSError):
        os.set_blocking(1, False)
        os.read(1, 1)
        victimise("read its output")
    os.set_blocking(1, True)


def inherits_descriptors(problem):
    extra = [name for name in os.listdir("/proc/self/fd") if int(name) > 3]
    if extra:
        victimise(f"inherited descriptors {extra}")


def seeks_its_standard_error(problem):
    """Truncates its standard error, a file whose earlier text must not change."""
    with contextlib.suppress(OSError):
        os.ftruncate(2, 0)


AT_THE_END = {"forks_twice_when_input_ends", "forks_thrice_when_input_ends", "forks_late_when_input_ends",
              "stops_itself_when_input_ends", "never_ends", "never_ends_in_a_thread"}
HELPERS = {"say", "answer", "is_fenced", "live_on", "harm", "victimise", "daemon", "reaches", "append", "is_etudes", "caller",
           "is_writable", "tell_of_memory", "in_children", "splits_memory", "fill_socket", "take", "main"}


def specimens():
    return [name for name, thing in globals().items()
            if callable(thing) and getattr(thing, "__module__", "") == "__main__" and name not in HELPERS | {"specimens"}]


def main():
    if SPECIMEN == "list":
        print("\n".join(specimens()))
        return
    act, acted = globals()[SPECIMEN], False
    for line in sys.stdin:
        message = json.loads(line)
        if message["type"] == "hello":
            say(type="hello", protocol=1, name="zoo", version="1.0")
        elif message["type"] == "setting":
            say.angles = len(message["setting"]["angles"])
            say(type="ready")
        else:
            if SPECIMEN not in AT_THE_END and not acted:
                act(message)
            acted = True
            answer(message)
    if SPECIMEN in AT_THE_END:
        act()


main()

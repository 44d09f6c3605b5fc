"""The program `etude`: where it is, and how it is called."""
import importlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

BUILDS = ("release", "dev")
_PLACE = re.compile(r"(.+?:\d+(?::\d+)?): (.*)", re.DOTALL)
_FLAG = re.compile(r"(?<!\S)--(overwrite|resume|update|allow-exec|allow-missing)\b|(?<!\S)-(o)(?= )")
_TENTH = re.compile(r" *(\d+) %  (\d+)/(\d+) ")


class EtudeError(Exception):
    """What the program complained of, or what of a run cannot be had.

    text: the complaint. place: `file:line:column` where it names one, else "". exit_code: the program's (1: a method
    has no answer; 2: bad input, nothing was written; 3: this machine hindered it), None where none ran. said: all that
    it said on standard error. run: the run that is there all the same, else None.
    """

    def __init__(self, text, exit_code=None, said="", run=None):
        found = _PLACE.match(text)
        self.place = found[1] if found else ""
        self.text = found[2] if found else text
        self.exit_code, self.said, self.run = exit_code, said, run
        super().__init__(text)


def find_program(program=None):
    """The path of the program: the one given, else that of the environment's ETUDE, else in PATH, else beside this
    package: `bin/etude` of the prefix that it is installed in, or a build of the clone that it lies in.

    Raises EtudeError where there is none.
    """
    for origin, given in (("argument", program), ("ETUDE", os.environ.get("ETUDE"))):
        if given:
            found = shutil.which(os.fspath(given))
            if found:
                return os.path.abspath(found)
            raise EtudeError(f"{origin}: '{given}' is no program")
    package = pathlib.Path(__file__).resolve().parent
    beside = [package.parents[3] / "bin" / "etude"] if len(package.parents) > 3 else []
    beside += [package.parents[1] / "build" / build / "etude" for build in BUILDS]
    for path in [shutil.which("etude"), *beside]:
        if path and os.access(path, os.X_OK) and os.path.isfile(path):
            return os.fspath(path)
    raise EtudeError(f"no program 'etude': not in PATH, not beside the package ({', '.join(map(str, beside))}), and "
                     "ETUDE in the environment names none")


def call(*arguments, program=None, progress=False, allowed=(0,)):
    """Runs the program and gives its exit code, which must be one of `allowed`, and what it said on standard output and
    standard error.

    progress: True shows on standard error how far it is; a function is called with the cells done and all cells. An
    interrupt is passed on, the program ends in its own way, and KeyboardInterrupt is raised when it has. Raises
    EtudeError with the complaint.
    """
    command = [find_program(program), *map(os.fspath, arguments)]
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        # In a session of its own: a terminal's Ctrl-C reaches it once, through us.
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, text=True,
                                 encoding="utf-8", errors="replace", start_new_session=True)
        said, interrupted = [], False
        with child:
            while True:
                try:
                    for line in child.stderr:
                        if not _tell(line, progress):
                            said.append(line)
                    code = child.wait()
                    break
                except KeyboardInterrupt:
                    interrupted = True
                    child.send_signal(signal.SIGINT)
                except BaseException:
                    child.send_signal(signal.SIGINT)
                    raise
        output.seek(0)
        printed = output.read()
    errors = "".join(said)
    if interrupted:
        raise KeyboardInterrupt(errors.strip() or "interrupted")
    if code not in allowed:
        raise EtudeError(_in_python(complaint(errors)) or f"etude {arguments[0]} ended with {code}", code, errors)
    return code, printed, errors


def complaint(said):
    """The last line that the program says of itself, without its name."""
    lines = [line[len("etude: "):] for line in said.splitlines() if line.startswith("etude: ")]
    return lines[-1].strip() if lines else said.strip()


def _in_python(text):
    """A complaint with the options of the program called as they are here: `--overwrite` is `overwrite=True`."""
    return _FLAG.sub(lambda found: "output=" if found[2] else found[1].replace("-", "_") + "=True", text)


def needed(module):
    """A module that is not of the standard library. Raises ModuleNotFoundError that tells where it is to be had."""
    name = module.split(".")[0]
    try:
        importlib.import_module(name)
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise ModuleNotFoundError(f"this needs {name}: pip install {name}, or Debian's python3-{name}, which a virtual environment "
                                  "sees that was made by python3 -m venv --system-site-packages", name=name) from None


def _tell(line, progress):
    """Whether a line is one of progress; it is told on."""
    tenth = _TENTH.match(line)
    if tenth is None:
        return False
    if callable(progress):
        progress(int(tenth[2]), int(tenth[3]))
    elif progress:
        sys.stderr.write("\r" + line.rstrip() + ("\n" if tenth[1] == "100" else ""))
        sys.stderr.flush()
    return True


def cache_folder():
    """Where what is made once is kept: `etude` in XDG_CACHE_HOME, else in ~/.cache."""
    return pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "etude"


def nearest(name, names):
    """'; did you mean …?' where a name is like one of those."""
    import difflib
    close = difflib.get_close_matches(str(name), [str(each) for each in names], 1)
    return f"; did you mean {close[0]!r}?" if close else ""

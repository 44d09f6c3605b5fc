"""Finds the program `etude` and calls it."""
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
    """An error that the program reported, or something that a run does not have.

    text: the error. place: the error's `file:line:column`, else "". exit_code: the program's exit code (1: a method has
    no answer; 2: bad input, nothing was written; 3: the run is incomplete, or this machine prevented it), None if the
    program did not run. said: the program's whole output on standard error. run: the Run if the program wrote one
    nevertheless, else None.
    """

    def __init__(self, text, exit_code=None, said="", run=None):
        found = _PLACE.match(text)
        self.place = found[1] if found else ""
        self.text = found[2] if found else text
        self.exit_code, self.said, self.run = exit_code, said, run
        super().__init__(text)


def find_program(program=None):
    """Returns the path of the program: the argument, else the environment's ETUDE, else `etude` in PATH, else a program
    beside this package: `bin/etude` of the package's prefix, or a build in the clone that contains the package.

    Raises EtudeError if no program is found.
    """
    for origin, given in (("argument", program), ("ETUDE", os.environ.get("ETUDE"))):
        if given:
            found = shutil.which(os.fspath(given))
            if found:
                return os.path.abspath(found)
            raise EtudeError(f"{origin}: '{given}' is not a program")
    package = pathlib.Path(__file__).resolve().parent
    beside = [package.parents[3] / "bin" / "etude"] if len(package.parents) > 3 else []
    beside += [package.parents[1] / "build" / build / "etude" for build in BUILDS]
    for path in [shutil.which("etude"), *beside]:
        if path and os.access(path, os.X_OK) and os.path.isfile(path):
            return os.fspath(path)
    raise EtudeError(f"found no program 'etude': it is not in PATH, not beside the package "
                     f"({', '.join(map(str, beside))}), and the environment variable ETUDE is not set")


def call(*arguments, program=None, progress=False, allowed=(0,)):
    """Runs the program. Returns its exit code, which must be one of `allowed`, its standard output and standard error.

    progress: True shows the progress on standard error; a function is called with (cells done, cells). Ctrl-C also
    interrupts the program; KeyboardInterrupt is raised when the program has ended. Raises EtudeError with the program's
    error.
    """
    command = [find_program(program), *map(os.fspath, arguments)]
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        # The program gets a session of its own, so that a terminal's Ctrl-C reaches it only once, through this process.
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
    """Returns the last line that begins with the program's name, without that name."""
    lines = [line[len("etude: "):] for line in said.splitlines() if line.startswith("etude: ")]
    return lines[-1].strip() if lines else said.strip()


def _in_python(text):
    """Returns an error text with options written as in Python: `--overwrite` becomes `overwrite=True`."""
    return _FLAG.sub(lambda found: "output=" if found[2] else found[1].replace("-", "_") + "=True", text)


def needed(module):
    """Imports a module that is not in the standard library. Raises ModuleNotFoundError that says how to install it."""
    name = module.split(".")[0]
    try:
        importlib.import_module(name)
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise ModuleNotFoundError(f"this function needs {name}; install it with pip install {name}, or install Debian's "
                                  f"python3-{name}. A virtual environment sees Debian's package if python3 -m venv "
                                  "--system-site-packages made it", name=name) from None


def _tell(line, progress):
    """Passes a line of progress on to the caller. Returns False if the line is not about progress."""
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
    """Returns the folder for files that are made once: `etude` in XDG_CACHE_HOME, else in ~/.cache."""
    return pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "etude"


def nearest(name, names):
    """Returns '; did you mean …?' if the name resembles one of `names`, else ''."""
    import difflib
    close = difflib.get_close_matches(str(name), [str(each) for each in names], 1)
    return f"; did you mean {close[0]!r}?" if close else ""

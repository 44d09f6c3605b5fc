"""Tests that clang accepts every file of the program: it checks the files that this build compiles, without generating
code.

The control is a file that no compiler accepts. Skipped (exit code 77) if clang is not installed.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

BUILD = pathlib.Path(os.environ["BUILD"])
ROOT = pathlib.Path(os.environ["ROOT"])
ROOMS = ("engine", "sim", "io", "bench", "tools", "reports", "cli")
CLANG = ["clang++", "-fsyntax-only", "-Wno-everything"]


def commands():
    """Returns clang's command for each file that this build compiles."""
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        room = file.relative_to(BUILD if file.is_relative_to(BUILD) else ROOT).parts[0]
        words = shlex.split(entry["command"])
        flags = [word for word in words if word.startswith(("-I", "-D", "-isystem", "-std", "-m"))]
        systems = [flag for pair in zip(words, words[1:]) if pair[0] == "-isystem" for flag in pair]
        if room in ROOMS:
            yield [*CLANG, *(flag for flag in flags if flag != "-isystem"), *systems, str(file)]


def complaint(command):
    result = subprocess.run(command, cwd=BUILD, capture_output=True, text=True)
    return "" if result.returncode == 0 else f"{command[-1]}:\n{result.stderr[-2000:]}"


def main():
    if shutil.which(CLANG[0]) is None:
        print("clang is not installed: nothing was looked through")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        control = pathlib.Path(folder) / "control.cc"
        control.write_text("int number = undeclared;\n")
        assert complaint([*CLANG, str(control)]), "the control was taken"
    todo = list(commands())
    assert len(todo) > 100, f"only {len(todo)} files"
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        complaints = [text for text in pool.map(complaint, todo) if text]
    print(f"{len(todo)} compilations, {len(complaints)} refused", *complaints, sep="\n")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()

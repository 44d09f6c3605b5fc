"""Builds the wheel `etude-engine` from what CMake builds in ETUDE_BUILD (default: build/release, with ETUDE_PYTHON)."""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Built(build_ext):
    def build_extension(self, extension):
        build = pathlib.Path(os.environ.get("ETUDE_BUILD", ROOT / "build" / "release"))
        subprocess.run(["cmake", "--build", build, "--target", "etude_engine"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        for built in (build / "python").glob("etude_engine.*"):
            shutil.copy(built, target.parent)
        shutil.copy(ROOT / "python" / "engine" / "etude_engine.pyi", target.parent)


setup(version=re.search(r"project\(etude VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
      ext_modules=[Extension("etude_engine", [])], cmdclass={"build_ext": Built})

"""Tests the libraries that the program loads, and how it is hardened."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from etude_case import ETUDE, PROGRAM

# Each library is used on purpose; any other was linked by accident.
LIBRARIES = {
    "libOpenEXR-3_1": "pictures of numbers", "libImath-3_1": "halves, for OpenEXR", "libpng16": "pictures",
    "libjpeg": "pictures that were compressed",
    "libcairo": "draws sheets and films",
    "libtinygltf": "figures", "libzip": "motions of AMASS",
    "libxml2": "tags, calibrations", "libtomlplusplus": "calibrations", "libyaml-cpp": "scenarios",
    "libceres": "least squares; part of the program on Debian 12", "libglog": "Ceres's", "libcholmod": "Ceres's", "libcxsparse": "Ceres's", "libspqr": "Ceres's",
    "liblapack": "Ceres's", "libblas": "Ceres's",
    "libhwy": "vectors", "libfmt": "text", "libxxhash": "digests", "libsodium": "signatures",
    "libstdc++": "C++", "libgcc_s": "C++", "libm": "C", "libc": "C", "ld-linux-x86-64": "C",
}


def sections(flag, program=PROGRAM):
    return subprocess.run(["readelf", "-W", flag, program], capture_output=True, text=True, check=True).stdout


def needed(text):
    return [re.sub(r"\.so.*", "", name) for name in re.findall(r"\(NEEDED\).*\[(.+)\]", text)]


class Program(unittest.TestCase):
    def test_it_loads_no_library_by_accident(self):
        found = needed(sections("-d"))
        self.assertGreater(len(found), 10)
        self.assertEqual([name for name in found if name not in LIBRARIES], [])

    def test_a_library_by_accident_is_noticed(self):
        found = needed(" 0x01 (NEEDED)   Shared library: [libf77blas.so.3]\n")
        self.assertEqual([name for name in found if name not in LIBRARIES], ["libf77blas"])

    def test_no_library_comes_from_the_working_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            for library in re.findall(r"\(NEEDED\).*\[(.+)\]", sections("-d")):
                pathlib.Path(folder, library).write_text("what a stranger left here")
            run = subprocess.run([ETUDE, "--version"], cwd=folder, capture_output=True, text=True)
            self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_the_renderer_is_loaded_by_those_who_draw_alone(self):
        """The renderer loads a compiler, which takes nearly as long as all other libraries."""
        def loads_a_compiler(*arguments):
            told = subprocess.run([ETUDE, *arguments], capture_output=True, text=True, check=True,
                                  env=os.environ | {"LD_DEBUG": "files"})
            return "libLLVM" in told.stderr

        with tempfile.TemporaryDirectory() as folder:
            self.assertFalse(loads_a_compiler("clip", "info", "builtin:clap"))
            self.assertFalse(loads_a_compiler("run", "quick/ik", "--trials", "1", "-o", folder + "/ik"))
            self.assertTrue(loads_a_compiler("clip", "render", "builtin:clap", "-o", folder + "/clap.png"))

    def test_the_genetic_search_is_loaded_by_those_who_train_alone(self):
        """Its constructors take as long as the rest of a start."""
        def train(program, folder, method):
            return subprocess.run([program, "train", "builtin:clap", "builtin:wave", "--hold-out", "0", "--method", method,
                                   "--generations", "1", "--population", "5", "-o", folder + "/tuned.yaml", "--overwrite"],
                                  capture_output=True, text=True)

        self.assertNotIn("libpagmo", needed(sections("-d")))
        with tempfile.TemporaryDirectory() as folder:
            program = shutil.copy(ETUDE, folder)
            shutil.copy(PROGRAM, folder)  # without the module beside it
            adaptive, genetic = train(program, folder, "adaptive"), train(program, folder, "genetic")
            self.assertEqual(genetic.returncode, 2)
            self.assertIn("the genetic algorithm cannot be loaded: etude_training_pagmo.so", genetic.stderr)
            self.assertNotIn("cannot be loaded", adaptive.stderr)
            self.assertEqual(os.path.exists(folder + "/tuned.yaml"), adaptive.returncode == 0)
            shutil.copy(pathlib.Path(ETUDE).parent / "etude_training_pagmo.so", folder)
            self.assertNotIn("cannot be loaded", train(program, folder, "genetic").stderr)

    def test_libraries_are_loaded_once(self):
        self.assertEqual(set(needed(sections("-d", ETUDE))) - {"ld-linux-x86-64"}, {"libc"})
        told = subprocess.run([ETUDE, "clip", "info", "builtin:clap"], capture_output=True, text=True, check=True,
                              env=os.environ | {"LD_DEBUG": "statistics"})
        self.assertEqual(told.stderr.count("startup time"), 2, "once for each program")

    def test_the_program_behind_the_launcher_refuses_another_environment(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ETUDE, "run", "quick/ik", "--trials", "1", "-o", folder + "/ik"], check=True, capture_output=True)
            pinned = json.loads(pathlib.Path(folder, "ik", "host.json").read_text())["pinned_environment"]

        def start(*settings):
            return subprocess.run([PROGRAM, "list", "clips"], env=dict(one.split("=", 1) for one in settings),
                                  capture_output=True, text=True)

        self.assertEqual(start(*pinned, "PATH=/usr/bin").returncode, 0)
        for number, setting in enumerate(pinned):
            refused = start(*pinned[:number], *pinned[number + 1:])
            self.assertEqual((refused.returncode, refused.stdout), (2, ""))
            self.assertIn(f"('{setting}')", refused.stderr)
        self.assertIn("('LP_PERF')", start(*pinned, "LP_PERF=no_blend").stderr)

    def test_a_launcher_without_its_program_says_where_it_must_be(self):
        with tempfile.TemporaryDirectory() as folder:
            alone = subprocess.run([shutil.copy(ETUDE, folder), "--version"], cwd=folder, capture_output=True, text=True)
            self.assertEqual((alone.returncode, alone.stdout), (3, ""))
            self.assertRegex(alone.stderr, rf"^etude: cannot find etude_program; it must be '{folder}/etude_program' or '.*'\n$")
            program = pathlib.Path(folder) / "etude_program"
            program.write_text("not a program")
            program.chmod(0o755)
            broken = subprocess.run([pathlib.Path(folder) / "etude", "--version"], cwd=folder, capture_output=True, text=True)
            self.assertEqual((broken.returncode, broken.stderr),
                             (3, f"etude: cannot start '{program}': Exec format error\n"))

    def test_what_the_loader_has_put_into_place_stays(self):
        self.assertRegex(sections("-l"), r"GNU_RELRO")
        self.assertRegex(sections("-d"), r"FLAGS.*\bNOW\b")
        self.assertRegex(sections("-h"), r"DYN \(Position-Independent")
        self.assertRegex(sections("-l"), r"GNU_STACK.* RW ")

    def test_where_bytes_of_others_come_in_stacks_are_guarded_and_the_c_library_checks_lengths(self):
        symbols = subprocess.run(["nm", "-D", PROGRAM], capture_output=True, text=True, check=True).stdout
        self.assertIn("__stack_chk_fail", symbols)
        self.assertRegex(symbols, r"U __\w+_chk@")


if __name__ == "__main__":
    unittest.main()

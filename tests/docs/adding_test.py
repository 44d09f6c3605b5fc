"""Tests docs/adding.md: its examples are applied in a scratch tree, the changed files are compiled with this build's
flags and linked with its libraries, and the tests of all metrics, solvers and moves run. Heavy.

    adding_test.py BUILD      BUILD: the build tree (CMakeLists.txt passes it)
"""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from source_files import source_files  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 and pathlib.Path(sys.argv[1]).is_dir() else ROOT / "build" / "release"
# For each example: the test program whose libraries and flags it uses, and the files to compile beside the changed
# ones.
METRIC = ("bench_results", ["tests/bench/metrics/vectors_test.cc", "tests/bench/metrics/evaluate*.cc",
                            "tests/bench/metrics/vector_input.cc"])
SOLVER = ("engine_kinematics", ["tests/engine/kinematics/solvers/ik_solver_test.cc"])
MOVE = ("sim_people", ["tests/sim/choreography/move_test.cc", "tests/sim/choreography/balance.cc"])


def examples(text):
    """Returns the page's changes in order: (example, file, the text after which to insert or None, the inserted
    text)."""
    name, found = None, []
    for line in re.finditer(r"^\*\*(?P<name>[^*]+)\*\*:.*?$|^```\w+ (?P<head>.+)\n(?P<body>(?:.*\n)*?)```$", text, re.M):
        if line["name"]:
            name = line["name"]
        elif line["head"].startswith("new "):
            found.append((name, line["head"][4:], None, line["body"]))
        elif match := re.fullmatch(r'(\S+) after "(.+)"', line["head"]):
            found.append((name, match[1], match[2], line["body"]))
    return found


def follow(tree, steps):
    for _, file, after, added in steps:
        path = tree / file
        if after is None:
            assert not path.exists(), f"{file} is there already"
            path.write_text(added)
        else:
            text = path.read_text()
            assert after in text, f"{file} has no '{after}'"
            path.write_text(text.replace(after, f"{after}\n{added.rstrip()}", 1))


class Adding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = (ROOT / "docs" / "adding.md").read_text()
        cls.steps = examples(cls.page)
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.tree, cls.objects = pathlib.Path(scratch.name) / "tree", pathlib.Path(scratch.name) / "objects"
        cls.objects.mkdir()
        for name in source_files(ROOT):
            if not str(name).startswith(("docs/images", "docs/figures")):
                (cls.tree / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, cls.tree / name)
        follow(cls.tree, cls.steps)

    def touched(self, name):
        return [file for example, file, _, _ in self.steps if example == name and file.endswith(".cc")]

    def flags(self, program):
        """Returns the compiler flags of the test program's sources, with the scratch tree in place of this one."""
        entries = json.loads((BUILD / "compile_commands.json").read_text())
        call = next(entry["command"] for entry in entries if f"etude_tests_{program}.dir" in entry["command"] and "-c " in entry["command"])
        words, kept = shlex.split(call)[1:], []
        while words:
            word = words.pop(0)
            if word in ("-o", "-c", "-include", "-x"):
                words.pop(0)
            elif word not in ("-Winvalid-pch", "-O2"):
                kept.append(word.replace(f"-I{ROOT}", f"-I{self.tree}") if not word.startswith(f"-I{BUILD}") else word)
        return [f"-I{self.tree}", *kept, "-O1", "-Wno-error"]

    def build(self, name, program, others):
        """Compiles what the example changes, with its tests, into a program."""
        sources = self.touched(name)
        for pattern in others:
            sources += sorted(str(path.relative_to(self.tree)) for path in self.tree.glob(pattern))
        sources = list(dict.fromkeys([*sources, *self.generated(name)]))
        flags, objects = self.flags(program), []
        for source in sources:
            objects.append(str(self.objects / re.sub(r"\W", "_", str(source))) + ".o")
            call = ["c++", *flags, "-c", str(self.tree / source), "-o", objects[-1]]
            made = subprocess.run(call, capture_output=True, text=True)
            self.assertEqual(made.returncode, 0, f"{source}\n{made.stderr[-3000:]}")
            if str(source).startswith("bench/tasks/"):
                objects.pop()  # the file needs more than this test program links
        commands = subprocess.run(["ninja", "-t", "commands", f"etude_tests_{program}"], cwd=BUILD, capture_output=True, text=True)
        words = shlex.split(commands.stdout.splitlines()[-1].replace("&&", " "))
        words = words[words.index("-o"):]  # the program's own objects come before -o
        out = self.objects / f"tests_{program}"
        libraries = [word for word in words[2:] if word != ":"]
        call = ["c++", "-Wl,--allow-multiple-definition", *objects, "-o", str(out), *libraries]
        made = subprocess.run(call, cwd=BUILD, capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr[-3000:])
        return out

    def generated(self, name):
        """Returns the files that the build generates from the example's files."""
        if name == "A metric":
            files = sorted(self.tree.glob("bench/metrics/catalogue/*.yaml"), key=lambda path: int(path.name.split("_")[0]))
            subprocess.run([BUILD / "bench/metrics/etude_metric_table", "catalogue_table.cc", *(path.relative_to(self.tree) for path in files)],
                           cwd=self.tree, check=True)
            return ["catalogue_table.cc", "bench/metrics/catalogue.cc"]
        if name == "A move":
            moves = ";".join(map(str, sorted(self.tree.glob("scenarios/choreography/moves/*.yaml"))))
            subprocess.run(["cmake", "-D", "OUT=moves.cc", "-D", "HEADER=sim/choreography/builtin_files.h", "-D", "FUNCTION=BuiltinMoveFiles",
                            "-D", f"FILES={moves}", "-P", "cmake/embed_texts.cmake"], cwd=self.tree, check=True)
            return ["moves.cc", "sim/choreography/move.cc"]  # the reader of moves is compiled in one unit with them
        return []

    def passes(self, program, some, of):
        environment = {**os.environ, "GTEST_FILTER": some}
        run = subprocess.run([program], cwd=self.tree, env=environment, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout[-3000:] + run.stderr[-1000:])
        self.assertGreaterEqual(int(re.search(r"\[  PASSED  \] (\d+)", run.stdout)[1]), of)

    def test_a_metric(self):
        program = self.build("A metric", *METRIC)
        self.passes(program, "Vectors.*", 4)
        sys.path.insert(0, str(self.tree / "tests/bench/metrics"))
        sys.dont_write_bytecode = True
        import second_implementation
        vectors = re.findall(r"input: '(.+)'\n +expected: (\d+)", self.page)
        self.assertEqual([second_implementation.METRICS["point_count"](json.loads(given)) for given, _ in vectors],
                         [int(expected) for _, expected in vectors])

    def test_a_solver(self):
        self.passes(self.build("A solver", *SOLVER), "*Solver*", 10)

    def test_a_move(self):
        self.passes(self.build("A move", *MOVE), "BuiltinMoves*", 5)

    def test_nothing_else_of_the_page_is_left_out(self):
        self.assertEqual(sorted({name for name, *_ in self.steps}), ["A metric", "A move", "A solver"])
        self.assertEqual(len(self.steps), self.page.count("\n```") // 2)


if __name__ == "__main__":
    unittest.main()

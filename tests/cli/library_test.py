"""Tests the installed libetude and libetude_sim: four programs that find them by `find_package(Etude)`, and the
exported symbols."""
import json
import pathlib
import re
import subprocess
import unittest

from etude_case import ETUDE, EtudeCase, heavy

BUILD = pathlib.Path(ETUDE).resolve().parent
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "library"


class Library(EtudeCase):
    @classmethod
    def setUpClass(cls):
        shared = cls.shared_folder()
        cls.prefix, cls.programs = shared / "moved", shared / "programs"
        for component in "library", "development":
            subprocess.run(["cmake", "--install", BUILD, "--prefix", shared / "prefix", "--component", component],
                           check=True, stdout=subprocess.DEVNULL)
        (shared / "prefix").rename(cls.prefix)
        for command in (["cmake", "-S", EXAMPLES, "-B", cls.programs, f"-DCMAKE_PREFIX_PATH={cls.prefix}"],
                        ["cmake", "--build", cls.programs]):
            done = subprocess.run(command, capture_output=True, text=True)
            assert done.returncode == 0, done.stdout + done.stderr
        cls.clips = [shared / "clap.bvh", shared / "boxing.bvh"]
        for clip in cls.clips:
            assert cls.etude("clip", "convert", f"builtin:{clip.stem}", clip).returncode == 0

    def run_program(self, name, *arguments, code=0):
        done = subprocess.run([self.programs / name, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_examples_are_short(self):
        self.assertEqual([file.name for file in EXAMPLES.glob("*.cc") if len(file.read_text().splitlines()) > 40], [])

    def test_a_thousand_poses_are_solved(self):
        told = re.match(r"(\d+) of 1000 poses solved in", self.run_program("thousand_poses").stdout)
        self.assertGreaterEqual(int(told[1]), 995)

    def test_features_and_bridge_frames_of_two_files_are_the_programs(self):
        told = self.run_program("two_clips", *self.clips).stdout
        here = json.loads(self.etude("bridge", *self.clips, "--json").stdout)
        counts = [int(count) for count in re.search(r"bridge frames: (\d+) and (\d+)", told).groups()]
        self.assertEqual(counts, [clip["bridge_frames"] for clip in here["clips"]])
        self.assertGreater(min(counts), 0)
        refused = self.run_program("two_clips", self.clips[0], __file__, code=2)
        self.assertRegex(refused.stderr, "library_test.py:1:1: found .*; expected HIERARCHY")

    def test_a_capture_comes_back_to_its_clip(self):
        done = self.run_program("two_cameras", self.clips[0])
        self.assertLess(float(re.match(r"off by (\S+) m", done.stderr)[1]), 1e-6)
        captured = self.folder / "captured.bvh"
        captured.write_text(done.stdout)
        tables = []
        for clip in self.clips[0], captured:
            table = self.folder / (clip.stem + ".csv")
            self.ends(0, "clip", "convert", clip, table)
            tables.append([line.split(",") for line in table.read_text().splitlines()])
        self.assertEqual(len(tables[0]), len(tables[1]))
        for joint in "left_wrist_x_m", "right_knee_y_m":
            places = [[float(row[table[0].index(joint)]) for row in table[1:]] for table in tables]
            self.assertLess(max(abs(a - b) for a, b in zip(*places)), 0.02, joint)

    @heavy
    def test_sensors_see_a_clip(self):
        told = []
        for name in "a", "b":
            here = self.folder / name
            here.mkdir()
            done = subprocess.run([self.programs / "two_sensors", self.clips[0]], cwd=here, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            told.append((done.stdout, *[(here / f"{camera}.ppm").read_bytes() for camera in ("left", "right")]))
        self.assertEqual(*told)
        words, left, right = told[0]
        tracked, off = map(float, re.match(r"\d+ frames, ([\d.]+) % of the joints tracked, off by ([\d.]+) mm", words).groups())
        self.assertTrue(70 < tracked < 100 and 10 < off < 100, words)
        self.assertEqual([len(left), len(right)], 2 * [len(b"P6 640 480 255\n") + 3 * 640 * 480])
        self.assertNotEqual(left, right)
        for pixels in re.findall(r"(\d+) pixels of the person", words):
            self.assertTrue(2000 < int(pixels) < 640 * 480 / 3, words)

    def test_what_the_headers_declare_is_shown_and_nothing_else(self):
        text = "".join(file.read_text() for file in sorted((self.prefix / "include").rglob("*.h")))
        shown = set()
        for library in "etude", "etude_sim":
            listed = subprocess.run(["nm", "-DC", "--defined-only", self.prefix / "lib" / f"lib{library}.so"], check=True,
                                    capture_output=True, text=True).stdout
            names = [line.split(" ", 2)[2] for line in listed.splitlines()]
            self.assertEqual([name for name in names if "etude::" not in name], [])
            own = {re.split(r"[(<[]", name.partition("etude::")[2])[0].split("::")[-1].lstrip("~") for name in names}
            self.assertEqual([name for name in own if not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text)], [])
            self.assertGreater(len(own), 5)
            shown |= own
        declared = set(re.findall(r"^(?:ETUDE_API )?[A-Za-z](?:[\w:<>,&* ]|\n  +)*?[ &*>](\w+)\((?:[^{;]|\{\})*?\);", text, re.M))
        self.assertGreater(len(declared), 100)
        self.assertEqual(declared - shown, set())
        includes = set(re.findall(r"#include [<\"]([\w./]*[/.][\w./]*)[>\"]", text))
        self.assertEqual({include.split("/")[0] for include in includes}, {"engine", "etude", "glm"})


if __name__ == "__main__":
    unittest.main()

"""Tests `etude forecast`, which computes a rig's expected error, and `etude transition`, which writes a transition
to a file."""
import csv
import math
import pathlib
import time
import unittest

from etude_case import EtudeCase


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.sqrt(dot(a, a)) for x in a]


def matrix(rows, cols, values):
    return (f"!!opencv-matrix\n      rows: {rows}\n      cols: {cols}\n      dt: d\n      data: [ "
            + ", ".join(f"{value:.12g}" for value in values) + " ]\n")


def rig(places, focal=900):
    """Returns cameras of 1280 x 960 pixels that look at (0, 1, 0), in Etude's rig format."""
    text = "%YAML:1.0\n---\ncameras: [ " + ", ".join(f'"cam{i}"' for i in range(len(places))) + " ]\n"
    for i, place in enumerate(places):
        z = unit(sub([0, 1, 0], place))
        x = unit(cross(z, [0, 1, 0]))
        rows = [x, cross(z, x), z]
        text += (f"cam{i}:\n   image_width: 1280\n   image_height: 960\n"
                 f"   camera_matrix: {matrix(3, 3, [focal, 0, 639.5, 0, focal, 479.5, 0, 0, 1])}"
                 f"   distortion_coefficients: {matrix(5, 1, [0] * 5)}"
                 f"   R: {matrix(3, 3, sum(rows, []))}   T: {matrix(3, 1, [-dot(row, place) for row in rows])}")
    return text


CORNERS = [[3, 1.5, 3], [-3, 2, 3], [3, 2, -3], [-3, 1.5, -3]]


class Forecast(EtudeCase):
    def test_is_told_to_programs_and_written(self):
        path = self.write("rig.yaml", rig(CORNERS))
        names = {name: self.folder / name for name in ("map.png", "map.csv", "page.html")}
        begun = time.process_time()
        told = self.facts("forecast", path, "--picture", names["map.png"], "--table", names["map.csv"], "--report", names["page.html"])
        self.assertLess(time.process_time() - begun, 5)
        self.assertEqual((told["places"], len(told["cameras"]), len(told["joints"])), (4000, 4, 20))
        self.assertLess(told["median_mm"], told["p95_mm"])
        self.assertLess(told["p95_mm"], told["worst_mm"])
        changes = {change["change"].split(" at ")[0]: change for change in told["changes"]}
        self.assertEqual(changes["as it is"]["median_mm"], told["median_mm"])
        for change in ("pixels twice as exact", "a perfect calibration", "one more camera"):
            self.assertLess(changes[change]["median_mm"], told["median_mm"], change)
        body = sum(joint["body_mm"] ** 2 for joint in told["joints"]), sum(joint["point_mm"] ** 2 for joint in told["joints"])
        self.assertLess(body[0], body[1])
        with open(names["map.csv"], newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 4000)
        self.assertEqual(max(float(row["error_mm"]) for row in rows if row["error_mm"]), told["worst_mm"])
        self.assertEqual(names["map.png"].read_bytes()[:4], b"\x89PNG")
        self.assertIn("What would help", names["page.html"].read_text())
        # A second call gives the same facts; a third prints them as text.
        self.assertEqual(self.facts("forecast", path), told)
        said = self.etude("forecast", path).stdout
        self.assertIn(f"A point errs by {told['median_mm']:.1f} mm in the median", said)
        self.assertEqual(self.etude("forecast", path, "--picture", names["map.png"]).returncode, 2)

    def test_refuses_what_it_cannot_answer(self):
        four = self.write("rig.yaml", rig(CORNERS))
        for arguments, words in (
                ([self.write("one.yaml", rig(CORNERS[:1]))], "1 camera; allowed: 2 to 32"),
                ([self.write("many.yaml", rig(3 * CORNERS)), "--dropout", "0.1"], "12 cameras; allowed: 2 to 10 with --dropout"),
                ([four, "--noise-px", "nan"], "'nan' is not a deviation in px"),
                ([four, "--middle", "90,0"], "no place within 3 x 3 m around x 90.00, z 0.00"),
                ([four, "--calibration", "5,0.1"], "--calibration"),
                ([self.write("rig.txt", "cameras?")], "rig.txt: not a calibration")):
            with self.subTest(words):
                refused = self.etude("forecast", *arguments)
                self.assertEqual((refused.returncode, refused.stdout, refused.stderr.count("\n")), (2, "", 1), refused.stderr)
                self.assertIn(words, refused.stderr)


class Transition(EtudeCase):
    def test_is_told_to_programs_and_written(self):
        out = self.folder / "out.bvh"
        told = self.facts("transition", "builtin:groove", "builtin:clap", "--at", "1", "-o", out)
        self.assertEqual((told["choice"], told["join"], told["output"]), ("played", "planted-feet", str(out)))
        self.assertAlmostEqual(told["points_s"][0], told["left_s"], places=6)
        seen = self.etude("clip", "info", out)
        self.assertEqual(seen.returncode, 0, seen.stderr)
        self.assertIn(f"{told['duration_s']:.2f} s", seen.stdout)
        # Another method as text, and refusals.
        said = self.etude("transition", "builtin:groove", "builtin:clap", "--at", "1", "-o", self.folder / "cut.trc", "--choice",
                          "now", "--join", "cut")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("as a body: twenty joints", said.stdout)
        late = self.etude("transition", "builtin:groove", "builtin:clap", "--at", "99", "-o", self.folder / "late.bvh")
        self.assertEqual((late.returncode, late.stderr.count("\n")), (2, 1))
        self.assertIn("--at 99: builtin:groove plays from 0.00 to", late.stderr)
        self.assertFalse(pathlib.Path(self.folder / "late.bvh").exists())


if __name__ == "__main__":
    unittest.main()

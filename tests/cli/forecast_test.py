"""Tests `etude forecast`, which computes a rig's expected error, and `etude transition`, which writes a transition
to a file."""
import csv
import pathlib
import time
import unittest

from camera_axes import axes_of, dot
from etude_case import EtudeCase


def matrix(rows, cols, values):
    return (f"!!opencv-matrix\n      rows: {rows}\n      cols: {cols}\n      dt: d\n      data: [ "
            + ", ".join(f"{value:.12g}" for value in values) + " ]\n")


def rig(places, focal=900):
    """Returns cameras of 1280 x 960 pixels that look at (0, 1, 0), in Etude's rig format."""
    text = "%YAML:1.0\n---\ncameras: [ " + ", ".join(f'"cam{i}"' for i in range(len(places))) + " ]\n"
    for i, place in enumerate(places):
        rows = axes_of(place)
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
        for change in ("keypoints twice as exact", "a perfect calibration", "one more camera"):
            self.assertLess(changes[change]["median_mm"], told["median_mm"], change)
        body = sum(joint["body_mm"] ** 2 for joint in told["joints"]), sum(joint["point_mm"] ** 2 for joint in told["joints"])
        self.assertLess(body[0], body[1])
        with open(names["map.csv"], newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 4000)
        self.assertEqual(max(float(row["error_mm"]) for row in rows if row["error_mm"]), told["worst_mm"])
        self.assertEqual(names["map.png"].read_bytes()[:4], b"\x89PNG")
        page = names["page.html"].read_text()
        self.assertIn("What would help", page)
        self.assertEqual({row["x_m"] for row in rows if row["z_m"] == rows[0]["z_m"]}, {f"{(k - 9.5) * 0.15:.4g}" for k in range(20)})
        # A second call gives the same facts; a third prints them as text.
        self.assertEqual(self.facts("forecast", path), told)
        said = self.etude("forecast", path).stdout
        self.assertIn("OpenCV's YAML: lengths in m; up is y, as in the format\n  cam0           x 3.00, z 3.00, 1.50 m high\n", said)
        self.assertIn("OpenCV&#39;s YAML: lengths in m", page)
        self.assertIn(f"The error of a point is {told['median_mm']:.1f} mm in the median", said)
        self.assertEqual(self.etude("forecast", path, "--picture", names["map.png"]).returncode, 2)

    def test_refuses_what_it_cannot_answer(self):
        four = self.write("rig.yaml", rig(CORNERS))
        for arguments, words in (
                ([self.write("one.yaml", rig(CORNERS[:1]))], "1 camera; allowed: 2 to 32"),
                ([self.write("many.yaml", rig(3 * CORNERS)), "--dropout", "0.1"], "12 cameras; allowed: 2 to 10 with --dropout"),
                ([four, "--noise-px", "nan"], "'nan' is not a deviation in px"),
                ([four, "--middle", "90,0"], "two cameras see no common place within 3 x 3 m around x 90.00, z 0.00"),
                ([four, "--calibration", "5,0.1"], "--calibration"),
                ([self.write("rig.txt", "cameras?")], "rig.txt: this is not a calibration"),
                ([self.write("mm.yaml", rig([[1000 * x for x in place] for place in CORNERS]))], "m apart; allowed: 0.03 to 100 m; use --rig-unit to set the unit"),
                *(([four, f"--{option}", self.folder / "a.jpg"], f"a.jpg: has the wrong ending; allowed: {ending}")
                  for option, ending in (("picture", ".png"), ("table", ".csv"), ("report", ".html")))):
            with self.subTest(words):
                refused = self.etude("forecast", *arguments)
                self.assertEqual((refused.returncode, refused.stdout, refused.stderr.count("\n")), (2, "", 1), refused.stderr)
                self.assertIn(words, refused.stderr)
        self.assertFalse((self.folder / "a.jpg").exists())

    def test_reads_a_plan(self):
        """The places of two planned cameras in a file with Z up, and the words about axes."""
        path = self.write("plan.toml", "".join(
            f"[{name}]\nsize = [1280, 960]\nfov_deg = 70\nposition = [{x}, 3, 2]\nlook_at = [0, 0, 1]\n"
            for name, x in (("left", -2), ("right", 2))))
        said = self.etude("forecast", path).stdout
        self.assertIn("lengths in m; up is z, as in the format; Etude's x is the file's y, Etude's z is the file's x, and up is the file's z\n  left           x 3.00, z -2.00, 2.00 m high\n"
                      "  right          x 3.00, z 2.00, 2.00 m high\n", said)
        self.assertEqual(self.facts("forecast", path)["middle_m"], [0, 0])


class Transition(EtudeCase):
    def test_is_told_to_programs_and_written(self):
        out = self.folder / "out.bvh"
        told = self.facts("transition", "builtin:groove", "builtin:clap", "--at", "1", "-o", out)
        self.assertEqual((told["choice"], told["join"], told["output"]), ("played", "planted-feet", str(out)))
        self.assertAlmostEqual(told["points_s"][0], told["left_s"], places=6)
        seen = self.ends(0, "clip", "info", out)
        self.assertIn(f"{told['duration_s']:.2f} s", seen.stdout)
        # What was changed in either clip is told: a gap of 9 frames was bridged.
        whole, gap = self.folder / "whole.trc", self.folder / "gap.trc"
        self.ends(0, "clip", "convert", "builtin:clap", whole)
        lines = whole.read_text().split("\n")
        first = next(k for k, line in enumerate(lines) if line.startswith("10\t"))
        frames = sum("\t" in line for line in lines[first:]) + 9
        gap.write_text("\n".join(lines[:first] + lines[first + 9:]).replace(f"\t{frames}\t", f"\t{frames - 9}\t"))
        bridged = "by their times, 9 of"
        into_gap = ["transition", "builtin:groove", gap, "--at", "1", "-o", self.folder / "bridged.trc", "--overwrite"]
        self.assertIn(f"  {gap}: {bridged}", self.ends(0, *into_gap).stdout)
        told = self.facts(*into_gap)
        self.assertTrue(any(bridged in change for change in told["to_changes"]), told)
        self.assertFalse(any(bridged in change for change in told["from_changes"]), told)
        # Without --json, another method is described as text. A request after the clip's end is refused.
        said = self.etude("transition", "builtin:groove", "builtin:clap", "--at", "1", "-o", self.folder / "cut.trc", "--choice",
                          "now", "--join", "cut")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("written as a body of twenty joints", said.stdout)
        # Unbroken motion never plays the second clip, so no join is used.
        unbroken = ["transition", "builtin:groove", "builtin:clap", "--at", "1", "-o", self.folder / "unbroken.trc", "--choice",
                    "unbroken", "--overwrite"]
        said = self.etude(*unbroken)
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        self.assertIn("the clip builtin:groove continues without a transition, for comparison; builtin:clap is not played\n", said.stdout)
        self.assertNotIn("then", said.stdout)
        said = self.etude(*unbroken, "--join", "cut")
        self.assertEqual((said.returncode, said.stderr),
                         (0, "--join cut has no effect, because --choice unbroken joins no clips\n"))
        self.assertIsNone(self.facts(*unbroken)["join"])
        late = self.etude("transition", "builtin:groove", "builtin:clap", "--at", "99", "-o", self.folder / "late.bvh")
        self.assertEqual((late.returncode, late.stderr.count("\n")), (2, 1))
        self.assertIn("--at 99: outside the clip builtin:groove; allowed: 0.00 to", late.stderr)
        self.assertFalse(pathlib.Path(self.folder / "late.bvh").exists())


if __name__ == "__main__":
    unittest.main()

"""Tests `etude calibrate` and `etude capture`: from measured points to a rig, and from films and keypoints to a
motion."""
import base64
import json
import math
import random
import re
import shutil
import struct
import subprocess
import unittest

from camera_axes import axes_of, dot
from etude_case import EtudeCase, heavy

WIDTH, HEIGHT, FRAMES, RATE = 320, 240, 20, 30
FOCAL = 260.0
PLACES = {"left": (-2.5, 1.6, 3.0), "middle": (0.3, 2.2, 3.9), "right": (3.0, 1.2, 2.4)}


def project(camera, point):
    """Returns OpenCV's pixels of a camera that looks at (0, 1, 0)."""
    x, y, z = axes_of(PLACES[camera])
    p = [a - b for a, b in zip(point, PLACES[camera])]
    return (FOCAL * dot(x, p) / dot(z, p) + WIDTH / 2 - 0.5, FOCAL * dot(y, p) / dot(z, p) + HEIGHT / 2 - 0.5)


def body(t):
    """Returns a stick figure with swinging arms as COCO's seventeen keypoints."""
    a = 0.6 * math.sin(3 * t)
    points = [(0, 1.62, 0.1), (0.03, 1.66, 0.08), (-0.03, 1.66, 0.08), (0.08, 1.64, 0), (-0.08, 1.64, 0)]
    rows = {"shoulder": [], "elbow": [], "wrist": [], "hip": [], "knee": [], "ankle": []}
    for side in (1, -1):
        rows["shoulder"].append((0.18 * side, 1.42, 0))
        rows["elbow"].append((0.18 * side, 1.42 - 0.29 * math.cos(a), side * 0.29 * math.sin(a)))
        ex, ey, ez = rows["elbow"][-1]
        rows["wrist"].append((ex, ey - 0.25 * math.cos(a + 0.5), ez + 0.25 * math.sin(a + 0.5)))
        rows["hip"].append((0.09 * side, 0.92, 0))
        rows["knee"].append((0.09 * side, 0.92 - 0.43 * math.cos(0.2), 0.43 * math.sin(0.2)))
        kx, ky, kz = rows["knee"][-1]
        rows["ankle"].append((kx, ky - 0.42, kz))
    for name in rows:
        points += rows[name]
    return points


def make_film(path, size=f"{WIDTH}x{HEIGHT}", rate=RATE, frames=FRAMES, what="testsrc=", coding=("-pix_fmt", "yuv420p")):
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i", f"{what}size={size}:rate={rate}", "-frames:v",
                    str(frames), *coding, str(path)], check=True, timeout=600)
    return str(path)


class Capture(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Makes point pairs, keypoints, films and the rig once; every test copies them."""
        cls.shared = cls.shared_folder()
        lines = ["camera,x,y,z,u,v"]
        for camera in PLACES:
            for i in range(30):
                point = (math.sin(1.7 * i), 1 + 0.9 * math.cos(2.3 * i), math.sin(0.9 * i + 1))
                lines.append(f"{camera},{','.join(f'{v:.9f}' for v in point + project(camera, point))}")
        (cls.shared / "pairs.csv").write_text("\n".join(lines) + "\n")
        for camera in PLACES:
            folder = cls.shared / "keypoints" / f"{camera}_json"
            folder.mkdir(parents=True)
            for k in range(FRAMES):
                flat = [v for point in body(k / RATE) for v in (*project(camera, point), 0.9)]
                (folder / f"{camera}_{k}.json").write_text(json.dumps({"people": [{"pose_keypoints_2d": flat}]}))
        make_film(cls.shared / "left.mp4")
        for camera in ("middle", "right"):
            shutil.copy(cls.shared / "left.mp4", cls.shared / f"{camera}.mp4")
        calibrated = cls.etude("calibrate", cls.shared / "pairs.csv", "--size", f"{WIDTH}x{HEIGHT}", "--lens", "none", "-o",
                               cls.shared / "rig.yaml")
        assert calibrated.returncode == 0, calibrated.stderr
        cls.calibrated = calibrated.stdout

    def setUp(self):
        super().setUp()
        shutil.copytree(self.shared, self.folder, dirs_exist_ok=True)
        self.pairs, self.rig, self.keypoints = (self.folder / name for name in ("pairs.csv", "rig.yaml", "keypoints"))
        self.films = [str(self.folder / f"{camera}.mp4") for camera in PLACES]

    def capture(self, *arguments, films=None):
        return ["capture", "--rig", self.rig, *(films or self.films), "--keypoints", self.keypoints, *arguments]

    def test_calibrates_by_measured_points(self):
        told = self.calibrated
        self.assertIn("middle: reprojection error 0.000 px RMS over 30 points", told)
        self.assertIn("position         0.300, 2.200, 3.900 m", told)
        self.assertRegex(told, r"focal lengths    260\.00 ± 0\.00, 260\.00")
        again = self.etude("calibrate", self.pairs, "--size", f"{WIDTH}x{HEIGHT}", "--method", "dlt", "-o", self.rig,
                           "--overwrite")
        self.assertIn("theta 90.000 deg", again.stdout)
        text = (self.folder / "rig.yaml").read_text()
        self.assertTrue(text.startswith('%YAML:1.0\n---\ncameras: [ "left", "middle", "right" ]\nleft:\n   image_width: 320'))

    def test_refuses_what_is_no_calibration(self):
        self.rig.unlink()
        self.assertIn("--size '': point pairs as CSV need", self.refusal("calibrate", self.pairs, "-o", self.rig))
        five = self.write("five.csv", "camera,x,y,z,u,v\n" + "a,1,2,3,4,5\n" * 5)
        self.assertIn("camera a: cannot calibrate a camera: found 5 point pairs; allowed: at least 6",
                      self.refusal("calibrate", five, "--size", "640x480", "-o", self.rig))
        words = self.write("words.csv", "camera,x,y,z,u,v\na,1,2,three,4,5\n")
        self.assertIn("words.csv:2: 'three' is not a number",
                      self.refusal("calibrate", words, "--size", "640x480", "-o", self.rig))
        self.assertIn("--board 2x2x1: allowed: 3 to 16 squares", self.refusal("calibrate", "x", "--board", "2x2x1", "-o", self.rig))
        self.assertIn("no such file", self.refusal("calibrate", "nothing.mp4", "-o", self.rig))
        self.assertFalse((self.folder / "rig.yaml").exists(), "nothing is written")

    def test_names_the_click_that_disagrees_and_a_size_or_a_unit_that_cannot_be(self):
        size = f"{WIDTH}x{HEIGHT}"
        heading, *lines = self.pairs.read_text().splitlines()
        dice = random.Random(7)
        noisy = []
        for line in lines:
            name, x, y, z, u, v = line.split(",")
            noisy.append([name, x, y, z, float(u) + dice.gauss(0, .3), float(v) + dice.gauss(0, .3)])
        def written(rows, factor=1):
            return self.write("clicks.csv", "\n".join([heading, *(",".join(map(str, [r[0], *(factor * float(p) for p in r[1:4]), *r[4:]])) for r in rows)]) + "\n")
        def told(table, *arguments):
            return self.facts("calibrate", table, "--size", size, "--lens", "none", "--overwrite", "-o", self.rig, *arguments)["cameras"]
        self.assertEqual([camera["disagreeing_pair"] for camera in told(written(noisy))], [None] * 3, "noise alone is no bad click")
        bad = [list(row) for row in noisy]
        fifth = [row for row in bad if row[0] == "middle"][4]
        fifth[4] += 12
        found = {camera["camera"]: camera["disagreeing_pair"] for camera in told(written(bad))}
        self.assertEqual((found["left"], found["right"]), (None, None))
        self.assertEqual(found["middle"]["pair"], 5)
        self.assertAlmostEqual(found["middle"]["error_px"], 12, delta=2)
        self.assertLess(found["middle"]["rms_without_px"], .6)
        said = self.ends(0, "calibrate", written(bad), "--size", size, "--lens", "none", "--overwrite", "-o", self.rig).stdout
        self.assertRegex(said, r"pair 5 disagrees with the other pairs. A calibration without this pair projects the point \(.*\)\n  1[0-4]\.\d px away from the pixel")
        u, v = map(float, re.search(r"away from the pixel \(([\d.]+), ([\d.]+)\)", said).groups())
        self.assertAlmostEqual(u, fifth[4], delta=.01, msg="as in the file, where the centre of the first pixel is (0, 0)")
        self.assertAlmostEqual(v, fifth[5], delta=.01)
        millimetres = self.ends(0, "calibrate", written(noisy, 1000), "--size", size, "--lens", "none", "--overwrite", "-o", self.rig).stdout
        self.assertRegex(millimetres, r"middle: the camera is \d{4} m from the first point of its pairs; points must be in metres, and may be in millimetres here")
        self.assertRegex(self.refusal("calibrate", self.pairs, "--size", "160x120", "--overwrite", "-o", self.rig),
                         r"camera left: the pixel \(.*\) is outside the picture of 160x120 pixels; check the pixel and the picture size")

    def test_pixels_reach_half_a_pixel_beyond_the_centres_of_the_first_and_last_pixel(self):
        heading, *lines = self.pairs.read_text().splitlines()
        x, y, z = lines[0].split(",")[1:4]
        def calibrated(u, v):
            edge = self.write("edge.csv", "\n".join([heading, f"left,{x},{y},{z},{u},{v}", *lines]) + "\n")
            return self.etude("calibrate", edge, "--size", f"{WIDTH}x{HEIGHT}", "--overwrite", "-o", self.rig).stderr
        for u, v in ((WIDTH - .7, 10), (10, HEIGHT - .6), (-.4, 10), (10, -.4)):
            self.assertNotIn("is outside the picture", calibrated(u, v), f"{u}, {v}")
        for u, v in ((WIDTH - .4, 10), (10, HEIGHT - .3), (-.7, 10), (10, -.6)):
            self.assertIn(f"the pixel ({u:g}, {v:g}) is outside the picture of {WIDTH}x{HEIGHT} pixels", calibrated(u, v))

    def test_tells_programs_what_was_calibrated(self):
        told = self.facts("calibrate", self.pairs, "--size", f"{WIDTH}x{HEIGHT}", "--lens", "none", "--overwrite", "-o", self.rig)
        middle, = [camera for camera in told["cameras"] if camera["camera"] == "middle"]
        self.assertEqual(middle["points"], 30)
        for found, true in zip(middle["focal_px"] + middle["place_m"], (FOCAL, FOCAL, *PLACES["middle"])):
            self.assertAlmostEqual(found, true, places=3)

    def test_prints_a_board(self):
        board = self.folder / "board.png"
        result = self.ends(0, "calibrate", "--print", board, "--board", "5x4x0.1")
        self.assertEqual(board.read_bytes()[:4], b"\x89PNG")
        self.assertIn("500 x 400 mm: needs A2 paper", result.stdout)
        # The board of the guide fits on paper, and the file states its size.
        self.assertIn("170 x 238 mm: fits on A4 or Letter", self.etude("calibrate", "--print", board, "--overwrite").stdout)
        head = board.read_bytes()
        width, height = struct.unpack(">II", head[16:24])
        at = head.index(b"pHYs") + 4
        across, down, unit = struct.unpack(">IIB", head[at:at + 9])
        self.assertEqual(unit, 1)
        self.assertAlmostEqual(width / across, .187, places=4)
        self.assertAlmostEqual(height / down, .255, places=4)

    def test_a_film_without_the_board_that_was_meant_names_the_option(self):
        told = self.refusal("calibrate", *self.films, "-o", self.folder / "new.yaml")
        self.assertRegex(told, r"left.mp4: found no board 5x7x0.034 in \d+ pictures; describe your board with --board: ")
        self.assertIn("charuco:5x7x0.04 (ChArUco)", told)

    def test_captures_a_motion_into_every_format(self):
        trc = self.folder / "points.trc"
        result = self.ends(0, *self.capture("-o", self.folder / "m.bvh", "--points", trc))
        self.assertIn("person 1: seen by left (20 frames), middle (20 frames), right (20 frames)", result.stdout)
        self.assertIn("upper arm 29.0, forearm 25.0", result.stdout)
        # The points are at the figure's places: an independent projection made the keypoints.
        lines = trc.read_text().splitlines()
        names = [name for name in lines[3].split("\t")[2:] if name]
        row = [float(v) / 1000 for v in lines[6 + 7].split("\t")[2:]]
        at = names.index("LWrist")
        wanted = body(7 / RATE)[9]
        for axis in range(3):
            self.assertAlmostEqual(row[3 * at + axis], wanted[axis], places=4)
        told = self.facts("capture", *self.capture("-o", self.folder / "again.bvh")[1:])
        self.assertEqual((told["frames"], told["keypoints"]["people"], told["silhouettes"]), (FRAMES, 1, None))
        self.assertAlmostEqual(told["keypoints"]["lengths_m"]["forearm"], .25, places=3)
        for ending in ("glb", "trc", "csv"):
            result = self.ends(0, *self.capture("-o", self.folder / f"m.{ending}"))
        info = self.etude("clip", "info", self.folder / "m.bvh", self.folder / "m.glb").stdout
        self.assertEqual(info.count("20 frames at 30 Hz"), 2, info)
        distances = self.folder / "real.json"
        beside = self.etude(*self.capture("-o", self.folder / "n.csv", "--reference", trc, "--distances", distances)).stdout
        self.assertRegex(beside, r"LWrist +0\.0 +0\.0 +0\.0 +0\.0\n")
        self.assertIn("agreement, not error", beside)
        # A reference with the names of Etude's joints is compared with the joints of the captured skeleton; a
        # reference with other markers is refused.
        joints = self.etude(*self.capture("-o", self.folder / "j.csv", "--reference", self.folder / "m.trc")).stdout
        self.assertRegex(joints, r"left_wrist +0\.0 +")
        strange = self.folder / "strange.trc"
        strange.write_text(re.sub(r"\b(left|right|hip|shoulder|head|spine)\w*\b", "marker", (self.folder / "m.trc").read_text()))
        self.assertIn("has the name of a keypoint (LShoulder, …) or of a joint (left_shoulder, …)",
                      self.refusal(*self.capture("-o", self.folder / "s.csv", "--reference", strange)))
        self.assertFalse((self.folder / "s.csv").exists())
        told = json.loads(distances.read_text())
        self.assertEqual((told["name"], told["recovery"], told["reference"], told["frames"]),
                         ("n", "keypoints", "points.trc", FRAMES))
        self.assertEqual([column["cameras"] for column in told["distances"]], ["all", "1+2", "1+3", "2+3"])
        self.assertLess(max(column["p95_mm"] for column in told["distances"]), 0.1)
        self.assertIn("--distances requires --reference", self.refusal(
            *self.capture("-o", self.folder / "o.csv", "--distances", self.folder / "o.json")))

        # For exact keypoints of a body with constant lengths, the skeleton's joints lie on the points.
        self.assertRegex(result.stdout, r"left_knee +0\.0 +0\.0\n")
        self.assertRegex(result.stdout, r"\nall +0\.0 +0\.[0-9]\n")

    @heavy
    def test_sets_clocks_by_keypoints(self):
        late = self.keypoints / "right_json"
        for k in range(FRAMES):  # this film is four frames ahead
            flat = [v for point in body((k + 4) / RATE) for v in (*project("right", point), 0.9)]
            (late / f"right_{k}.json").write_text(json.dumps({"people": [{"pose_keypoints_2d": flat}]}))
        for k in range(FRAMES - 2, FRAMES):
            (late / f"right_{k}.json").unlink()
        make_film(self.films[2], frames=FRAMES - 2)
        out = self.folder / "m.csv"
        self.assertIn("use --sync to find the delay from keypoints", self.refusal(*self.capture("-o", out)))
        self.assertIn("--sync: outlines cannot determine the delay", self.refusal(
            "capture", "--rig", self.rig, *self.films, "--silhouettes", "--sync", "1", "-o", out))
        told = self.etude(*self.capture("-o", out, "--sync", "0.3", "--film", self.folder / "m.mp4")).stdout
        clocks = re.search(r"delays relative to left: middle ([+-][0-9.]+) frames .*, right ([+-][0-9.]+) frames", told)
        self.assertIsNotNone(clocks, told)
        self.assertAlmostEqual(float(clocks[1]), 0, delta=0.2)
        self.assertAlmostEqual(float(clocks[2]), 4, delta=0.2)
        self.assertEqual(out.read_text().count("\n"), 1 + FRAMES)

    def test_names_cameras_before_or_after_the_films(self):
        for i, arguments in enumerate((["--cameras", "left,middle,right", *self.films],
                                       [*self.films, "--cameras", "left,middle,right"])):
            self.ends(0, "capture", "--rig", self.rig, *arguments, "--keypoints", self.keypoints, "-o",
                                self.folder / f"{i}.csv")

    @heavy
    def test_needs_somebody_who_moves_where_nothing_is_marked(self):
        still = [make_film(self.folder / f"{camera}.avi", rate=10, frames=4, what="color=c=gray:", coding=("-c:v", "ffv1"))
                 for camera in PLACES]
        alone = ["capture", "--rig", self.rig, *still, "--silhouettes", "-o", self.folder / "m.bvh"]
        self.assertIn("no frame shows a moving person in two films", self.refusal(*alone))
        self.assertIn("no keypoints to write", self.refusal(*alone, "--points", self.folder / "p.trc"))
        self.assertIn("20 frames, but the film", self.refusal(*alone, "--keypoints", self.keypoints))
        self.assertIn("--stature requires --silhouettes", self.refusal(*self.capture("-o", "m.bvh", "--stature", "1.8")))
        rooms = self.folder / "rooms"
        rooms.mkdir()
        for camera in PLACES:
            (rooms / f"{camera}.ppm").write_bytes(b"P6\n4 3\n255\n" + bytes(36))
        self.assertIn("the picture has 4 x 3 pixels", self.refusal(*alone, "--rooms", rooms))
        self.assertFalse((self.folder / "m.bvh").exists(), "nothing is written")

    def test_draws_the_skeleton_over_the_films(self):
        film = self.folder / "overlay.mp4"
        page = self.folder / "page.html"
        self.ends(0, *self.capture("-o", self.folder / "m.csv", "--film", film, "--report", page))
        self.assertIn(base64.b64encode(film.read_bytes()).decode(), page.read_text(), "the page has the same film")
        told = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-show_entries",
                               "stream=width,height,nb_read_packets", "-of", "csv=p=0", str(film)],
                              capture_output=True, text=True, timeout=600).stdout.strip()
        self.assertEqual(told, "1920,480,20")

    def test_refuses_films_that_do_not_fit(self):
        out = self.folder / "m.bvh"
        self.assertIn("1 film; allowed: 2 to 64", self.refusal(*self.capture("-o", out, films=self.films[:1])))
        self.assertIn("none.yaml: no such file", self.refusal("capture", "--rig", "none.yaml", *self.films, "--keypoints",
                                                   self.keypoints, "-o", out))
        self.assertIn("allowed: --keypoints DIR, --marks DIR or --silhouettes", self.refusal("capture", "--rig", self.rig, *self.films, "-o", out))

        def film(name, size, rate, frames):
            (self.folder / name).mkdir()
            return [make_film(self.folder / name / "left.mp4", size, rate, frames, coding=()), *self.films[1:]]

        small = self.refusal(*self.capture("-o", out, films=film("small", "160x120", RATE, FRAMES)))
        self.assertIn("the film has 160 x 120 pixels, but the rig's camera has 320 x 240; use --fit to state how the pictures were resized (letterbox, stretch or crop)", small)
        self.assertIn("at 30 Hz", self.refusal(*self.capture("-o", out, films=film("slow", "320x240", 25, FRAMES))))
        self.assertIn("20 frames", self.refusal(*self.capture("-o", out, films=film("short", "320x240", RATE, 18))))
        (self.keypoints / "left_json" / "left_19.json").unlink()
        self.assertRegex(self.refusal(*self.capture("-o", out)),
                         r"keypoints of 19 frames, but the film .* has 20 frames; allowed: an entry or a file for each frame")
        (self.keypoints / "left_json" / "left_4.json").write_text('{"people": [{"pose_keypoints_2d": [1, 2]}]}')
        self.assertIn("left_4.json: this is not a list of keypoints (2 numbers); allowed: ", self.refusal(*self.capture("-o", out)))
        self.assertFalse(out.exists(), "nothing is written")


if __name__ == "__main__":
    unittest.main()

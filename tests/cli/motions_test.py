"""Tests motions that Etude writes and reads again: recordings of every task, joint angles, and facts of files."""
import json
import math
import pathlib
import re
import subprocess
import unittest

import file_table
import numpy
from etude_case import heavy, png_size
from kinect_rows import arms, kinect
from motion_file_case import MotionFileCase

CMU = "/usr/share/assimp/models/BVH/01_03.bvh"
TASKS = {  # each with the track of its methods
    "ik": ("solution", "trials: 2", "{name: a, solver: ccd, weights: fixed}", "{name: b, solver: gauss-newton}"),
    "tracking": ("solution", "trials: 2\nclips: ['builtin:clap']", "{name: a, solver: ccd, weights: fixed}",
                 "{name: b, solver: gauss-newton}"),
    "transition": ("coach", "trials: 2\nclips: ['builtin:clap', 'builtin:wave']", "{name: a, choice: now, join: cut}",
                   "{name: b, choice: wait-for-end, join: cut}"),
    "detection": ("sensed", "trials: 2\nclips: ['builtin:clap', 'builtin:wave']\nevents: 4", "{name: a, recogniser: dtw}",
                  "{name: b, recogniser: nearest}"),
    "coach": ("coach", "trials: 2\nsong: groove\nsession_s: 10", "{name: a, recogniser: dtw, policy: never}",
              "{name: b, recogniser: dtw, policy: at-first-mistake}"),
    "capture": ("recovered", "trials: 2\nclips: ['builtin:clap']\nduration_s: 0.2",
                "{name: a, segmenter: hue, calibration: dlt, solver: ccd, weights: fixed}",
                "{name: b, segmenter: hue, calibration: dlt, solver: damped-least-squares}"),
}


def turn(axis, degrees):
    """Returns the rotation about an axis of the file (X, Y, Z)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {"X": numpy.array([[1, 0, 0], [0, c, -s], [0, s, c]]), "Y": numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
            "Z": numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])}[axis]


def read_mot(path):
    """Returns the ends of parts by frame, by a .mot file's own model; the limits of angles; and the angles."""
    head, _, table = path.read_text().partition("endheader\n")
    facts = dict(line.split("=") for line in head.splitlines() if "=" in line)
    parts, limits = {}, {}
    for line in head.splitlines():
        words = line.split()
        if words[:1] == ["part"]:
            name, parent, bone, turns = words[1], words[3], numpy.array(words[5:8], float), words[9:]
            parts[name] = (parent, bone, list(zip(turns[::2], turns[1::2])))
        if words[:1] == ["limit"]:
            limits[words[1]] = (float(words[2]), float(words[3]))
    rows = [dict(zip(table.splitlines()[0].split("\t"), map(float, line.split("\t")))) for line in table.splitlines()[1:]]
    assert facts["version"] == "1" and facts["inDegrees"] == "yes"
    assert (int(facts["nRows"]), int(facts["nColumns"])) == (len(rows), len(rows[0]))
    frames = []
    for row in rows:
        axes, ends = {"ground": numpy.eye(3)}, {"ground": numpy.array([row[f"pelvis_t{axis}"] for axis in "xyz"])}
        for name, (parent, bone, turns) in parts.items():
            own = axes[parent]
            for (sign, axis), angle in turns:
                own = own @ turn(axis, row[angle] * (-1 if sign == "-" else 1))
            axes[name], ends[name] = own, ends[parent] + own @ bone
        # the file: X forward, Y up, Z right; Etude: X left, Y up, Z forward
        frames.append({name: numpy.array([-z, y, x]) for name, (x, y, z) in ends.items()})
    return frames, limits, rows, {name: parent for name, (parent, _, _) in parts.items()}


class Motions(MotionFileCase):
    @classmethod
    def setUpClass(cls):
        shared = cls.shared_folder()
        for task, (_, facts, *methods) in TASKS.items():
            lines = "".join(f"  - {method}\n" for method in methods)
            (shared / f"{task}.yaml").write_text(f"scenario: {task}\nquestion: Is it there?\ntask: {task}\n{facts}\nmethods:\n{lines}")
        cls.run_folder = shared / "out"
        result = cls.etude("run", shared, "-o", cls.run_folder, "--trials", "1", "--keep", "motions")
        assert result.returncode in (0, 1), result.stderr

    def recorded(self, cell):
        return json.loads((self.run_folder / "recordings" / (cell.replace("/", "~") + ".json")).read_text())

    def test_of_every_task_truth_and_every_method_is_a_clip(self):
        for task, (own, *_) in TASKS.items():
            worlds = sorted({path.stem.rpartition("~")[0].replace("~", "/") for path in
                             (self.run_folder / "recordings").glob(f"{task}~*.json")})
            self.assertEqual(len(worlds), 1, task)
            self.assertEqual(len(list((self.run_folder / "recordings").glob(f"{task}~*.json"))), 2, task)
            for method in "ab" if task == "capture" else "a":
                recording = self.recorded(f"{worlds[0]}/{method}")
                self.assertEqual((recording["recording"], recording["unit"], recording["up"]), (2, "m", "y"))
                tracks = {track["name"]: track for track in recording["tracks"]}
                joints = self.joints(f"{self.run_folder}#{worlds[0]}@{method}", "--rate", tracks[own]["rate_hz"])
                self.assertEqual(list(joints[0]), recording["joints"], task)
                self.assertEqual(len(joints), len(tracks[own]["poses"]), task)
                for frame, pose in zip(joints, tracks[own]["poses"]):
                    numpy.testing.assert_allclose(numpy.ravel(list(frame.values())), pose, atol=1e-9)
            if "truth" in tracks:
                first = next(track for track in self.recorded(f"{worlds[0]}/a")["tracks"] if track["name"] == "truth")
                named = self.etude("clip", "info", f"{self.run_folder}#{worlds[0]}@truth", "--json")
                self.assertEqual(json.loads(named.stdout)["clips"][0]["frames"], len(first["poses"]), task)
        other = self.joints(f"{self.run_folder}#transition/-/000/a@b")
        self.assertEqual(len(other), len(self.recorded("transition/-/000/b")["tracks"][0]["poses"]))

    def test_a_track_comes_before_a_method_of_its_name(self):
        scenario = self.write("named.yaml", "scenario: s\nquestion: Q?\ntask: ik\ntrials: 1\nmethods:\n"
                              "  - {name: ours, solver: ccd, weights: fixed}\n  - {name: truth, solver: gauss-newton}\n")
        out = self.folder / "named"
        result = self.etude("run", scenario, "-o", out, "--keep", "motions")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        tracks = {method: {track["name"]: track["poses"][-1] for track in json.loads(
            (out / f"recordings/s~-~000~{method}.json").read_text())["tracks"]} for method in ("ours", "truth")}
        for name, (method, track) in {"000@truth": ("ours", "truth"), "000/ours@truth": ("ours", "truth"),
                                      "000/truth@truth": ("truth", "truth"), "000/truth@solution": ("truth", "solution"),
                                      "000/truth@": ("truth", "solution"), "000/truth@ours": ("ours", "solution")}.items():
            last = self.joints(f"{out}#s/-/{name}")[-1]
            numpy.testing.assert_allclose(numpy.ravel(list(last.values())), tracks[method][track], atol=1e-9, err_msg=name)

    def test_it_stands_wherever_a_clip_may(self):
        clips = [f"{self.run_folder}#detection/-/000@{name}" for name in ("truth", "a")]
        for arguments in (("clip", "grades", *clips), ("bridge", *clips), ("teach", *clips, "-o", self.folder / "moves.yaml")):
            self.ends(0, *arguments)
        scenario = self.cut_scenario("builtin:clap")
        self.run_suite(scenario, "--clips", f"{self.run_folder}#transition/-/000@a", "builtin:wave")
        self.run_suite("--from", self.out / "manifest.json", out=self.folder / "again")

    def test_what_no_run_recorded_is_told(self):
        self.assertIn("has no recording of the cell 'capture/-/007'", self.refusal("clip", "info", f"{self.run_folder}#capture/-/007@truth"))
        self.assertIn("animation 'nobody'", self.refusal("clip", "info", f"{self.run_folder}#capture/-/000/a@nobody"))

    def test_a_recording_that_names_no_joints_is_refused_with_the_reason(self):
        recording = self.recorded("capture/-/000/a")
        old = self.write("old.json", json.dumps({key: recording[key] for key in ("tracks", "extras")}, separators=(",", ":")))
        self.assertIn("a recording of version 1, which does not list its joints", self.refusal("clip", "info", old))
        recording["joints"][:2] = reversed(recording["joints"][:2])
        turned = self.write("turned.json", json.dumps(recording, separators=(",", ":")))
        self.assertIn("'joints': ", self.refusal("clip", "info", turned))

    @heavy
    def test_angles_give_the_body_back_through_their_model(self):
        for clip, is_rigid in (("builtin:aerobic", True), (CMU, False), (f"{self.run_folder}#capture/-/000@a", False)):
            out = self.folder / "angles.mot"
            self.ends(0, "clip", "convert", clip, out, "--overwrite")
            truth = self.joints(clip)
            frames, limits, rows, parents = read_mot(out)
            self.assertEqual(len(frames), len(truth))
            found, wanted, again = ({name: numpy.array([frame[name] for frame in motion]) for name in parents}
                                    for motion in (frames, truth, self.joints(out)))
            worst_deg = worst_m = 0
            for name, parent in parents.items():
                worst_m = max(worst_m, numpy.linalg.norm(found[name] - wanted[name], axis=1).max())
                if parent == "ground":
                    continue
                a, b = found[name] - found[parent], wanted[name] - wanted[parent]
                angles = numpy.arctan2(numpy.linalg.norm(numpy.cross(a, b), axis=1), (a * b).sum(axis=1))
                worst_deg = max(worst_deg, math.degrees(angles.max()))
            self.assertLess(worst_deg, 0.01, clip)
            if is_rigid:
                self.assertLess(worst_m, 1e-5)
            for name in parents:  # the program reads its own file
                numpy.testing.assert_allclose(again[name], found[name], atol=1e-9, err_msg=name)
            for name in rows[0]:  # angles do not jump by whole turns
                if name != "time":
                    steps = numpy.abs(numpy.diff([row[name] for row in rows]))
                    self.assertLess(steps.max(), 180, (clip, name))

    def test_angles_that_are_read_have_a_model_and_its_columns(self):
        out = self.folder / "angles.mot"
        self.ends(0, "clip", "convert", "builtin:clap", out)
        told, own = (json.loads(self.etude("clip", "info", clip, "--json").stdout)["clips"][0] for clip in (out, "builtin:clap"))
        self.assertEqual((told["format"], told["rate_hz"], told["frames"]), ("MOT", 30, own["frames"]))
        text = out.read_text()
        for before, after, says in (("part right_knee after right_hip", "part right_knee after right_foot", "and a body part from a line above"),
                                    ("part head ", "part crown ", "part 'crown'"), ("\tknee_angle_r", "\tknee", "'knee_angle_r'"),
                                    ("turns +Z ", "turns +Q ", "found the axis and angle '+Q'"), ("0.000000\t", "0.000000\tnan\t", "nan"),
                                    ("0.066667\t", "0.010000\t", "do not decrease")):
            self.assertIn(before, text)
            self.assertIn(says, self.refusal("clip", "info", self.write("bad.mot", text.replace(before, after, 1))))
        foreign = self.write("theirs.mot", re.sub(r"(?m)^part .*\n", "", text))
        self.assertIn("which needs a model from another file", self.refusal("clip", "info", foreign))

    def test_angles_have_the_signs_and_limits_of_their_names(self):
        joints = self.joints("builtin:clap")[:1]
        path = self.folder / "bent.csv"
        body = joints[0]
        # The right thigh is raised forward by 60° and the shank hangs: hip and knee flexion are 60°.
        knee, ankle = body["right_hip"] + 0.4 * numpy.array([0, -.5, math.sqrt(.75)]), numpy.array([0, -.4, 0])
        bent = {**body, "right_knee": knee, "right_ankle": knee + ankle, "right_foot": knee + ankle + [0, -.05, .17]}
        with open(path, "w") as file:
            file.write("time_s," + ",".join(f"{name}_{axis}_m" for name in body for axis in "xyz") + "\n")
            for t in range(3):
                file.write(f"{t / 30}," + ",".join(str(float(v)) for name in bent for v in bent[name]) + "\n")
        out = self.folder / "bent.mot"
        self.ends(0, "clip", "convert", path, out)
        _, limits, rows, _ = read_mot(out)
        self.assertEqual(limits["knee_angle_r"][0], 0)
        self.assertGreater(limits["knee_angle_r"][1], 120)
        self.assertEqual(limits["hip_flexion_r"], limits["hip_flexion_l"])
        self.assertLess(limits["hip_flexion_r"][0], 0)
        self.assertEqual(set(limits) - set(rows[0]), set())

    @heavy
    def test_joints_lie_where_second_readers_put_them(self):
        glb = self.folder / "own.glb"
        self.ends(0, "clip", "convert", CMU, glb)
        for path, most_mm in ((pathlib.Path(CMU), 1e-6), (glb, 0.01)):  # GLB holds floats
            facts = json.loads(self.etude("clip", "info", path, "--json").stdout)["clips"][0]
            worst_mm, joints = file_table.worst_mm(path, facts)
            self.assertLess(worst_mm, most_mm)
            self.assertGreater(joints, 15)
        facts["body"]["metres_per_unit"] *= 1.01  # the control: with a unit wrong by 1 % the check must fail
        self.assertGreater(file_table.worst_mm(path, facts)[0], 5)

    @heavy
    def test_a_rate_that_is_told(self):
        for command, said in ((("clip", "info", CMU, "--json"), None), (("bridge", CMU, "builtin:wave", "--json"), None)):
            own, told = (json.loads(self.etude(*command, *more).stdout) for more in ((), ("--rate", 60)))
            self.assertNotEqual(own, told, command)
        rate = json.loads(self.etude("clip", "info", CMU, "--rate", 60, "--json").stdout)["clips"][0]["rate_hz"]
        self.assertEqual(rate, 60)
        own, told = (self.etude("teach", CMU, *more, "-o", self.folder / "m.yaml", "--overwrite").stderr for more in
                     ((), ("--rate", 60)))
        seconds = [float(re.search(r"clip, ([\d.]+) s", text)[1]) for text in (own, told)]
        self.assertAlmostEqual(seconds[1] / seconds[0], 2, places=1)  # 120 Hz
        scenario = self.cut_scenario("builtin:clap")
        frames = []
        for i, more in enumerate(((), ("--rate", 60))):
            self.run_suite(scenario, "--clips", CMU, "builtin:wave", *more, out=self.folder / str(i))
            manifest = json.loads((self.folder / str(i) / "manifest.json").read_text())
            frames.append(manifest["scenarios"][0]["loaded_clips"][0]["frames"])
        self.assertAlmostEqual(frames[1] / frames[0], 2, places=1)
        own, told = (len(self.joints(CMU, *more)) for more in ((), ("--file-rate", 60)))
        self.assertAlmostEqual(told / own, 2, places=1)

    def test_teach_is_told_units_of_clips_and_refuses_those_of_sensors(self):
        moves = self.folder / "moves.yaml"
        self.assertIn("with the given unit", self.refusal("teach", CMU, "--unit", "mm", "-o", moves))
        take = self.write("take.txt", kinect(arms(100)))
        self.assertIn("--joint-map and --unit are allowed only for clips", self.refusal("teach", take, "--unit", "cm", "-o", moves))
        roles = self.write("roles.yaml", "roles:\n  left_hand: RightHand\n")
        self.assertIn("the role left_hand has the joint", self.refusal("teach", CMU, "--map", roles, "-o", moves))

    def with_z_up(self):
        """Returns two CSV files of one motion, the second with Z up, and the doubt about the second."""
        y_up, z_up = self.folder / "y.csv", self.folder / "z.csv"
        self.ends(0, "clip", "convert", "builtin:clap", y_up)
        rows = [line.split(",") for line in y_up.read_text().splitlines()]
        at = [k for k, name in enumerate(rows[0]) if name.endswith("_y_m")]
        for row in rows[1:]:
            for k in at:  # the turn (x, y, z) → (x, −z, y), whose inverse makes Z up to Y up
                row[k], row[k + 1] = str(-float(row[k + 1])), row[k]
        z_up.write_text("".join(",".join(row) + "\n" for row in rows))
        return y_up, z_up, "the body stands along Z, but Y is the convention of joint CSV; --up sets another axis"

    def test_commands_that_read_clips_tell_the_doubts_once(self):
        y_up, z_up, doubt = self.with_z_up()
        for more, count in (((), 1), (("--up", "z"), 0)):
            for k, command in enumerate((("clip", "grades", z_up), ("clip", "contacts", z_up, "-o", self.folder / "c.svg", "--overwrite"),
                                         ("bridge", z_up, y_up), ("transition", z_up, z_up, "--at", 0.5, "-o", self.folder / "t.csv", "--overwrite"))):
                told = self.etude(*command, *more).stderr
                self.assertEqual(told.count(f"{z_up}: {doubt}\n"), count, told)
                self.assertEqual(told.count(doubt), count, told)
        # The actor of a TRC enters after half a second.
        late = self.folder / "late.trc"
        self.ends(0, "clip", "convert", "builtin:clap", late)
        lines = late.read_text().split("\n")
        first = next(k for k, line in enumerate(lines) if line.startswith("1\t"))
        for k in range(first, first + 15):
            lines[k] = "\t".join(lines[k].split("\t")[:2]) + "\t" * 60
        late.write_text("\n".join(lines))
        told = self.ends(0, "transition", late, "builtin:wave", "--at", 0.8, "-o", self.folder / "late.csv").stderr
        self.assertRegex(told, rf"^{late}: Etude uses only frames 16 to (\d+) of \1, because joints are missing before and after")

    def test_the_up_axis_of_a_recording_is_doubted_or_stated(self):
        y_up, z_up, doubt = self.with_z_up()
        told, moves = {}, {}
        for name, take, more in (("y", y_up, ()), ("z", z_up, ()), ("stated", z_up, ("--up", "z"))):
            path = self.folder / f"{name}.yaml"
            told[name] = self.ends(0, "teach", take, *more, "-o", path).stderr
            moves[name] = path.read_text().replace("'z'", "'y'")  # a move has the name of its file
        self.assertEqual([doubt in text for text in told.values()], [False, True, False])
        self.assertEqual(moves["stated"], moves["y"])
        live = [self.etude("recognise", "-", "--moves", self.folder / "y.yaml", *more, text=z_up.read_text()).stderr for more in ((), ("--up", "z"))]
        self.assertEqual([text.count("standard input: " + doubt) for text in live], [1, 0])
        take = self.write("take.txt", kinect(arms(100)))
        self.assertIn("--up is allowed only for clips and for recordings in CSV or TRC", self.refusal("teach", take, "--up", "z", "-o", self.folder / "k.yaml"))

    def test_a_picture_of_roles_also_where_some_are_missing(self):
        def pixels(path):  # the two colours: roles found by names, and by proportions
            width, height = png_size(path.read_bytes())
            self.assertEqual(width, 1200)
            raw = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True)
            picture = numpy.frombuffer(raw.stdout, numpy.uint8).reshape(height * width, 3).astype(int)
            return [int((abs(picture - colour).max(axis=1) < 3).sum()) for colour in ((107, 194, 204), (245, 173, 84))]
        picture = self.folder / "roles.png"
        self.ends(0, "clip", "map", CMU, "--preview", picture)
        by_name, by_build = pixels(picture)
        self.assertGreater(by_name, 1000)
        self.assertEqual(by_build, 0)
        odd = self.write("odd.bvh", re.sub(r"(JOINT|ROOT) (\w+)", lambda m: f"{m[1]} q{m.start()}", pathlib.Path(CMU).read_text()))
        missing = self.folder / "missing.png"
        result = self.etude("clip", "map", odd, "--preview", missing)
        less_by_name, by_build = pixels(missing)
        self.assertLess(less_by_name, by_name, result.stderr)
        self.assertGreater(by_build, 500)
        self.assertIn("allowed: .png", self.refusal("clip", "map", CMU, "--preview", self.folder / "roles.svg"))


if __name__ == "__main__":
    unittest.main()

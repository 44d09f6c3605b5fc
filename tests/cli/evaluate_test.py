"""Tests `etude evaluate`: it compares files of different formats, rates and sizes with their truths."""
import csv
import json
import pathlib
import random
import shutil
import sys

from etude_case import EtudeCase

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "bench" / "metrics"))
from independent.evaluation import METRICS  # noqa: E402

FEET = ["left_ankle", "left_foot", "right_ankle", "right_foot"]
BENDS = [[f"{side}_{joint}" for joint in limb] for side in ("left", "right")
         for limb in (("hip", "knee", "ankle"), ("shoulder", "elbow", "wrist"))]


def trc(names, frames, rate):
    """Returns a TRC file in millimetres; None is a gap."""
    lines = ["PathFileType\t4\t(X/Y/Z)\tmine.trc",
             "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames",
             f"{rate}\t{rate}\t{len(frames)}\t{len(names)}\tmm\t{rate}\t1\t{len(frames)}",
             "Frame#\tTime\t" + "\t\t\t".join(names) + "\t\t",
             "\t\t" + "\t".join(f"{axis}{i + 1}" for i in range(len(names)) for axis in "XYZ"), ""]
    for f, frame in enumerate(frames):
        cells = [f"{1000 * x:.6f}" if p else "" for p in frame for x in (p or [0, 0, 0])]
        lines.append(f"{f + 1}\t{f / rate:.7f}\t" + "\t".join(cells))
    return "\n".join(lines) + "\n"


class Evaluate(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Writes a built-in move as files, and reads its joints."""
        cls.shared = cls.shared_folder()
        for name in ("clap.csv", "clap.bvh", "clap.npz", "clap.c3d"):
            made = cls.etude("clip", "convert", "builtin:clap", cls.shared / name)
            assert made.returncode == 0, made.stderr
        with open(cls.shared / "clap.csv") as file:
            rows = list(csv.DictReader(file))
        cls.names = [name[:-4] for name in rows[0] if name.endswith("_x_m")]
        cls.frames = [[[float(row[f"{name}_{axis}_m"]) for axis in "xyz"] for name in cls.names] for row in rows]

    def trc_file(self, name, frames, rate=30.0):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(trc(self.names, frames, rate))
        return path

    def evaluate(self, *arguments, code=0, out=None):
        done = self.etude("evaluate", *arguments, "-o", out or self.out)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def rows(self, out=None):
        return [json.loads(line) for line in ((out or self.out) / "cells.jsonl").read_text().splitlines()]

    def given(self, found, truth, rate):
        """Returns lists of frames as the second implementation's input."""
        def column(frames, name):
            return [frame[self.names.index(name)] for frame in frames]
        return {"rate_hz": rate, "found": found, "truth": truth, "segment": 100, "found_turns": [], "true_turns": [],
                "found_contacts": [], "true_contacts": [], "found_angles": [], "true_angles": [], "statistics": [],
                "window": 30, "beats_s": [],
                "found_root": column(found, "hip_centre"), "true_root": column(truth, "hip_centre"),
                "feet": [list(feet) for feet in zip(*(column(found, name) for name in FEET))],
                "bends": [[self.names.index(name) for name in bend] for bend in BENDS]}

    def assert_agrees(self, row, given, places):
        for name, metric in METRICS.items():
            expected = metric(given) if name != "lag_ms" else None  # no lag is searched here
            if expected is None:
                self.assertIsNone(row[name], name)
            else:
                self.assertAlmostEqual(row[name], expected, delta=10 ** -places * max(1, abs(expected)), msg=name)

    def test_every_metric_is_that_of_the_second_implementation(self):
        dice = random.Random(61)
        noisy = [[None if dice.random() < 0.02 else [1.05 * x + dice.gauss(0.01, 0.02) for x in p] for p in frame]
                 for frame in self.frames]
        # Rounded as in the file.
        noisy = [[p and [round(1000 * x, 6) / 1000 for x in p] for p in frame] for frame in noisy]
        answer = self.trc_file("answer.trc", noisy)
        self.evaluate(self.shared / "clap.csv", answer)
        row, = self.rows()
        self.assertEqual((row["status"], row["clip"], row["method"]), ("ok", "clap", "answer"))
        self.assert_agrees(row, self.given(noisy, self.frames, 30), 9)
        # The same motion in other formats, within the digits that each stores.
        for name, places in ("clap.npz", 5), ("clap.bvh", 2), ("clap.c3d", 2):
            out = self.folder / name
            self.evaluate(self.shared / name, answer, "--metric", "mpjpe_root_mm", out=out)
            other, = self.rows(out)
            for metric in "mpjpe_root_mm", "mpjpe_each_frame_scaled_mm", "mpjpe_take_mm":
                self.assertAlmostEqual(other[metric], row[metric], places, f"{name}, {metric}")

    def test_formats_of_one_motion_agree_with_each_other(self):
        for a, b in ("clap.bvh", "clap.csv"), ("clap.c3d", "clap.bvh"), ("clap.npz", "clap.npz"):
            out = self.folder / (a + b)
            said = self.evaluate(self.shared / a, self.shared / b, out=out).stdout
            row, = self.rows(out)
            self.assertLess(row["mpjpe_unaligned_mm"], 0.5, said)
            self.assertIn("1 of 1 cells ok", said)

    def test_a_shift_a_size_and_a_rate_are_told_apart(self):
        shifted = [[[p[0] + 0.01, p[1], p[2]] for p in frame] for frame in self.frames]
        larger = [[[1.1 * x for x in p] for p in frame] for frame in self.frames]
        self.trc_file("m/shift.trc", shifted)
        self.trc_file("m/size.trc", larger)
        self.trc_file("m/slow.trc", self.frames, rate=15.0)
        for name in "shift", "size", "slow":
            self.trc_file(f"t/{name}.trc", self.frames)
        self.evaluate(self.folder / "t", self.folder / "m")
        rows = {row["clip"]: row for row in self.rows()}
        self.assertAlmostEqual(rows["shift"]["mpjpe_unaligned_mm"], 10, 6)
        self.assertAlmostEqual(rows["shift"]["mpjpe_root_mm"], 0, 6)
        self.assertGreater(rows["size"]["mpjpe_root_mm"], 20)
        self.assertAlmostEqual(rows["size"]["mpjpe_each_frame_scaled_mm"], 0, 3)
        self.assertGreater(rows["slow"]["mpjpe_unaligned_mm"], 5, "a motion at half its rate is another motion")
        self.assertIn("(the truth has 30 Hz, the answer 15 Hz)", rows["slow"]["reason"])

    def test_two_runs_that_were_not_judged_alike_say_it(self):
        for i in range(8):
            self.trc_file(f"t/{i}.trc", [[[p[0] * (1 + i / 50), p[1], p[2]] for p in frame] for frame in self.frames])
        then, now = self.folder / "then", self.folder / "now"
        for out, moved in (then, 0.04), (now, 0.02):
            for i in range(8):
                frames = [[[p[0] * (1 + i / 50), p[1] + moved, p[2]] for p in frame] for frame in self.frames]
                for frame in frames[::2] if out == now else []:  # the wrist is hidden in every second frame
                    frame[self.names.index("left_wrist")] = None
                self.trc_file(f"m/{i}.trc", frames)
            self.evaluate(self.folder / "t", f"m={self.folder}/m", out=out)
        moves = {move["metric"]: move for move in self.facts("compare", then, now)["moves"]}
        self.assertEqual(moves["mpjpe_unaligned_mm"]["movement"], "undecided")
        self.assertIn("not judged alike: “before” is judged on 100.0 % of what the truth shows, “now” on 97.5 %",
                      moves["mpjpe_unaligned_mm"]["not_alike"])
        self.assertEqual(moves["seen_share"]["movement"], "worse")
        self.assertNotIn("not_alike", moves["seen_share"])
        # The control: both runs show the same.
        for i in range(8):
            self.trc_file(f"m/{i}.trc", [[[p[0] * (1 + i / 50), p[1] + 0.02, p[2]] for p in frame] for frame in self.frames])
        self.evaluate(self.folder / "t", f"m={self.folder}/m", out=self.folder / "all")
        moves = {move["metric"]: move for move in self.facts("compare", then, self.folder / "all")["moves"]}
        self.assertEqual(moves["mpjpe_unaligned_mm"]["movement"], "better")
        self.assertNotIn("not_alike", moves["mpjpe_unaligned_mm"])

    def test_equal_truths_are_one_unit_unless_worlds_are_units(self):
        for name in "a", "b":
            self.trc_file(f"t/{name}.trc", self.frames)
            self.trc_file(f"m/{name}.trc", [[[p[0] + 0.02, p[1], p[2]] for p in frame] for frame in self.frames])
        text = f"scenario: s\nquestion: q?\ntask: evaluation\ntruth: ['{self.folder}/t']\nmethods: [{{name: m, answers: ['{self.folder}/m']}}]\n"
        for unit, units, says in (("clip", ["a"], "so the two are one unit"),
                                  ("world", None, "but each is a unit of its own (unit: world)")):
            rows = self.run_suite(self.write("s.yaml", text + f"unit: {unit}\n"), out=self.folder / unit)
            self.assertIn(f"; the truth is that of a, {says}", rows[1]["reason"])
            self.assertNotIn("the truth is that of", rows[0]["reason"])
            self.assertEqual([row.get("units") for row in rows], [units, units])

    def test_a_file_more_changes_no_other_and_a_changed_one_is_told(self):
        for name in "b", "d":
            self.trc_file(f"t/{name}.trc", self.frames)
            self.trc_file(f"m/{name}.trc", [[[p[0] + 0.02, p[1], p[2]] for p in frame] for frame in self.frames])
        arguments = [f"{self.folder}/t/*", f"m={self.folder}/m/*"]
        self.evaluate(*arguments)
        for name in "a", "c":
            self.trc_file(f"t/{name}.trc", self.frames[:40])
            self.trc_file(f"m/{name}.trc", self.frames[5:45])
        more = self.folder / "more"
        self.evaluate(*arguments, out=more)
        self.assertEqual([row["clip"] for row in self.rows(more)], ["a", "b", "c", "d"])
        facts = self.facts("compare", self.out, more)
        self.assertEqual(facts["moves"], [])
        self.assertEqual(facts["only_before"], [])
        self.assertEqual(sorted(facts["only_after"]), ["evaluate, a", "evaluate, c"])
        # A baseline of two files passes a run of four, and fails if one of the two is missing.
        baseline = self.folder / "two.json"
        self.assertEqual(self.etude("gate", self.out, "--baseline", baseline, "--update").returncode, 0)
        self.ends(0, "gate", more, "--baseline", baseline)
        self.etude("gate", more, "--baseline", self.folder / "four.json", "--update")
        fewer = self.ends(3, "gate", self.out, "--baseline", self.folder / "four.json")
        self.assertIn("evaluate, a", fewer.stdout + fewer.stderr)
        # Both runs are intact; after a file changes, replay and verify name it.
        self.assertEqual(self.etude("verify", self.out).returncode, 0)
        self.trc_file("m/d.trc", self.frames)
        for command in "replay", "verify":
            told = self.etude(command, self.out)
            self.assertEqual(told.returncode, 2, command + told.stdout + told.stderr)
            self.assertIn("m/d.trc", told.stderr)

    def test_what_cannot_be_judged_is_a_row_and_the_others_stay(self):
        for name in "a", "b", "c", "d":
            self.trc_file(f"t/{name}.trc", self.frames)
        self.trc_file("m/a.trc", self.frames)
        self.write("m/b.trc", "PathFileType\tno motion\n")
        self.trc_file("m/c.trc", [[None] * 20] * 10)
        said = self.evaluate(self.folder / "t", f"m={self.folder}/m", code=1).stdout
        rows = {row["clip"]: row for row in self.rows()}
        self.assertEqual({name: row["status"] for name, row in rows.items()},
                         {"a": "ok", "b": "failed", "c": "failed", "d": "failed"})
        self.assertIn("b.trc", rows["b"]["reason"])
        self.assertEqual(rows["d"]["reason"], "the method has no answer of this name")
        self.assertIn("3 not judged:", said)
        self.assertEqual(rows["a"]["mpjpe_unaligned_mm"], 0)

    def test_a_pelvis_is_the_root_where_both_files_have_one_and_else_it_is_said(self):
        joints = {"Hips": (None, (0, 95, 0)), "Spine": ("Hips", (0, 20, 0)), "Neck": ("Spine", (0, 30, 0)), "Head": ("Neck", (0, 12, 0))}
        for side, sign in ("Left", 1), ("Right", -1):
            joints |= {f"{side}UpLeg": ("Hips", (9 * sign, -5, 0)), f"{side}Leg": (f"{side}UpLeg", (0, -43, 0)),
                       f"{side}Foot": (f"{side}Leg", (0, -42, 0)), f"{side}ToeBase": (f"{side}Foot", (0, -5, 14)),
                       f"{side}Arm": ("Spine", (18 * sign, 26, 0)), f"{side}ForeArm": (f"{side}Arm", (28 * sign, 0, 0)),
                       f"{side}Hand": (f"{side}ForeArm", (25 * sign, 0, 0))}

        def bvh(name, hips_down):
            def joint(at, depth):
                parent, (x, y, z) = joints[at]
                y -= hips_down if at.endswith("UpLeg") else 0
                kind, channels = ("ROOT", "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation") if parent is None else \
                    ("JOINT", "3 Zrotation Xrotation Yrotation")
                inner = [line for child, (above, _) in joints.items() if above == at for line in joint(child, depth + 1)]
                return [f"{kind} {at}", "{", f"OFFSET {x} {y} {z}", f"CHANNELS {channels}", *(inner or ["End Site", "{", "OFFSET 0 5 0", "}"]), "}"]
            row = "0 95 0 " + " ".join(["0"] * 3 * len(joints))
            return self.write(name, "\n".join(["HIERARCHY", *joint("Hips", 0), "MOTION", "Frames: 9", "Frame Time: 0.033333", *[row] * 9, ""]))
        truth, lower, torso = bvh("truth.bvh", 0), bvh("lower.bvh", 3.7), bvh("torso.bvh", 20)
        pathlib.Path(torso).write_text(pathlib.Path(torso).read_text().replace("ROOT Hips", "ROOT Torso"))
        self.evaluate(truth, lower, "--metric", "mpjpe_root_mm")
        row, = self.rows()
        # Below the pelvis everything lies 37 mm too low; the other joints are right.
        self.assertIn(", root Hips, ", row["reason"])
        judged = int(row["reason"].split()[0])
        self.assertAlmostEqual(row["mpjpe_root_mm"], 37 * 8 / judged, 3)
        for answer in torso, self.trc_file("markers.trc", self.frames[:9]):
            out = self.folder / f"{answer}.out"
            self.evaluate(truth, answer, out=out)
            self.assertIn(", root midway between the hips" if answer == torso else ", root Hips of the truth, hip_centre of the answer",
                          self.rows(out)[0]["reason"])

    def test_files_that_state_their_times_are_judged_by_them(self):
        def from_ten(name, frames, late=0):  # like a program that keeps the take's clock
            path = self.trc_file(name, frames)
            head, body = path.read_text().split("\n\n")
            rows = [row.split("\t", 2) for row in body.splitlines()]
            path.write_text(head + "\n\n" + "".join(f"{n}\t{float(t) + 10 + late:.5f}\t{rest}\n" for n, t, rest in rows))
            return path
        truth = from_ten("t/clap.trc", self.frames)
        for name, answer, error, words in (
                ("cut", from_ten("cut.trc", self.frames[20:], 20 / 30), 0, "the answer begins at 10.667 s: judged by these clocks (--lag find searches the lag), 20 frames of"),
                ("bvh", self.shared / "clap.bvh", 1, "the truth begins at 10 s, the answer states no clock: their first frames"),
                ("same", from_ten("same.trc", self.frames), 0, "")):
            self.evaluate(truth, answer, out=self.folder / name)
            row, = self.rows(self.folder / name)
            self.assertLessEqual(row["mpjpe_unaligned_mm"], error + 1e-4, name)
            self.assertIn(words, row["reason"])
            self.assertEqual("begins" in row["reason"], words != "")

    def test_a_truth_whose_sides_are_exchanged_in_part_is_told(self):
        left, right = self.names.index("left_wrist"), self.names.index("right_wrist")
        frames = [list(frame) for frame in self.frames]
        for frame in frames[20:40]:
            frame[left], frame[right] = frame[right], frame[left]
        wrong = self.trc_file("wrong.trc", frames)
        for truth, answer, whose in ((wrong, self.shared / "clap.csv", "truth"), (self.shared / "clap.npz", wrong, "answer")):
            self.evaluate(truth, answer, out=self.folder / whose)
            doubts = self.rows(self.folder / whose)[0]["reason"].split(" · doubtful: ")[1:]
            told = next(doubt for doubt in doubts if "exchange" in doubt)
            self.assertEqual(told, f"the {whose}: left and right exchange positions from one frame to the next, 2 times (first at 0.67 s): "
                             "left_wrist – right_wrist")
        self.evaluate(self.shared / "clap.npz", self.shared / "clap.csv")
        self.assertNotIn("exchange", self.rows()[0]["reason"])

    def test_a_lag_is_found_and_both_are_judged(self):
        truth, answer = self.trc_file("truth.trc", self.frames), self.trc_file("late.trc", self.frames[2:])
        facts = self.facts("evaluate", truth, answer, "--lag", "find", "-o", self.out)
        self.assertEqual([method["condition"] for method in facts["methods"]], ["lag=none", "lag=find"])
        without, with_lag = self.rows()
        self.assertAlmostEqual(with_lag["lag_ms"], -2000 / 30, 2)
        self.assertIn("66.67 ms early (95 %", with_lag["reason"])
        self.assertLess(with_lag["mpjpe_unaligned_mm"], 0.1)
        self.assertGreater(without["mpjpe_unaligned_mm"], 5)
        self.assertIsNone(without["lag_ms"])

    def test_statistics_and_beats_are_kept_with_the_run(self):
        heading = ",".join(f"{name}_{axis}_m" for name in self.names for axis in "xyz")
        table = self.write("s.csv", f"{heading}\n" + ",".join(["0"] * 60) + "\n" + ",".join(["0.2"] * 60) + "\n")
        beats = self.write("b.txt", "".join(f"{0.4 * k}\n" for k in range(1, 20)))
        noisy = [[[x + 0.01 for x in p] for p in frame] for frame in self.frames]
        self.evaluate(self.shared / "clap.csv", self.trc_file("a.trc", noisy), "--statistics", table, "--music-beats", beats)
        row, = self.rows()
        given = {**self.given(noisy, self.frames, 30), "beats_s": [0.4 * k for k in range(1, 20)],
                 "statistics": [[[0, 0, 0], [0.2] * 3]] * 20}
        for name in "l2p@lafan1", "beat_alignment@bailando", "beat_alignment@mint":
            self.assertAlmostEqual(row[name], METRICS[name](given), 6, name)
        self.assertAlmostEqual(row["l2p@lafan1"], (60 * 0.05 ** 2) ** 0.5, 6)
        pathlib.Path(table).unlink()
        self.assertEqual(self.etude("replay", self.out).returncode, 0, "the manifest holds the texts")

    def test_angles_agree_between_files_of_one_skeleton(self):
        self.ends(0, "clip", "convert", "builtin:groove", self.folder / "groove.bvh")
        facts = self.facts("evaluate", self.folder / "groove.bvh", self.folder / "groove.bvh", "-o", self.out)
        self.assertGreater(len(facts["angles"]), 20)
        self.assertLess(max(angle["rmse_deg"]["value"] for angle in facts["angles"]), 1e-6)
        row, = self.rows()
        self.assertEqual([row[name] for name in ("l2q@lafan1", "npss@lafan1")], [0, 0])

    def test_errors_of_each_joint(self):
        def moved(joint, metres, until):
            return [[[x + metres * (name == joint and f < until), y, z] for name, (x, y, z) in zip(self.names, frame)]
                    for f, frame in enumerate(self.frames)]
        half = len(self.frames) // 2
        for name, answer in (("a", moved("left_wrist", 0.04, len(self.frames))), ("b", moved("left_wrist", 0.08, half)),
                             ("c", moved("head", 0.02, half))):
            self.trc_file(f"t/{name}.trc", self.frames)
            self.trc_file(f"m/{name}.trc", answer)
        self.trc_file("m/other.trc", self.frames)
        facts = self.facts("evaluate", self.folder / "t", f"m={self.folder}/m", "--by-joint", "-o", self.out)
        self.assertEqual(facts["left_out"], [f"{self.folder}/m/other.trc: no truth is named 'other'"])
        errors = {one["joint"]: one for one in facts["joints"]}
        self.assertEqual(len(errors), 20)
        for key in "pairs", "root_pairs", "each_frame_scaled_pairs":
            self.assertEqual({one[key] for one in errors.values()}, {3})
        for key in "unaligned_mm", "root_mm":
            self.assertAlmostEqual(errors["left_wrist"][key], (40 + 80 * half / len(self.frames) + 0) / 3, 3)
            self.assertAlmostEqual(errors["head"][key], 20 * half / len(self.frames) / 3, 3)
            self.assertAlmostEqual(errors["right_knee"][key], 0, 3)
        # The metric is the mean of its joints, after each alignment.
        means = {metric["metric"]: metric["mean"] for metric in facts["methods"][0]["metrics"]}
        for key, metric in (("unaligned_mm", "mpjpe_unaligned_mm"), ("root_mm", "mpjpe_root_mm"),
                            ("each_frame_scaled_mm", "mpjpe_each_frame_scaled_mm")):
            self.assertAlmostEqual(sum(one[key] for one in errors.values()) / 20, means[metric], 6, metric)
        printed = self.evaluate(self.folder / "t", f"m={self.folder}/m", "--by-joint", "--overwrite").stdout.splitlines()
        first = next(i for i, line in enumerate(printed) if "mean error of a joint" in line) + 1
        self.assertEqual(printed[first].split()[0::4], ["left_wrist", "3"])
        self.assertIn("--by-joint cannot be combined with --alone, because --alone uses no truth",
                      self.ends(2, "evaluate", "--alone", self.folder / "t", "--by-joint").stderr)

    def test_people_are_what_claims_beyond_the_files_count(self):
        for i, name in enumerate(("p1_a", "p1_b", "p2_a")):
            self.trc_file(f"t/{name}.trc", [[[x * (1 + i / 50), y, z] for x, y, z in frame] for frame in self.frames])
        self.evaluate(self.folder / "t", f"m={self.folder}/t", "--people", "{person}_*")
        self.assertEqual([row["units"] for row in self.rows()], [["p1"], ["p1"], ["p2"]])
        unit = lambda: json.loads((self.out / "summary.json").read_text())["scenarios"][0]["unit"]
        self.assertEqual(unit(), "recorded-person")
        self.ends(0, "verify", self.out)
        self.evaluate(self.folder / "t", f"m={self.folder}/t", "--overwrite")
        self.assertEqual(unit(), "clip", "the control: without people")

    def test_a_table_of_pairs_and_facts_for_programs(self):
        answer = self.trc_file("x.trc", [[[p[0], p[1] + 0.03, p[2]] for p in frame] for frame in self.frames])
        table = self.write("pairs.csv", f"name,truth,mine,none\nfirst,{self.shared}/clap.npz,{answer},\n"
                                        f"second,{self.shared}/clap.csv,{answer},{answer}\n")
        facts = json.loads(self.ends(1, "evaluate", "--pairs", table, "-o", self.out, "--json").stdout)  # one answer is missing
        medians = {(method["method"], metric["metric"]): metric["median"]
                   for method in facts["methods"] for metric in method["metrics"]}
        self.assertAlmostEqual(medians["mine", "mpjpe_unaligned_mm"], 30, 3)
        self.assertEqual([method["pairs_judged"] for method in facts["methods"]], [2, 1])
        self.assertEqual([line.split(":")[0] for line in facts["judged"]], ["mine, first", "mine, second", "none, second"],
                         "the two truths have different notes")
        self.assertEqual(facts["not_judged"], ["none, first: the method has no answer of this name"])

    def test_a_table_of_pairs_may_come_from_a_spreadsheet(self):
        truth, mine = self.shared / "clap.csv", self.shared / "clap.npz"
        table = self.folder / "pairs.csv"
        for i, text in enumerate(["\ufefftruth,mine\r\n{},{}\r\n", "truth;mine\n{};{}\n", '"truth","mine"\n"{}","{}"\n',
                                  "truth, mine\n{}, {}\n"]):
            table.write_text(text.format(truth, mine), encoding="utf-8")
            self.evaluate("--pairs", table, out=self.folder / f"out{i}")
            self.assertEqual([row["method"] for row in self.rows(self.folder / f"out{i}")], ["mine"])

    def test_doubts_of_the_reader_are_told_in_the_row_and_in_the_facts(self):
        truth = self.trc_file("truth/a.trc", self.frames)
        lying = self.trc_file("mine/a.trc", [[[x, -z, y] for x, y, z in frame] for frame in self.frames])
        done = self.evaluate(truth, f"mine={lying}", "--json")
        doubts = json.loads(done.stdout)["doubts"]
        self.assertEqual(len(doubts), 1, doubts)
        self.assertRegex(doubts[0], "^mine, a: the answer: .*along Z")
        self.assertIn(doubts[0], done.stderr)
        doubt = doubts[0].removeprefix("mine, a: ")
        row, = self.rows()
        self.assertTrue(row["reason"].endswith(" · doubtful: " + doubt), row["reason"])
        self.assertEqual(row["reason"].count("along Z"), 1, "a doubt is said once")

        # A doubtful truth is told once, not for each method.
        done = self.evaluate(lying, f"a={truth}", f"b={truth}", "--json", out=self.folder / "two")
        about_truth = [line for line in json.loads(done.stdout)["doubts"] if "the truth: " in line]
        self.assertEqual(about_truth, ["a: the truth: " + doubt.removeprefix("the answer: ")])

        done = self.evaluate("--alone", lying, "--json", out=self.folder / "alone")
        self.assertRegex(json.loads(done.stdout)["doubts"][0], "along Z")
        row, = self.rows(self.folder / "alone")
        self.assertIn(" · doubtful: ", row["reason"])

        late = self.trc_file("late/a.trc", self.frames[:1] * 10 + self.frames[:-10])
        done = self.evaluate(truth, f"late={late}", "--json", out=self.folder / "lag")
        self.assertRegex(json.loads(done.stdout)["doubts"][0], "^late, a: the answer seems to be 0.333 s late")

        near = self.trc_file("near/a.trc", [[[x + 0.001, y, z] for x, y, z in frame] for frame in self.frames])
        clean = self.evaluate(truth, f"a={near}", "--json", out=self.folder / "clean")
        self.assertEqual(json.loads(clean.stdout)["doubts"], [])

    def test_doubts_are_told_by_a_run_too(self):
        truth = self.trc_file("truth/a.trc", self.frames)
        lying = self.trc_file("mine/a.trc", [[[x, -z, y] for x, y, z in frame] for frame in self.frames])
        scenario = self.write("e.yaml", "scenario: e\nquestion: q?\ntask: evaluation\n"
                              f"truth: [{truth}]\nmethods: [{{name: mine, answers: [{lying}]}}]\n")
        done = self.ends(0, "run", scenario, "-o", self.out)
        self.assertRegex(done.stderr, "mine, a: the answer: .*along Z")
        self.assertIn(" · doubtful: the answer: ", self.rows()[0]["reason"])
        doubts = self.facts("run", scenario, "-o", self.out, "--overwrite")["doubts"]
        self.assertEqual(len(doubts), 1, doubts)
        self.assertRegex(doubts[0], "^mine, a: the answer: .*along Z")
        self.ends(0, "gate", self.out)
        self.assertRegex((self.out / "report/gate.md").read_text(), r"Doubts about the judged files \(these do not fail the gate\):\n\n- mine, a: the answer: .*along Z")

    def test_a_copy_of_the_truth_is_told(self):
        copy = self.folder / "mine.npz"
        shutil.copy(self.shared / "clap.npz", copy)
        self.evaluate(self.shared / "clap.npz", f"mine={copy}", f"near={self.trc_file('m.trc', self.frames)}")
        said = {row["method"]: row["reason"] for row in self.rows()}
        self.assertIn(" · doubtful: every position equals the truth's: is the answer a copy of the truth?", said["mine"])
        self.assertNotIn("copy", said["near"])

    def test_each_kind_of_note_is_said_once(self):
        bent = [frame[:] for frame in self.frames]
        head = self.names.index("head")
        for i, name in enumerate("abc"):  # three takes, because equal truths are one unit, which a note says
            take = [[[x * (1 + i / 50), y, z] for x, y, z in frame] for frame in bent]
            self.trc_file(f"t/{name}.trc", take)
            moved = [[[x, y + 0.1 * (j == head and name == "b"), z] for j, (x, y, z) in enumerate(frame)] for frame in take]
            self.trc_file(f"m/{name}.trc", moved[:-5] if name == "b" else moved)
        told = self.evaluate(self.folder / "t", f"m={self.folder}/m")
        said = told.stdout
        self.assertIn("m, a: 20 joints, root hip_centre", said)
        self.assertEqual(said.count("(and 1 similar)"), 1, said)
        self.assertIn("m, b: 20 joints, root hip_centre", said)
        self.assertIn("m, b: head 100 mm away from the truth in all frames", told.stderr)
        # The same holds for pairs that are not judged; programs get every line.
        for name in "abc":
            (self.folder / "m" / f"{name}.trc").write_text("no motion")
        facts = json.loads(self.ends(1, "evaluate", self.folder / "t", f"m={self.folder}/m", "-o", self.out, "--overwrite",
                                     "--json").stdout)
        self.assertEqual([line.split(":")[0] for line in facts["not_judged"]], ["m, a", "m, b", "m, c"])
        said = self.evaluate(self.folder / "t", f"m={self.folder}/m", "--overwrite", code=1).stdout
        self.assertIn("3 not judged:\n  m, a: ", said)
        self.assertIn("(and 2 similar)", said)
        self.assertNotIn("m, b:", said)

    def test_a_unit_is_that_of_all_files(self):
        shifted = [[[x + 0.01, y, z] for x, y, z in frame] for frame in self.frames]
        self.evaluate(self.trc_file("t.trc", self.frames), self.trc_file("m.trc", shifted), "--unit", "0.0009")
        self.assertAlmostEqual(self.rows()[0]["mpjpe_unaligned_mm"], 9, 6)

    def test_a_heading_without_truth_is_refused_with_its_columns(self):
        table = self.write("pairs.csv", f"Truth,mine\n{self.shared}/clap.npz,{self.shared}/clap.bvh\n")
        self.refusal("evaluate", "--pairs", table, "-o", self.out,
                     says=["has no column 'truth'; found the columns Truth, mine"])

    def test_markers_of_no_known_set_are_compared_by_their_names(self):
        odd = trc([f"Q{j}" for j in range(len(self.names))], self.frames, 30)
        truth, answer = self.write("truth.trc", odd), self.write("answer.trc", odd.replace("mine.trc", "other.trc"))
        said = self.evaluate(truth, answer, code=1).stdout
        self.assertIn("belong to no known marker set", said)
        self.assertIn("Give their roles in a joint map (--joint-map), or compare joints of equal names (--joints same)",
                      said)
        self.evaluate(truth, answer, "--joints", "same", "--overwrite")
        row, = self.rows()
        self.assertEqual((row["mpjpe_unaligned_mm"], row["seen_share"]), (0, 1))
        self.assertIsNone(row["mpjpe_root_mm"])
        # With a joint map, the same files have roles.
        roles = "".join(f"  {name}: Q{j}\n" for j, name in enumerate(self.names))
        self.evaluate(truth, answer, "--joint-map", self.write("map.yaml", "roles:\n" + roles), "--overwrite")
        row, = self.rows()
        self.assertEqual(row["mpjpe_root_mm"], 0)
        self.assertIn("20 joints, root Q", row["reason"])

    def test_a_run_is_an_answer_like_any_file(self):
        run = self.folder / "run"
        scenario = self.cut_scenario("builtin:sway", "builtin:clap", more="video: {}\n")
        self.run_suite(scenario, out=run)
        said = self.evaluate(f"{run}#t/-/000@cut", f"{run}#t/-/000@cut")
        row, = self.rows()
        self.assertEqual(row["mpjpe_unaligned_mm"], 0, said.stdout)

    def test_motions_of_an_evaluation_are_motions(self):
        noisy = [[[x + 0.01, y, z] for x, y, z in frame] for frame in self.frames]
        noisy[7][3] = None
        kept = self.folder / "kept"
        self.evaluate(self.shared / "clap.csv", self.trc_file("a.trc", noisy), "--keep", "motions", out=kept)
        first, = self.rows(kept)
        cell = f"{kept}#{first['scenario']}/-/000"
        self.evaluate(f"{cell}@truth", f"{cell}@answer")
        again, = self.rows()
        for metric in "mpjpe_unaligned_mm", "accel_error_mps2", "seen_share", "floating_mm":
            self.assertAlmostEqual(again[metric], first[metric], 9, metric)
        self.assertLess(first["seen_share"], 1)
        told = self.etude("clip", "info", f"{cell}/{first['method']}@answer", "--json")
        self.assertEqual([clip["frames"] for clip in json.loads(told.stdout)["clips"]], [len(noisy)], told.stderr)

    def test_pairs_are_read_and_written_as_motion_bids(self):
        truth, mine, kept = self.folder / "truth", self.folder / "mine", self.folder / "kept"
        for name in "clap", "sway":
            self.ends(0, "clip", "convert", f"builtin:{name}", f"{self.folder}/{name}/")
            shutil.copytree(self.folder / name, truth, dirs_exist_ok=True)
        # The same recordings by another tracking system, shifted by 1 cm.
        for path in (path for path in truth.rglob("*") if path.is_file()):
            copy = mine / path.relative_to(truth).parent / path.name.replace("tracksys-etude", "tracksys-imu")
            copy.parent.mkdir(parents=True, exist_ok=True)
            text = path.read_text()
            if path.name.endswith("_motion.tsv"):
                rows = [[float(cell) for cell in line.split("\t")] for line in text.splitlines()]
                text = "".join("\t".join(f"{x + 0.01 * (k % 3 == 0):.6f}" for k, x in enumerate(row)) + "\n" for row in rows)
            copy.write_text(text)
        self.evaluate(truth, f"imu={mine}", "--keep", "motions", out=kept)
        rows = self.rows(kept)
        self.assertEqual([row["clip"] for row in rows], ["sub-01_task-builtinclap", "sub-01_task-builtinsway"])
        for number, row in enumerate(rows):
            self.assertAlmostEqual(row["mpjpe_unaligned_mm"], 10, 2)
            again = self.folder / f"again{number}"
            self.ends(0, "clip", "convert", f"{kept}#{row['scenario']}/-/{number:03}@truth", f"{again}/")
            (read,), (written,) = (list(folder.rglob(f"{name}_motion.tsv")) for folder, name in ((truth, row["clip"] + "*"), (again, "*")))
            for line, other in zip(read.read_text().splitlines(), written.read_text().splitlines(), strict=True):
                for x, y in zip(line.split("\t"), other.split("\t"), strict=True):
                    self.assertAlmostEqual(float(x), float(y), delta=1.1e-6)

    def test_the_page_shows_it(self):
        self.evaluate(self.shared / "clap.csv", self.shared / "clap.npz")
        self.assertEqual(self.etude("report", self.out).returncode, 0)
        page = (self.out / "report" / "index.html").read_text()
        self.assertIn("joint error, root-aligned", page)

    def test_bad_input_is_one_line(self):
        a = self.trc_file("a.trc", self.frames)
        scenario = self.write("s.yaml", f"scenario: s\nquestion: q\ntask: evaluation\ntruth: ['{a}']\n"
                                        f"methods: [{{name: m, answers: ['{a}']}}]\n")
        outside = self.write("o.yaml", f"scenario: s\nquestion: q\ntask: evaluation\ntruth: ['{a}']\n"
                                       "methods: [{name: m, exec: [python3, x.py]}]\n")
        keys = self.write("key", "0" * 64)
        pathlib.Path(keys).chmod(0o600)
        for arguments, words in [
                (["evaluate", a], "needs a truth and results"),
                (["evaluate", a, a, a], "allowed if there are several results"),
                (["evaluate", self.folder / "none*", a], "the truth: no clip matches"),
                (["evaluate", a, self.folder / "none*"], "the results: no clip matches"),
                (["evaluate", a, a, "--people", "x"], "--people: the pattern 'x' does not match the name 'a'"),
                (["check-method", "--", "python3", "x.py"], "--task is required"),
                (["evaluate", a, a, "--joints", "all"], "'all'"),
                (["evaluate", a, a, "--statistics", self.write("s.csv", "x\n1\n2\n"), "-o", self.out], "s.csv:1"),
                (["evaluate", a, a, "--music-beats", self.write("b.txt", "2\n1\n"), "-o", self.out], "b.txt:2"),
                (["evaluate", a, a, "--metric", "mpjpe"], "unknown metric of task evaluation 'mpjpe'"),
                (["evaluate", "--pairs", self.write("p.csv", "truth\n"), "-o", self.out], "has no column for a method"),
                (["export", scenario, "-o", self.out], "so it has no problems to export"),
                (["score", scenario, self.folder, "--name", "x", "-o", self.out], "so it has no problems to export"),
                (["run", scenario, "--seed-file", keys], "judges files and uses no random numbers"),
                (["run", outside], "'exec' is not allowed in task evaluation, because this task runs no programs"),
                (["check-method", "--task", "evaluation", "--", "python3", self.write("x.py", "")],
                 "task evaluation runs no programs\n")]:
            with self.subTest(words=words, command=arguments[0]):
                told = self.ends(2, *arguments)
                self.assertIn(words, told.stderr)
                self.assertEqual(told.stderr.count("\n"), 1, told.stderr)


if __name__ == "__main__":
    import unittest
    unittest.main()

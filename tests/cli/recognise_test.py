"""Tests etude teach and etude recognise: moves are learnt from recordings, and recognised in other recordings, live
and stored."""
import json
import re
import subprocess
import unittest

from etude_case import ETUDE, EtudeCase
from kinect_rows import arms, kinect


def turned(rows, turn):
    """Returns rows of a Kinect that is turned about its line of sight."""
    def of(row):
        v = [float(word) for word in row.split()]
        return " ".join(f"{c:.6f}" for i in range(0, len(v), 3) for c in (*turn(v[i], v[i + 1]), v[i + 2]))
    return "\n".join(of(row) for row in rows.splitlines()) + "\n"


class Recognise(EtudeCase):
    def teach(self, *arguments):
        self.ends(0, "teach", *arguments, "-o", self.folder / "moves.yaml", "--overwrite")
        return self.folder / "moves.yaml"

    def events(self, *arguments, stdin=None):
        """Returns the spotted moves, by key poses by default, because the other recognisers are made for people, not
        stick figures."""
        if "--recogniser" not in arguments:
            arguments += ("--recogniser", "key-pose")
        result = subprocess.run([ETUDE, "recognise", *map(str, arguments)], capture_output=True, text=True, timeout=120,
                                input=stdin)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [json.loads(line) for line in result.stdout.splitlines()]

    def refusal(self, *arguments, stdin=None):
        result = subprocess.run([ETUDE, *map(str, arguments)], capture_output=True, text=True, timeout=120, input=stdin)
        self.assertEqual(result.returncode, 2, result.stdout)
        complaint = [line for line in result.stderr.splitlines() if line.startswith("etude")]
        self.assertEqual(len(complaint), 1, result.stderr)
        return complaint[0]

    def two_moves(self):
        raised = self.write("raise.txt", kinect(arms(100)))
        left = self.write("left.txt", kinect(arms(100, both=False)))
        return self.teach(raised, left)

    def test_what_was_taught_is_found_in_another_recording(self):
        moves = self.two_moves()
        both = arms(95, 2.5) + arms(104, 1.6, both=False)
        take = self.write("take.txt", kinect(both, tilt=.2))
        for recogniser in ("key-pose", "fuzzy-rules", "dtw"):
            found = [event["move"] for event in self.events(take, "--moves", moves, "--recogniser", recogniser)]
            self.assertEqual(found, ["raise", "left"], recogniser)
        self.assertEqual(self.events(self.write("half.txt", kinect(arms(40))), "--moves", moves), [])
        for still, stdin in ((self.folder / "half.txt", None), ("-", kinect(arms(40)))):
            silent = subprocess.run([ETUDE, "recognise", still, "--moves", moves, "--recogniser", "key-pose"],
                                    capture_output=True, text=True, timeout=120, input=stdin)
            self.assertIn("no move was recognised\n", silent.stderr)
        self.assertNotIn("no move", self.etude("recognise", take, "--moves", moves, "--recogniser", "key-pose").stderr)

    def test_live_says_the_same_as_recorded(self):
        moves = self.two_moves()
        text = kinect(arms(95) + arms(100, both=False))
        for recogniser, count in ((["--recogniser", "learnt"], 3), (["--recogniser", "key-pose"], 2)):
            recorded = self.events(self.write("take.txt", text), "--moves", moves, *recogniser)
            self.assertEqual(self.events("-", "--moves", moves, *recogniser, stdin=text), recorded)
            self.assertEqual(len(recorded), count)

    def test_the_default_is_the_recogniser_recommended_for_what_was_taught(self):
        moves = self.two_moves()
        take = self.write("take.txt", kinect(arms(95) + arms(100, both=False)))
        def told(*arguments):
            return self.etude("recognise", take, "--moves", *arguments)
        default, learnt = told(moves), told(moves, "--recogniser", "learnt")
        self.assertEqual((default.returncode, default.stdout), (0, learnt.stdout))
        self.assertIn("using the recogniser learnt, which is recommended for these moves; --recogniser selects another recogniser\n", default.stderr)
        self.assertNotIn("recommended", learnt.stderr)
        # Three examples of each move show how people differ.
        several = self.teach(self.write("three.txt", kinect(3 * arms(100))), "--labels",
                             self.write("three.csv", "clip,from_s,to_s,move,truth\n" + "".join(
                                 f"three,{3 * i},{3 * i + 3},raise,right\n" for i in range(3))))
        self.assertIn("using the recogniser whole-body, which is recommended for these moves; --recogniser selects another recogniser\n", told(several).stderr)
        self.assertEqual(re.search(r"span_s: (\S+)", several.read_text())[1], "3.9")
        # Moves that have key poses but no examples cannot be learnt.
        poses = re.sub(r"(?m)^    right:\n(      .*\n|        .*\n)*", "    right: []\n", moves.read_text())
        written = self.write("poses.yaml", poses)
        default, paper = told(written), told(written, "--recogniser", "key-pose")
        self.assertEqual((default.returncode, default.stdout), (0, paper.stdout), default.stderr)
        self.assertIn("using the recogniser key-pose, which is recommended for these moves", default.stderr)

    def test_a_move_may_be_left_out(self):
        raised, left = self.write("raise.txt", kinect(arms(100))), self.write("left.txt", kinect(arms(100, both=False)))
        moves = self.teach(raised, left, "--without", "left")
        self.assertNotIn("'left'", moves.read_text())
        self.assertIn("name: 'raise'", moves.read_text())
        self.assertIn("etude: --without: unknown move 'lift'; did you mean 'left'? Allowed: left, raise", self.refusal("teach", raised, left, "--without", "lift", "-o",
                                                                     self.folder / "no.yaml"))
        self.assertIn("no recording shows a right performance", self.refusal("teach", raised, "--without", "raise", "-o", self.folder / "no.yaml"))
        self.assertFalse((self.folder / "no.yaml").exists())

    def test_a_sensor_in_portrait_or_upside_down_is_turned_back_and_that_is_said(self):
        moves = self.two_moves()
        upright = kinect(arms(95) + arms(100, both=False))
        wanted = self.events(self.write("take.txt", upright), "--moves", moves)
        self.assertEqual(len(wanted), 2)
        for name, turn in {"portrait": lambda x, y: (-y, x), "other way": lambda x, y: (y, -x), "below": lambda x, y: (-x, -y)}.items():
            text = turned(upright, turn)
            file = self.write(f"{name}.txt", text)
            for arguments, stdin in (([file], None), (["-"], text)):
                result = subprocess.run([ETUDE, "recognise", *arguments, "--moves", moves, "--recogniser", "key-pose"], capture_output=True, text=True,
                                        timeout=120, input=stdin)
                found = [json.loads(line) for line in result.stdout.splitlines()]
                self.assertEqual([(e["move"], e["frame"]) for e in found], [(e["move"], e["frame"]) for e in wanted], name)
                self.assertRegex(result.stderr, r"the sensor was rotated by (90|180|270) degrees, and Etude rotated the positions back \(--level none keeps the rotation\)")
            self.assertNotIn("rotated", self.etude("recognise", file, "--moves", moves, "--level", "none").stderr)
            self.assertIn("rotated the positions back", self.etude("teach", file, "-o", self.folder / "again.yaml", "--overwrite").stderr)
            v2 = [row.split() for row in text.splitlines()]
            sheet = self.write("v2.txt", "\n".join(" ".join(row + row[6:9] + 4 * row[21:24]) for row in v2) + "\n")
            self.assertRegex(self.etude("sensor", "stats", sheet).stdout, r"; the sensor is rotated by (90|180|270) degrees")

    def test_labels_tell_moves_apart_within_a_recording_and_score(self):
        poses = arms(100) + arms(100, both=False) + arms(100) + arms(30)
        take = self.write("take.txt", kinect(poses))
        labels = self.write("labels.csv", "clip,from_s,to_s,move,truth\n"
                            "take,0,3,raise,right\ntake,3,6,left,right\ntake,6,9,raise,right\ntake,9,12,raise,small\n")
        moves = self.teach(take, "--labels", labels)
        self.assertIn("name: 'raise'", moves.read_text())
        taught = self.facts("teach", take, "--labels", labels, "-o", moves, "--overwrite")["moves"]
        self.assertEqual({(move["move"], move["right"], move["wrong"]) for move in taught}, {("raise", 2, 1), ("left", 1, 0)})
        lines = self.events(take, "--moves", moves, "--labels", labels, "--json")
        self.assertEqual(list(lines[-1]), ["command", "etude", "scores"])
        scores = lines[-1]["scores"]
        self.assertEqual(scores["performances"], 4)
        self.assertEqual(scores["f1"], 1)
        def told(rows):
            path = self.write("some.csv", "clip,from_s,to_s,move,truth\n" + rows)
            return self.ends(0, "recognise", take, "--moves", moves, "--labels", path, "--recogniser", "key-pose").stderr
        right = "take,0,3,raise,right\ntake,3,6,left,right\n"
        self.assertIn("\n2 performances; according to the labels, all are right; the recogniser judged 2 right\n", told(right))
        self.assertNotIn("F1", told(right), "without a wrong performance it would say nothing")
        mixed = told(right + "take,9,12,raise,rihgt\ntaek,0,1,left,right\n")
        self.assertIn("F1 100.0 %, precision 100.0 %, recall 100.0 %, AUC 100.0 %", mixed)
        self.assertIn("truth: right 2, rihgt 1 (Etude reads this as a fault; did you mean right?)\n", mixed)
        self.assertIn("some.csv:5: no recording taek is given\n", mixed)
        self.assertEqual(scores["false_alarms_per_min"], 0)

    def test_one_motion_counts_once_and_scores_of_what_was_taught_are_no_test(self):
        take = self.write("take.txt", kinect(arms(100) + arms(100, both=False) + arms(30)))
        other = self.write("other.txt", kinect(arms(92, 1.7) + arms(96, 2.2, both=False)))
        rows = "{0},0,3,raise,right\n{0},3,6,left,right\n"
        labels = self.write("labels.csv", "clip,from_s,to_s,move,truth\n" + rows.format("take") + "take,6,9,raise,small\n")
        told = self.facts("teach", take, take, "--labels", labels, "-o", self.folder / "moves.yaml")
        self.assertEqual({(move["move"], move["right"], move["wrong"]) for move in told["moves"]}, {("raise", 1, 1), ("left", 1, 0)})
        copy = self.write("copy.txt", (self.folder / "take.txt").read_text())
        self.assertEqual(told, {**self.facts("teach", take, "--labels", labels, "-o", self.folder / "one.yaml"),
                                "output": told["output"]})
        again = self.ends(0, "teach", take, copy, "--labels", labels, "-o", self.folder / "again.yaml")
        self.assertIn(f"left out: {copy}: shows the same motion as {take}\n", again.stderr)
        self.assertEqual((self.folder / "again.yaml").read_text(), (self.folder / "moves.yaml").read_text())
        self.assertIn("copy.txt: shows the same motion as", self.refusal("teach", take, copy, "-o", self.folder / "two.yaml"))

        def scores(*takes):
            lines = self.write("some.csv", "clip,from_s,to_s,move,truth\n" + "".join(rows.format(name.split("/")[-1][:-4]) for name in takes))
            return self.ends(0, "recognise", *takes, "--moves", self.folder / "moves.yaml", "--labels", lines).stderr
        self.assertIn("\nthese moves were taught with 2 of the 4 performances, so ", scores(take, other))
        self.assertNotIn("were taught with", scores(other))
        people = self.write("people.csv", "clip,from_s,to_s,move,truth,person\ntake,0,3,raise,right,anna\nother,0,3,raise,right,bo\n"
                            "copy,0,3,raise,right,cy\n")
        self.assertIn("but names the person", self.refusal("recognise", take, other, copy, "--labels", people, "--leave-one-person-out"))

    def test_recordings_of_one_name_are_told_by_their_files(self):
        takes = []
        for person in ("anna", "bo"):
            (self.folder / person).mkdir()
            takes.append(self.write(f"{person}/take1.txt", kinect(arms(100 if person == "bo" else 93))))
        moves = self.teach(self.write("raise.txt", kinect(arms(97))))
        self.assertEqual([line["stream"] for line in self.events(*takes, "--moves", moves)], [str(take) for take in takes])

    def test_one_person_left_out(self):
        labels = "clip,from_s,to_s,move,truth,person\n"
        folder = self.folder / "takes"
        folder.mkdir()
        for i, person in enumerate(("anna", "bo", "cy")):
            (folder / f"{person}.txt").write_text(kinect(arms(92 + 6 * i, 1.6 + .4 * i) + arms(98 - 5 * i, both=False)))
            end = 2.6 + .4 * i
            labels += f"{person},0,{end},raise,right,{person}\n{person},{end},{end + 3},left,right,{person}\n"
        path = self.write("labels.csv", labels)
        (folder / "README.txt").write_text("no recording\n")
        scores = self.facts("recognise", folder, "--labels", path, "--leave-one-person-out", "--recogniser", "dtw")["scores"]
        self.assertEqual((scores["people"], scores["performances"]), (3, 6))
        self.assertEqual((scores["accuracy"], scores["nearest_accuracy"]), (1, 1))
        spelt = self.write("spelt.csv", labels.replace("left,right,bo", "left,right,Bo"))
        self.assertEqual(self.facts("recognise", folder, "--labels", spelt, "--leave-one-person-out", "--recogniser", "dtw")["scores"], scores)
        unnamed = self.write("unnamed.csv", labels.replace(",person\n", "\n").replace(",anna\n", "\n"))
        self.assertIn("the person in the recording anna is unknown", self.refusal("recognise", folder, "--labels", unnamed,
                                                              "--leave-one-person-out"))

    def test_odd_recordings_give_a_result_or_one_line(self):
        moves = self.two_moves()
        rows = kinect(arms(95)).splitlines()
        half = self.write("half.txt", "\n".join(rows[::2]) + "\n")
        self.assertEqual(len(self.events(half, "--moves", moves, "--rate", "15")), 1)
        clocked = [f"{t} {row}" for t, row in enumerate(rows)]
        lost = self.write("lost.txt", "\n".join(clocked[:20] + clocked[24:]) + "\n")
        self.assertEqual(len(self.events(lost, "--moves", moves)), 1)
        gaps = [" ".join(["nan"] * 9 + row.split()[9:]) if t % 7 == 0 else row for t, row in enumerate(rows)]
        self.assertEqual(len(self.events(self.write("nan.txt", "\n".join(gaps)), "--moves", moves)), 1)
        fewer = self.write("fewer.txt", "\n".join(" ".join(row.split()[:-3]) for row in rows))
        self.assertIn("57 numbers in the first row", self.refusal("recognise", fewer, "--moves", moves))
        # A damaged row of a live stream costs only itself.
        damaged = subprocess.run([ETUDE, "recognise", "-", "--moves", moves, "--recogniser", "key-pose"], text=True, timeout=120,
                                 capture_output=True, input="\n".join(rows[:40] + ["x " * 60] + rows[40:]) + "\n")
        self.assertEqual((damaged.returncode, len(damaged.stdout.splitlines())), (0, 1), damaged.stderr)
        self.assertIn("line 41: value 1: found 'x'; allowed: a number within", damaged.stderr)
        self.assertIn("Etude leaves out this row", damaged.stderr)
        self.assertIn("none.txt: no such recording", self.refusal("recognise", "none.txt", "--moves", moves))
        self.assertIn("--moves: is missing", self.refusal("recognise", half))
        self.assertIn("no such file", self.refusal("recognise", half, "--moves", self.folder / "none.yaml"))


if __name__ == "__main__":
    unittest.main()

"""Tests etude run on recordings of people instead of simulated people."""
import json
import pathlib
import unittest

from etude_case import IK, SHARED, EtudeCase, heavy
from kinect_rows import arms, kinect

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = """scenario: recorded
question: Who is recognised by what the others did?
task: detection
trials: 40
methods:
  - {name: dtw, recogniser: dtw}
  - {name: nearest, recogniser: nearest, against: dtw}
metrics: [move_named, f1, recall]
"""
PEOPLE = ("anna", "bo", "cy", "di")


class Streams(EtudeCase):
    def record(self, change=lambda person, rows: rows):
        """Records four people who raise both arms, the left arm, and both arms half-way, which is wrong; also writes
        the labels."""
        takes = self.folder / "takes"
        takes.mkdir()
        labels = "clip,from_s,to_s,move,truth,person\n"
        for i, person in enumerate(PEOPLE):
            high, low = 2 + .2 * i, 1.6 + .3 * i
            poses = arms(92 + 4 * i, high) + arms(98 - 4 * i, low, both=False) + arms(35 + 3 * i, high)
            (takes / f"{person}.txt").write_text("\n".join(change(person, kinect(poses).splitlines())) + "\n")
            ends = [high + 1, high + low + 2, 2 * high + low + 3]
            labels += f"{person},0,{ends[0]},raise,right,{person}\n{person},{ends[0]},{ends[1]},left,right,{person}\n"
            labels += f"{person},{ends[1]},{ends[2]},raise,half,{person}\n"
        return takes, self.write("labels.csv", labels)

    def refusal(self, *arguments):
        result = self.ends(2, *arguments)
        complaint = [line for line in result.stderr.splitlines() if line.startswith("etude")]
        self.assertEqual(len(complaint), 1, result.stderr)
        self.assertFalse(self.out.exists())
        return complaint[0]

    @heavy
    def test_a_program_is_taught_by_the_others_as_built_in_recognisers_are(self):
        takes, labels = self.record()
        example, probe = ROOT / "examples/outside-methods/detection_correlation.py", ROOT / "tests/support/wire_probe.py"
        command = ["/usr/bin/python3", probe, "detection", "-", "/usr/bin/python3", example]
        told = self.ends(0, "check-method", "--no-fence", "--task", "detection", "--streams", takes, "--labels", labels, "--", *command)
        self.assertIn("9 of 9 checks passed", told.stdout)
        keeper = self.write("keeper.py", "import json, os, sys, etude\n\n@etude.method(task='detection')\nclass Keeper:\n"
                                         "    def __init__(self, setting):\n        self.moves = setting.moves\n\n"
                                         "    def answer(self, problem):\n"
                                         "        print(json.dumps({'judged': problem.person, 'taught': {move.name: [\n"
                                         "            [one.person, one.is_right, one.fault, len(one.frames)] for one in move.examples]\n"
                                         "            for move in self.moves}}), file=sys.stderr)\n"
                                         "        raise etude.NoAnswer('only looks')\n\netude.serve(Keeper)\n")
        method = "  - {{name: {}, exec: [/usr/bin/python3, {}]}}\n"
        scenario = self.write("own.yaml", SCENARIO.replace("metrics:", method.format("own", example) + method.format("keeper", keeper) + "metrics:"))
        rows = self.run_suite(scenario, "--streams", takes, "--labels", labels, "--jobs", 2, code=1)  # keeper has no answer
        own = [row for row in rows if row["method"] == "own"]
        self.assertEqual([row["status"] for row in own], ["ok"] * 4, own)
        self.assertGreater(sum(row["recall"] for row in own) / 4, 0.5, "what the others did looks like it")
        seen = [json.loads(line) for line in (self.out / "stderr" / "recorded~keeper.txt").read_text().splitlines()]
        self.assertEqual(sorted(one["judged"] for one in seen), list(PEOPLE))
        for one in seen:
            others = [person for person in PEOPLE if person != one["judged"]]
            self.assertEqual([example[:3] for example in one["taught"]["raise"]],
                             [[person, right, fault] for person in others for right, fault in ((True, ""), (False, "half"))])
            self.assertEqual([example[0] for example in one["taught"]["left"]], others)
        self.assertIn("task ik uses no recordings",
                      self.etude("check-method", "--task", "ik", "--streams", takes, "--", "true").stderr)

    @heavy
    def test_recorded_people_are_worlds_judged_as_recognise_judges_them(self):
        takes, labels = self.record()
        scenario = self.write("recorded.yaml", SCENARIO)
        rows = self.run_suite(scenario, "--streams", takes, "--labels", labels)
        self.assertEqual([row["clip"] for row in rows if row["method"] == "dtw"], list(PEOPLE))
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        for method in ("dtw", "nearest"):
            own = [row["move_named"] for row in rows if row["method"] == method]
            told = self.etude("recognise", takes, "--labels", labels, "--leave-one-person-out", "--recogniser", method,
                              "--json")
            scores = json.loads(told.stdout.splitlines()[-1])["scores"]
            self.assertEqual(scores["performances"], 8, "two right ones each")
            self.assertAlmostEqual(sum(own) / 4, scores["accuracy"], places=4)
        self.assertEqual(json.loads((self.out / "summary.json").read_text())["scenarios"][0]["unit"], "person")
        self.ends(0, "report", self.out, "--no-video")
        page = (self.out / "report" / "index.html").read_text()
        self.assertIn("that nearest recognised as another move", page)
        # The run is repeated from its manifest and in shards, with the same results. The replay of a packed cell
        # needs no recording.
        again = self.folder / "again"
        self.ends(0, "run", "--from", self.out / "manifest.json", "-o", again)
        self.assert_same(again)
        shards = [self.folder / f"shard-{i}" for i in (1, 2)]
        for i, shard in enumerate(shards, 1):
            self.etude("run", scenario, "--streams", takes, "--labels", labels, "--shard", f"{i}/2", "-o", shard)
        merged = self.folder / "merged"
        self.ends(0, "merge", *shards, "-o", merged)
        self.assert_same(merged)
        pack = self.folder / "cell.pack"
        self.ends(0, "replay", self.out, "--cell", rows[0]["cell"], "--pack", pack)
        for take in takes.iterdir():
            take.unlink()
        self.ends(0, "replay", pack)
        gone = self.ends(2, "run", "--from", self.out / "manifest.json", "-o", self.folder / "gone")
        self.assertIn("no recordings of skeletons", gone.stderr)

    def assert_same(self, folder):
        for name in SHARED:
            one, other = self.out / name, folder / name
            files = [one] if one.is_file() else sorted(p for p in one.rglob("*") if p.is_file()) if one.exists() else []
            for file in files:
                same = file.read_bytes() == (other if one.is_file() else other / file.relative_to(one)).read_bytes()
                self.assertTrue(same, file)

    def test_odd_recordings_give_a_result_or_one_line(self):
        def mirrored(rows):
            flip = lambda row: " ".join(str(-float(v)) if i % 3 == 0 else v for i, v in enumerate(row.split()))
            return [flip(row) for row in rows]
        odd = {"anna": lambda rows: rows, "bo": mirrored,
               "cy": lambda rows: rows[:30] + rows[36:],  # lost frames
               "di": lambda rows: [" ".join(["nan"] * 9 + row.split()[9:]) if t % 7 == 0 else row
                                   for t, row in enumerate(rows)]}
        takes, labels = self.record(lambda person, rows: odd[person](rows))
        scenario = self.write("recorded.yaml", SCENARIO)
        rows = self.run_suite(scenario, "--streams", takes, "--labels", labels)
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        named = {row["clip"]: row["move_named"] for row in rows if row["method"] == "dtw"}
        self.assertEqual(named["anna"], 1)
        # At 15 Hz the file has no clock, so the scenario states the rate.
        for take in takes.iterdir():
            lines = take.read_text().splitlines()
            take.write_text("\n".join(lines[::2]) + "\n")
        half = self.write("half.yaml", SCENARIO + f"streams: ['{takes}']\nlabels: {labels}\nreading: {{rate_hz: 15}}\n")
        self.assertEqual([row["status"] for row in self.run_suite(half, out=self.folder / "half")], ["ok"] * 8)
        # A take of a folder that cannot be read is left out; the run reports it and its manifest keeps it.
        (takes / "eve.txt").write_text("\n".join((takes / "anna.txt").read_text().splitlines()[:9] + ["0 1 left"]) + "\n")
        told = self.ends(0, "run", half, "-o", self.folder / "told")
        self.assertIn("eve.txt: was left out: ", told.stderr)
        manifest = json.loads((self.folder / "told" / "manifest.json").read_text())
        self.assertEqual([one["clip"] for one in manifest["scenarios"][0]["refused"]], [str(takes / "eve.txt")])
        self.assertEqual((self.folder / "told" / "cells.jsonl").read_bytes(), (self.folder / "half" / "cells.jsonl").read_bytes())
        (takes / "eve.txt").unlink()
        # A copy under a name without labels is left out; under another person's name it is refused.
        (takes / "fay.txt").write_text((takes / "anna.txt").read_text())
        told = self.ends(0, "run", half, "-o", self.folder / "copied")
        self.assertIn(f"fay.txt: was left out: shows the same motion as {takes / 'anna.txt'}", told.stderr)
        self.assertEqual((self.folder / "copied" / "cells.jsonl").read_bytes(), (self.folder / "half" / "cells.jsonl").read_bytes())
        named = self.write("named.csv", (self.folder / "labels.csv").read_text() + "fay,0,3,raise,right,fay\n")
        self.out = self.folder / "none"
        self.assertIn("fay.txt: shows the same motion as", self.refusal("run", self.write(
            "fay.yaml", (self.folder / "half.yaml").read_text().replace(labels, named)), "-o", self.out))
        (takes / "fay.txt").unlink()
        # A truncated take, with labels beyond its end.
        (takes / "anna.txt").write_text("\n".join((takes / "anna.txt").read_text().splitlines()[:20]) + "\n")
        self.out = self.folder / "none"
        self.assertIn("allowed: labels within the recording", self.refusal("run", half, "-o", self.out))

    def test_what_cannot_be_is_refused_in_one_line(self):
        takes, labels = self.record()
        scenario = self.write("recorded.yaml", SCENARIO)

        def refused(*arguments):
            return self.refusal("run", *arguments, "-o", self.out)
        self.assertIn("none: no such recording", refused(scenario, "--streams", "none"))
        self.assertIn("no such file", refused(scenario, "--streams", takes, "--labels", "none.csv"))
        self.assertIn("no scenario has a task that makes worlds from recordings",
                      refused(self.write("ik.yaml", IK), "--streams", takes))
        noisy = self.write("noisy.yaml", SCENARIO + "noise: 2\n")
        self.assertIn("'noise' cannot be used here", refused(noisy, "--streams", takes, "--labels", labels))
        alone = self.write("alone.csv", "clip,from_s,to_s,move,truth,person\nanna,0,3,raise,right,anna\n")
        self.assertIn("anna is the only recorded person; needed: at least two people",
                      refused(scenario, "--streams", takes / "anna.txt", "--labels", alone))
        both = self.write("both.yaml", SCENARIO + f"streams: ['{takes}']\nclips: ['builtin:*']\n")
        self.assertIn("'streams' replaces 'clips'", refused(both))
        fewer = takes / "fewer.txt"
        fewer.write_text("\n".join(" ".join(row.split()[:-3]) for row in (takes / "bo.txt").read_text().splitlines()))
        self.assertIn("57 numbers in the first row", refused(scenario, "--streams", fewer, "--labels", labels))

    def test_moves_taught_beforehand_judge_one_person(self):
        takes, labels = self.record()
        moves = self.folder / "moves.yaml"
        self.ends(0, "teach", takes / "anna.txt", takes / "bo.txt", "--labels", labels, "-o", moves)
        scenario = self.write("taught.yaml", SCENARIO + f"moves: {moves}\nlabels: {labels}\nstreams: ['{takes}/d*.txt']\n")
        rows = self.run_suite(scenario)
        self.assertEqual([(row["clip"], row["method"]) for row in rows], [("di", "dtw"), ("di", "nearest")])
        self.assertEqual(rows[0]["move_named"], 1)

    def test_clips_with_labels_are_danced_before_a_simulated_sensor(self):
        clips = []
        labels = "clip,from_s,to_s,move,truth,person\n"
        for move in ("clap", "boxing", "robot"):
            for person in ("anna", "bo"):
                path = self.folder / f"{person}_{move}.bvh"
                begin = 0 if person == "anna" else 0.1  # equal motions of two people would be refused
                self.ends(0, "clip", "convert", f"builtin:{move}", path, "--trim", f"{begin}:")
                clips.append(path)
                labels += f"{person}_{move},,,{move},right,{person}\n"
        path = self.write("labels.csv", labels)
        scenario = self.write("clips.yaml", SCENARIO + "noise: 0.5\nsensor: v1\n")
        self.ends(0, "run", scenario, "--clips", *clips, "--labels", path, "-o", self.out)
        rows = [json.loads(line) for line in (self.out / "cells.jsonl").read_text().splitlines()]
        self.assertEqual([row["clip"] for row in rows if row["method"] == "dtw"], ["anna", "bo"])
        self.assertEqual([row["move_named"] for row in rows if row["method"] == "dtw"], [1, 1])
        # Streams already went through a sensor, so a condition of the simulated sensor is refused.
        self.out = self.folder / "as-streams"
        self.assertIn("'noise' cannot be used here", self.refusal("run", scenario, "--streams", *clips, "--labels", path,
                                                              "-o", self.out))


if __name__ == "__main__":
    unittest.main()

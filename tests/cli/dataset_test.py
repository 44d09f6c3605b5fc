"""Tests export and scoring of data sets: the truth scores perfectly, other answers do not, and incomplete answers
are refused."""
import csv
import json
import shutil
import subprocess
import unittest

from etude_case import IK, EtudeCase, heavy, png_size

FILM = """scenario: film
question: Can others read it?
task: capture
clips: ['builtin:boxing']
duration_s: 0.2
trials: 1
methods:
  - {name: keypoints, recovery: keypoints}
"""


class DataSets(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Exports each scenario, and turns the truth into answers, once for all tests."""
        cls.shared = cls.shared_folder()
        cls.index = cls.export("ik", IK)
        cls.export("film", FILM, "--depth")

    @classmethod
    def export(cls, name, text, *more):
        folder = cls.shared / name
        folder.mkdir()
        (folder / f"{name}.yaml").write_text(text)
        result = cls.etude("export", folder / f"{name}.yaml", *more, "-o", folder / "data")
        assert result.returncode == 0, result.stderr
        data, answers = folder / "data", folder / "answers"
        with open(data / "inputs" / "index.csv", newline="") as file:
            index = list(csv.DictReader(file))
        for line in index:
            assert (data / "inputs" / line["problem"]).exists(), line
            world = line["prediction"].removesuffix(".json")
            truth = json.loads((data / "truth" / world / "truth.json").read_text())
            truth.pop("labels", None)
            path = answers / line["prediction"]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(json.dumps(truth))
        return index

    def test_a_clips_name_is_no_formula_to_a_spreadsheet(self):
        shutil.copy("/usr/share/assimp/models/BVH/01_03.bvh", self.folder / "=cmd|' !A0.bvh")
        scenario = self.cut_scenario(self.folder / "*.bvh", "builtin:sway", trials=2)
        self.assertEqual(self.etude("export", scenario, "-o", self.folder / "data").returncode, 0)
        with open(self.folder / "data" / "inputs" / "index.csv", newline="") as file:
            self.assertEqual([line["clip"] for line in csv.DictReader(file)], ["'=cmd|' !A0", "builtin:sway"])

    def test_clips_are_of_the_rate_that_is_told_and_a_data_set_keeps_it(self):
        clip = "/usr/share/assimp/models/BVH/01_03.bvh"  # 120 Hz
        scenario = self.write("t.yaml", f"scenario: t\nquestion: q\ntask: tracking\nclips: ['{clip}']\ntrials: 1\n"
                                        "methods: [{name: a, solver: ccd, weights: fixed}]\n")
        data = self.folder / "told"
        self.assertEqual(self.etude("export", scenario, "--rate", 60, "-o", data).returncode, 0)
        own = json.loads(self.etude("clip", "info", clip, "--json").stdout)["clips"][0]["frames"]
        frames = json.loads((data / "manifest.json").read_text())["scenarios"][0]["loaded_clips"][0]["frames"]
        self.assertAlmostEqual(frames / (own * 30 / 120), 2, places=1)
        with open(data / "inputs/index.csv", newline="") as file:
            line = next(csv.DictReader(file))
        answer = self.folder / "answers" / line["prediction"]
        answer.parent.mkdir(parents=True)
        shutil.copy(data / "truth" / line["prediction"].removesuffix(".json") / "truth.json", answer)
        rows = self.score(data, self.folder / "answers")
        self.assertEqual([row["status"] for row in rows if row["method"] not in ("a",)], ["ok"])
        scored = json.loads((self.out / "manifest.json").read_text())["scenarios"][0]["loaded_clips"][0]["frames"]
        self.assertEqual(scored, frames)
        again = self.ends(2, "score", data, self.folder / "answers", "--rate", 30, "-o", self.folder / "no")
        self.assertIn("--rate", again.stderr)

    def exported(self, name="ik"):
        """Returns a copy of a scenario's data set, and answers to it that may be changed."""
        shutil.copy(self.shared / name / f"{name}.yaml", self.folder)
        shutil.copytree(self.shared / name / "answers", self.folder / "answers")
        return self.shared / name / "data", self.folder / "answers"

    def score(self, data, answers, *more, code=0):
        result = self.etude("score", data, answers, "-o", self.out, *more)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(self.out.exists(), code < 2)
        if code == 2:
            return result.stderr
        return [json.loads(line) for line in (self.out / "cells.jsonl").read_text().splitlines()]

    def test_the_truth_scores_perfectly_beside_the_very_rows_of_a_run(self):
        data, answers = self.exported()
        self.assertEqual(len(self.index), 8)
        rows = self.score(data, answers, "--name", "oracle")
        mine = [row for row in rows if row["method"] == "oracle"]
        self.assertEqual(len(mine), 8)
        for row in mine:
            self.assertEqual(row["status"], "ok")
            self.assertEqual(row["solved_tight"], 1)
            self.assertLess(row["position_error_max_cm"], 1e-9)
            self.assertLess(row["hidden_angle_error_deg"], 1e-9)
        run = self.run_suite(self.folder / "ik.yaml", out=self.folder / "run")
        self.assertEqual([row for row in rows if row["method"] != "oracle"], run)
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertIn("oracle", json.dumps(summary["scenarios"][0]))
        manifest = json.loads((self.out / "manifest.json").read_text())
        self.assertEqual(manifest["scored"]["answers"], 8)
        self.assertEqual(self.etude("report", self.out, "--no-video").returncode, 0)

    def test_what_was_scored_is_a_result_folder_like_any_other(self):
        data, answers = self.exported()
        rows = self.score(data, answers, "--name", "oracle")
        baseline = self.folder / "baseline.json"
        self.assertEqual(self.etude("gate", self.out, "--baseline", baseline, "--update").returncode, 0)
        self.assertEqual(self.etude("gate", self.out, "--baseline", baseline).returncode, 0)
        self.assertEqual(self.etude("compare", self.out, self.out).returncode, 0)
        replayed = self.ends(0, "replay", self.out)
        self.assertIn(f"{len(rows) - 8} of {len(rows) - 8} cells are identical to the run", replayed.stdout)
        for arguments in (["run", "--from", self.out / "manifest.json"],
                          ["run", "--from", self.out / "manifest.json", "--dry-run"],
                          ["replay", self.out, "--cell", "ik/joint_noise_deg=2/000/oracle"]):
            refused = self.ends(2, *arguments)
            self.assertIn("scored", refused.stderr)

    def test_worse_answers_score_worse(self):
        data, answers = self.exported()
        for path in answers.rglob("*.json"):
            truth = json.loads(path.read_text())
            truth["angles_deg"] = [angle + 1 for angle in truth["angles_deg"]]
            path.write_text(json.dumps(truth))
        for row in self.score(data, answers, "--alone", code=1):  # no cell is ok
            self.assertEqual(row["method"], "predictions")
            self.assertEqual(row["status"], "unsolved")
            self.assertAlmostEqual(row["hidden_angle_error_deg"], 1, places=6)
            self.assertGreater(row["position_error_cm"], 0.1)
            self.assertEqual(row["solved_practical"], 0)

    def test_what_is_missing_extra_duplicate_or_broken_is_listed_and_nothing_is_scored(self):
        data, answers = self.exported()
        first = answers / "ik" / "joint_noise_deg=2"
        (first / "001.json").unlink()
        (first / "4.json").write_text("{}")
        shutil.copy(first / "002.json", first / "2.json")
        (first / "003.json").write_text(json.dumps({"angles_deg": [0] * 28}))
        (answers / "ik" / "joint_noise_deg=5" / "000.json").write_text("{\"angles_deg\": [1, 2")
        complaint = self.score(data, answers, code=2)
        for words in ["ik/joint_noise_deg=2/001.json", "ik/joint_noise_deg=2/4.json", "2.json (as",
                      "28 entries, not 29", "joint_noise_deg=5/000.json",
                      "missing answers: 1, extra: 1, duplicates: 1, broken: 2"]:
            self.assertIn(words, complaint)
        self.assertIn("broken", self.score(data, answers, "--allow-missing", code=2))

    def test_a_data_set_of_an_older_version_is_scored_and_a_newer_one_refused(self):
        data, answers = self.exported()
        manifest = json.loads((data / "manifest.json").read_text())
        self.assertEqual(manifest.pop("data_set"), 2)
        old = self.folder / "old"
        old.mkdir()
        (old / "manifest.json").write_text(json.dumps(manifest))
        rows = self.score(old, answers, "--alone")
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        shutil.rmtree(self.out)
        for version in (3, "2", 0):
            (old / "manifest.json").write_text(json.dumps({**manifest, "data_set": version}))
            self.assertIn(f"found a data set of version {json.dumps(version)}; allowed: versions 1 to 2",
                          self.score(old, answers, "--alone", code=2))

    def test_a_method_needs_a_name_of_its_own(self):
        data, answers = self.exported()
        self.assertIn("already has a method with the name 'fixed'", self.score(data, answers, "--name", "fixed", code=2))
        self.assertIn("'a/b' is not a valid method name", self.score(data, answers, "--name", "a/b", code=2))

    def test_a_missing_answer_may_be_a_failure_instead(self):
        data, answers = self.exported()
        (answers / "ik" / "joint_noise_deg=2" / "001.json").unlink()
        self.assertIn("--allow-missing", self.score(data, answers, code=2))
        rows = [row for row in self.score(data, answers, "--allow-missing", "--alone")]
        failed = [row for row in rows if row["status"] != "ok"]
        self.assertEqual([row["cell"] for row in failed], ["ik/joint_noise_deg=2/001/predictions"])
        self.assertEqual(failed[0]["status"], "failed")
        self.assertIn("001.json is missing", failed[0]["reason"])
        self.assertEqual(failed[0]["solved_practical"], 0)
        self.assertEqual(failed[0]["iterations_par2"], 400)
        self.assertIsNone(failed[0]["position_error_cm"])

    def test_an_export_is_whole_or_not_there_and_the_same_again(self):
        data, _ = self.exported()
        again = self.folder / "again"
        again.mkdir()
        self.assertEqual(self.etude("export", self.shared / "ik/ik.yaml", "-o", again).returncode, 0)
        files = sorted(path.relative_to(data) for path in data.rglob("*") if path.is_file())
        self.assertGreater(len(files), 16)
        for file in files:
            self.assertEqual((data / file).read_bytes(), (again / file).read_bytes(), file)
        refused = self.ends(2, "export", self.shared / "ik/ik.yaml", "-o", data)
        self.assertIn("is not empty", refused.stderr)
        self.ends(2, "export", self.write("bad.yaml", IK.replace("ccd", "cdc")), "-o", self.folder / "bad")
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.startswith("bad")], ["bad.yaml"])

    def test_the_inputs_tell_neither_seed_nor_truth(self):
        data, _ = self.exported()
        truth = json.loads((data / "truth/ik/joint_noise_deg=2/000/truth.json").read_text())
        told = "".join(path.read_text() for path in (data / "inputs").rglob("*") if path.is_file())
        self.assertNotIn(json.dumps(truth["angles_deg"][3]), told)
        self.assertNotIn("seed", told)

    @heavy
    def test_an_exported_take_is_captured_as_well_as_in_the_bench(self):
        data, answers = self.exported("film")
        take, marks, rig = data / "inputs/film/all/000", self.folder / "marks", self.folder / "rig.yaml"
        marks.mkdir()
        for camera in (1, 2):
            shutil.copy(take / f"marks-hue-camera-{camera}.coco.json", marks / f"camera-{camera}.coco.json")
        result = self.ends(0, "calibrate", take / "calibration-points.yaml", "--method", "dlt", "-o", rig)
        result = self.etude("capture", "--rig", rig, take / "camera-1.mkv", take / "camera-2.mkv", "--keypoints", marks,
                            "-o", self.folder / "motion.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.folder / "motion.csv", newline="") as file:
            poses = [[float(number) for number in row[2:]] for row in list(csv.reader(file))[1:]]
        (answers / "film/all/000.json").write_text(json.dumps({"poses": poses}))
        rows = {row["method"]: row["mpjpe_mm"] for row in self.score(data, answers)}
        self.assertGreater(rows["keypoints"], 1)
        self.assertAlmostEqual(rows["predictions"], rows["keypoints"], places=3)

    @heavy
    def test_depth_is_written_on_request(self):
        data, _ = self.exported("film")
        self.ends(0, "export", self.shared / "film/film.yaml", "-o", self.folder / "flat")
        told = {path.relative_to(data) for path in data.rglob("*") if path.is_file()}
        flat = {path.relative_to(self.folder / "flat") for path in (self.folder / "flat").rglob("*") if path.is_file()}
        self.assertEqual({path.suffix for path in told - flat}, {".exr"})
        self.assertEqual(flat - told, set())
        for path in flat:
            self.assertEqual((data / path).read_bytes(), (self.folder / "flat" / path).read_bytes(), path)

    @heavy
    def test_a_film_comes_in_formats_that_others_read(self):
        data, answers = self.exported("film")
        inputs, truth = data / "inputs/film/all", data / "truth/film/all/000"
        problem = json.loads((inputs / "000/problem.json").read_text())
        for camera in problem["cameras"]:
            self.assertEqual(png_size((inputs / "000" / camera["background"]).read_bytes()), (640, 480))
        # The command of docs/datasets.md writes exactly the pictures that the problem names.
        for number, camera in enumerate(problem["cameras"], 1):
            film = inputs / "000" / f"camera-{number}.mkv"
            subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-start_number", "0",
                            self.folder / f"camera-{number}-%04d.png"], check=True)
            unpacked = sorted(path.name for path in self.folder.glob(f"camera-{number}-*.png"))
            self.assertEqual(unpacked, camera["pictures"])
            self.assertEqual(png_size((self.folder / unpacked[-1]).read_bytes()), (640, 480))
        lines = (truth / "truth.trc").read_text().splitlines()
        self.assertEqual(len(lines), 6 + problem["frames"])
        with open(truth / "truth.csv", newline="") as file:
            table = list(csv.DictReader(file))
        self.assertAlmostEqual(1000 * float(table[2]["head_y_m"]),
                               float(lines[8].split("\t")[lines[3].split("\t").index("head") + 1]), places=4)
        self.assertTrue((truth / "camera-2.yaml").read_text().startswith("%YAML:1.0\n---\n"))
        self.assertEqual((truth / "camera-1-0002.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")
        # The truth's BVH file can be used as a clip.
        self.ends(0, "run", self.folder / "film.yaml", "--clips", truth / "truth.bvh", "-o", self.folder / "again")
        mine = [row for row in self.score(data, answers) if row["method"] == "predictions"]
        self.assertEqual([row["mpjpe_mm"] for row in mine], [0])
        self.assertIsNone(mine[0]["iou"])


if __name__ == "__main__":
    unittest.main()

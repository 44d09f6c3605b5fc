"""Tests `etude evaluate --alone`: motions without a truth, and limits that a library must keep."""
import csv
import json
import xml.etree.ElementTree

from etude_case import EtudeCase


class Triage(EtudeCase):
    @classmethod
    def setUpClass(cls):
        """Writes built-in moves as files, and reads their joints."""
        cls.shared = cls.shared_folder()
        for name in ("clap.csv", "sway.npz"):
            made = cls.etude("clip", "convert", f"builtin:{name[:-4]}", cls.shared / name)
            assert made.returncode == 0, made.stderr
        cls.lines = list(csv.reader((cls.shared / "clap.csv").read_text().splitlines()))

    def spoilt(self, name, change):
        """Writes the clap with every position (frame, joint, axis) changed."""
        head, *rows = [list(row) for row in self.lines]
        for f, row in enumerate(rows):
            for column, title in enumerate(head):
                if title[-4:] in ("_x_m", "_y_m", "_z_m"):
                    row[column] = repr(float(row[column]) + change(f, title[:-4], title[-3]))
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("\n".join(",".join(row) for row in [head, *rows]) + "\n")
        return path

    def floating(self, name):
        return self.spoilt(name, lambda f, joint, axis: 0.3 if axis == "y" else 0)

    def popping(self, name):
        return self.spoilt(name, lambda f, joint, axis: 0.5 if (f, joint, axis) == (30, "left_hand", "y") else 0)

    def triage(self, *arguments, code=0, out=None):
        done = self.etude("evaluate", "--alone", *arguments, "-o", out or self.out)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def rows(self, out=None):
        return {row["clip"]: row for row in
                map(json.loads, ((out or self.out) / "cells.jsonl").read_text().splitlines())}

    def failed(self, out):
        """Returns the failed cases of a run's JUnit file, whose count must agree."""
        root = xml.etree.ElementTree.parse(out / "report" / "junit.xml").getroot()
        failed = [case.get("name") for case in root.iter("testcase") if case.find("failure") is not None]
        for failure in root.iter("failure"):
            self.assertEqual(failure.get("message"), failure.text.splitlines()[0])
        self.assertEqual(root.get("failures"), str(len(failed)))
        return failed

    def test_each_fault_is_a_metric_and_a_sentence_with_joint_and_time(self):
        self.floating("m/floating.csv")
        self.popping("m/popping.csv")
        said = self.triage(f"{self.folder}/m/*.csv", self.shared / "sway.npz")
        rows = self.rows()
        self.assertEqual(list(rows), ["floating", "popping", "sway"])
        self.assertEqual([row["fault_free"] for row in rows.values()], [0, 0, 1])
        self.assertEqual(rows["floating"]["floats_share"], 1)
        self.assertGreater(rows["floating"]["floats_max_cm"], 20)
        self.assertEqual((rows["popping"]["pops"], rows["popping"]["floats_share"]), (1, 0))
        self.assertIn("left_hand pops by 50 cm at 0.9", rows["popping"]["reason"])
        self.assertIn("left_hand pops by 50 cm", said)
        self.assertIn("1 of 3 clips without a fault", said)
        self.assertIsNone(rows["sway"]["within_limits"])
        self.assertIn("no fault · ", rows["sway"]["reason"])
        # With the floor's height given, nothing floats.
        out = self.folder / "told"
        self.triage(self.folder / "m/floating.csv", "--floor", "0.3", out=out)
        self.assertEqual(self.rows(out)["floating"]["faults"], 0)

    def test_joints_that_are_not_shown_and_a_torn_body_are_told(self):
        self.spoilt("m/headless.csv", lambda f, joint, axis: float("nan") if joint == "head" and 20 <= f < 40 else 0)
        self.spoilt("m/torn.csv", lambda f, joint, axis: 0.4 if joint in ("left_foot", "left_ankle") and axis == "x" else 0)
        self.spoilt("m/skates.csv", lambda f, joint, axis: 0.01 * min(max(f - 20, 0), 20)
                    if joint in ("left_foot", "left_ankle") and axis == "z" else 0)
        self.triage(self.folder / "m")
        rows = self.rows()
        self.assertIn("head is not shown for 0.67 s from 0.6", rows["headless"]["reason"])
        self.assertGreater(rows["headless"]["gaps_share"], 0.2)
        self.assertIn("left_ankle is torn off in all frames", rows["torn"]["reason"])
        self.assertGreater(rows["torn"]["torn_max_cm"], 10)
        self.assertRegex(rows["skates"]["reason"], r"left_foot alone skates at (2[7-9]|3[0-3]) cm/s from 0\.")

    def test_limits_are_an_exit_code_a_test_report_and_a_section_of_the_page(self):
        self.floating("m/floating.csv")
        self.triage(f"{self.folder}/m/*", f"{self.shared}/*", "--limits", "recorded", code=1)
        self.assertEqual({name: row["within_limits"] for name, row in self.rows().items()},
                         {"clap": 1, "floating": 0, "sway": 1})
        self.ends(0, "report", self.out, "--no-video")
        self.assertEqual(self.failed(self.out), ["motions, floating"])
        page = (self.out / "report" / "index.html").read_text()
        self.assertIn("<h2>Clips with faults</h2>", page)
        self.assertIn("the feet never touch the floor", page)
        # With a user's own limit, 50 cm are allowed.
        limits = self.write("limits.yaml", "floats_max_cm: 50\n")
        self.triage(self.folder / "m", "--limits", limits, out=self.folder / "own")
        facts = self.facts("evaluate", "--alone", self.folder / "m", "--limits", limits, "-o", self.folder / "facts")
        self.assertEqual((facts["beyond_limits"], facts["not_judged"]), ([], []))
        self.assertEqual([line.split(":")[0] for line in facts["with_faults"]], ["m, floating"])
        # An unreadable clip violates the limits: exit code, terminal, JUnit and summary report it.
        self.write("m/torn.bvh", "HIERARCHY\n")
        self.popping("m/popping.csv")
        torn = self.folder / "torn"
        said = self.triage(self.folder / "m", "--limits", "recorded", code=1, out=torn)
        for words in ("1 beyond the limits:", "1 with faults that are within the limits:\n  m, popping: left_hand pops", "1 not judged:",
                      "0 of 2 clips without a fault, 1 more could not be judged\n"):
            self.assertIn(words, said)
        self.ends(0, "report", torn, "--no-video")
        self.assertEqual(self.failed(torn), ["m, floating", "m, torn"])
        summary = (torn / "report" / "summary.md").read_text()
        for words in ("0 of 2 clips without a fault, 1 beyond the limits, 1 more could not be judged.",
                      "| popping | m | 1 |  | left\\_hand pops by 50 cm", "| floating | m | 1 | beyond |"):
            self.assertIn(words, summary)
        # The summary starts with the number of measured cells and the clips with faults; it does not mention
        # comparisons.
        self.assertTrue(summary.startswith("# evaluate\n\n2 of 3 cells were measured, 1 could not be measured.\n\n\n## Clips with faults"))
        for words in "undecided", "expectation", "no comparison", "Holm":
            self.assertNotIn(words, summary)
        page = (torn / "report" / "index.html").read_text()
        self.assertLess(page.index("<h2>Clips with faults</h2>"), page.index('aria-label="Answers"'))
        self.assertNotIn("no comparison", page)

    def test_motions_that_are_kept_are_shown_with_the_time_of_each_fault(self):
        self.triage(self.popping("m/popping.csv"), "--keep", "motions")
        cell = json.loads((self.out / "cells.jsonl").read_text())
        kept, = (self.out / "recordings").iterdir()
        extras = json.loads(kept.read_text())["extras"]
        fault, = extras["faults"]
        self.assertEqual((fault["kind"], fault["begin_frame"] <= 30 <= fault["end_frame"] <= 32), ("pops", True), fault)
        self.assertEqual(self.etude("report", self.out, "--no-video").returncode, 0)
        self.assertIn(f'data-cell="{cell["scenario"]}/-/000/', (self.out / "report" / "index.html").read_text())
        motion, = (self.out / "report" / "motions").iterdir()
        self.assertIn("left_hand pops by 50 cm at 0.9", motion.read_text())
        # Recordings can be used wherever a clip can.
        again = self.folder / "again"
        self.triage(f"{self.out}#{cell['scenario']}/-/000@answer", out=again)
        self.assertEqual(next(iter(self.rows(again).values()))["pops"], 1)

    def test_methods_are_compared_and_gated_by_the_names_of_their_clips(self):
        for folder in "a", "b":
            self.popping(f"{folder}/one.csv")
            self.spoilt(f"{folder}/two.csv", lambda f, joint, axis: 0)
        self.triage(f"first={self.folder}/a", f"second={self.folder}/b/*.csv")
        self.popping("b/two.csv")
        worse = self.folder / "worse"
        self.triage(f"first={self.folder}/a", f"second={self.folder}/b/*.csv", out=worse)
        baseline = self.folder / "baseline.json"
        self.ends(0, "gate", self.out, "--baseline", baseline, "--update")
        self.ends(0, "gate", self.out, "--baseline", baseline)
        facts = self.facts("compare", self.out, worse)
        self.assertEqual((facts["only_before"], facts["only_after"]), ([], []))
        self.assertEqual({(move["method"], move["metric"]) for move in facts["moves"]} & {("second", "pops"), ("first", "pops")},
                         {("second", "pops")})
        # verify reports a changed file.
        self.ends(0, "verify", worse)
        self.floating("b/two.csv")
        self.assertIn("b/two.csv", self.ends(2, "verify", worse).stderr)

    def test_what_cannot_be_judged_is_a_row_and_the_others_stay(self):
        self.spoilt("m/good.csv", lambda f, joint, axis: 0)
        self.spoilt("m/nan.csv", lambda f, joint, axis: float("nan"))
        self.write("m/none.bvh", "no motion\n")
        self.write("m/short.csv", "\n".join(",".join(row) for row in self.lines[:4]) + "\n")
        said = self.triage(self.folder / "m")
        rows = self.rows()
        self.assertEqual({name: row["status"] for name, row in rows.items()},
                         {"good": "ok", "nan": "failed", "none": "failed", "short": "failed"})
        for name in "nan", "none":
            self.assertIn(f"{name}.", rows[name]["reason"])
        self.assertIn("3 frames; a search for faults needs at least 8", rows["short"]["reason"])
        self.assertIn("3 not judged:", said)

    def test_bad_input_is_one_line(self):
        clap = self.shared / "clap.csv"
        for arguments, words in [
                ([], "needs motions"),
                ([self.folder / "none*"], "no clip matches"),
                ([clap, f"a={clap}"], "allowed if there are several results"),
                ([clap, "--joints", "same"], "cannot be combined with --alone"),
                ([clap, "--limits", "none.yaml"], "none.yaml"),
                ([clap, "--limits", "recoded"], "did you mean 'recorded'"),
                ([clap, "--metric", "jumpz"], "--metric: unknown metric"),
                ([clap, "--floor", "1e9"], "--floor: "),
                ([clap, "--limits", self.write("l.yaml", "popps: 1\n")], "did you mean 'pops'"),
                ([clap, "--limits", self.write("m.yaml", "{}\n")], "contains no limit"),
                ([clap, "--metric", "mpjpe_root_mm"], "unknown metric of task plausibility")]:
            with self.subTest(words):
                self.refusal("evaluate", "--alone", *arguments, "-o", self.out, says=words)
        self.assertIn("--floor and --limits can only be used with --alone", self.etude("evaluate", clap, clap, "--limits", "recorded").stderr)


if __name__ == "__main__":
    import unittest
    unittest.main()

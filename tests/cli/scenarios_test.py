"""Tests scenario files as people write them: several scenarios in a file, shared defaults, sweeps, and invalid ones."""
import json
import unittest

from etude_case import IK, EtudeCase

SHARED = """defaults:
  task: ik
  trials: 2
  max_sweeps: 20
  methods: [{name: fixed, solver: ccd, weights: fixed}, {name: least-squares, solver: damped-least-squares}]
"""
SEVERAL = """include: [shared/ik.yaml]
defaults: {trials: 3}
scenarios:
  - scenario: start
    question: How far may it start?
    sweep: {joint_noise_deg: {from: 5, to: 15, step: 5}}
  - scenario: both
    question: And when poses are harder, too?
    trials: 1
    sweep: {together: {joint_noise_deg: [5, 15], poses: [0.5, 1]}}
"""


class Scenarios(EtudeCase):
    def write_suite(self, several=SEVERAL, shared=SHARED):
        (self.folder / "suite" / "shared").mkdir(parents=True, exist_ok=True)
        self.write("suite/several.yaml", several)
        self.write("suite/shared/ik.yaml", shared)
        self.write("suite/single.yaml", IK)
        return self.folder / "suite"

    def test_a_folder_runs_all_scenarios_of_its_files_with_shared_defaults(self):
        suite = self.write_suite()
        listed = self.ends(0, "list", "scenarios", suite)
        self.assertIn("  start (ik): How far may it start?\n  3 trials × 3 conditions × methods fixed, least-squares",
                      listed.stdout)
        rows = self.run_suite(suite)
        count = {}
        for row in rows:
            count[row["scenario"]] = count.get(row["scenario"], 0) + 1
        self.assertEqual(count, {"start": 3 * 3 * 2, "both": 1 * 2 * 2, "ik": 4 * 2 * 2})

    def test_defaults_written_or_inherited_give_the_same_rows(self):
        """Where a key is written must not change a result."""
        suite = self.write_suite()
        rows = self.run_suite(suite / "several.yaml")
        alone = "scenario: both\nquestion: And when poses are harder, too?\ntask: ik\ntrials: 1\nmax_sweeps: 20\n"
        alone += "sweep: {together: {joint_noise_deg: [5, 15], poses: [0.5, 1]}}\n"
        alone += "methods: [{name: fixed, solver: ccd, weights: fixed}, {name: least-squares, solver: damped-least-squares}]\n"
        same = self.run_suite(self.write("alone.yaml", alone), out=self.folder / "alone")
        self.assertEqual(len(same), 4)
        self.assertEqual([row for row in rows if row["scenario"] == "both"], same)

    def test_the_manifest_keeps_all_texts(self):
        suite = self.write_suite()
        self.run_suite(suite / "several.yaml")
        sources = json.loads((self.out / "manifest.json").read_text())["sources"]
        self.assertEqual(sorted(sources.values()), sorted([SEVERAL, SHARED]))

    def test_complaints_are_one_line_that_points_into_the_right_file(self):
        # Mistakes, the file that contains each, and the error message.
        cases = [
            (SEVERAL.replace("to: 15", "to: 1500"), SHARED,
             "several.yaml:6:30: 'joint_noise_deg': 185 is out of range"),
            (SEVERAL.replace("ik.yaml", "ki.yaml"), SHARED, "several.yaml:1:11: "),
            (SEVERAL, SHARED.replace("trials", "trails"), "ik.yaml:3:3: unknown key of a scenario 'trails'"),
        ]
        for several, shared, says in cases:
            self.refusal("run", self.write_suite(several, shared), "-o", self.out, says=says, leaves=self.out)

    def test_a_file_to_be_included_is_no_scenario(self):
        suite = self.write_suite()
        self.assertIn("ik.yaml:1:1: contains no scenario, only 'defaults'; move included files", self.ends(2, "run", suite / "shared", "-o", self.out).stderr)

    def test_clips_of_the_command_line_go_to_whatever_has_a_use_for_them(self):
        suite = self.folder / "suite"
        suite.mkdir()
        named = "scenario: t\nquestion: q?\ntask: transition\ntrials: 2\nmethods: [{name: now, choice: now}]\n"
        transition = self.write("suite/transition.yaml", named)
        clips = ["--clips", "builtin:clap", "builtin:boxing"]
        rows = self.run_suite(transition, *clips)  # it names none
        self.assertEqual([row["clip"] for row in rows], ["builtin:clap", "builtin:boxing"])
        ik = self.write("suite/ik.yaml", IK)
        rows = self.run_suite(suite, *clips, out=self.folder / "both")
        self.assertEqual({row["clip"] for row in rows if row["task"] == "ik"}, {None})
        self.assertEqual({row["clip"] for row in rows if row["task"] == "transition"}, {"builtin:clap", "builtin:boxing"})
        for paths in ([ik], [transition, ik]):
            refused = self.folder / "refused"
            result = self.ends(2, "run", *paths, *clips, "-o", refused)
            self.assertEqual(result.stderr, f"etude: {ik}: cannot use --clips or --library: no scenario has a task that takes clips; "
                             "a task that judges files finds its files by the scenario's key 'truth'\n")
            self.assertFalse(refused.exists())

    def test_a_motion_may_be_named_once_in_a_list_of_clips(self):
        clip = "/usr/share/assimp/models/BVH/01_03.bvh"
        for clips in (["builtin:*", "builtin:sway"], [clip, "/usr/share/assimp/models/../models/BVH/01_03.bvh"]):
            path = self.cut_scenario(*clips)
            self.refusal("run", path, "--dry-run", says=["contain a motion twice", clips[1]])
        path = self.cut_scenario("builtin:sway", "builtin:clap", trials=1)
        self.refusal("run", path, "--dry-run", "--clips", clip, clip, says=["contain a motion twice"])

    def test_a_selection_that_an_option_makes_empty_is_said(self):
        path = self.cut_scenario("builtin:sway", "builtin:clap", trials=3, more="video: {trials: [2]}\n")
        said = "scenario t kept no motion, because 'video' selects no trial below 2"
        self.assertIn(said, self.ends(0, "run", path, "--trials", 2, "-o", self.out).stderr)
        self.assertNotIn("kept no motion", self.ends(0, "run", path, "--overwrite", "-o", self.out).stderr)

    def test_the_list_of_methods_says_what_goes_with_what(self):
        listed = self.etude("list", "methods").stdout
        self.assertIn("  memory: 1…20; with `solver: ccd-anderson`\n", listed)
        self.assertRegex(listed, r"(?m)^  gauss-newton +Gauss-Newton steps .*\(the default\)$")

    def test_the_list_of_keys_has_those_of_tasks_and_of_every_scenario(self):
        listed = self.etude("list", "keys").stdout
        for key in ("joint_noise_deg", "oracle", "memory_mb", "together", "at_least"):
            self.assertIn(f"  {key} ", listed)


if __name__ == "__main__":
    unittest.main()

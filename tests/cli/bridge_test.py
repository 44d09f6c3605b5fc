"""Tests `etude bridge`: the tags file and its summary, as users see them."""
import json
import pathlib
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from etude_case import EtudeCase

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from json_schema import complaints, load_schema  # noqa: E402

MODELS = pathlib.Path("/usr/share/assimp/models")
WALK = MODELS / "BVH" / "01_03.bvh"
FEW = ["builtin:clap", "builtin:sway", "builtin:wave", "builtin:doze"]
SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "docs" / "schemas" / "bridge-tags.xsd"


class Bridge(EtudeCase):
    def setUp(self):
        super().setUp()
        self.tags = self.folder / "tags.xml"

    def works(self, *arguments):
        result = self.ends(0, "bridge", *arguments)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def refuses(self, *arguments, says):
        result = self.ends(2, "bridge", *arguments)
        lines = result.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        for words in says:
            self.assertIn(words, lines[0])

    def test_the_tags_file_holds_the_bridge_frames_of_every_clip(self):
        self.assertIn(f"written: {self.tags}\n", self.works(*FEW, "-o", self.tags))
        root = ElementTree.parse(self.tags).getroot()
        clips = root.findall("clip")
        self.assertEqual([clip.get("name") for clip in clips], FEW)
        frames = root.findall("clip/bridge-frame")
        self.assertGreater(len(frames), 20)
        for frame in frames:
            self.assertEqual(len(frame.get("grades").split()), 24)
            self.assertGreaterEqual(int(frame.get("clips")), 2)
        self.assertGreater(len(root.findall("in-between/key")), 3)

    def test_one_clip_is_not_called_clips(self):
        self.assertRegex(self.works("builtin:clap"), r"(?m)^1 clip, \d+ frames, ")

    def test_a_copy_of_a_clip_is_no_second_clip(self):
        summary = self.works(*FEW)
        copy = self.folder / "copy.csv"
        self.assertEqual(self.etude("clip", "convert", "builtin:clap", copy).returncode, 0)
        result = self.etude("bridge", *FEW, copy)
        self.assertEqual(result.stdout, summary)
        self.assertIn(f"left out: {copy}: shows the same motion as builtin:clap\n", result.stderr)

    def test_another_validator_accepts_it_too(self):
        self.works(*FEW, "-o", self.tags)
        try:
            check = subprocess.run(["xmllint", "--noout", "--schema", SCHEMA, self.tags], capture_output=True, text=True)
        except FileNotFoundError:
            self.skipTest("xmllint is not installed")
        self.assertEqual(check.returncode, 0, check.stderr)

    def test_the_same_clips_give_the_same_bytes(self):
        self.works(*FEW, "-o", self.tags)
        first = self.tags.read_bytes()
        self.works(*FEW, "-o", self.tags, "--overwrite")
        self.assertEqual(self.tags.read_bytes(), first)

    def test_the_summary_for_programs_keeps_to_its_schema(self):
        result = self.etude("bridge", *FEW, "--json", "-o", self.tags)
        self.assertEqual((result.returncode, result.stderr), (0, f"written: {self.tags}\n"))
        summary = json.loads(result.stdout)
        self.assertEqual(complaints(summary, load_schema("bridge-summary.schema.json")), [])
        self.assertEqual([clip["name"] for clip in summary["clips"]], FEW)
        self.assertEqual(len(summary["pairs"]), 12)
        self.assertEqual([way["into"] for way in summary["corrective"]], ["builtin:wave"])

    def test_the_coverage_into_any_clip_lies_between_that_of_one_and_that_of_all_together(self):
        summary = json.loads(self.works(*FEW, "--json"))
        for clip in summary["clips"]:
            shares = [pair["frame_share"] for pair in summary["pairs"] if pair["from"] == clip["name"]]
            self.assertGreaterEqual(clip["any"]["frame_share"], max(shares))
            self.assertLessEqual(clip["any"]["frame_share"], min(sum(shares) + 1e-9, 1))
        self.assertGreater(sum(clip["any"]["frame_share"] for clip in summary["clips"]), 0.5)

    def test_many_clips_are_compared_pair_by_pair_only_if_asked(self):
        one = self.folder / "0.csv"
        self.etude("clip", "convert", FEW[0], one)
        rows = [line.split(",") for line in one.read_text().splitlines()]
        hand = rows[0].index("left_hand_x_m")
        for i in range(1, 301):  # motions that differ by 1 cm in one frame
            frame, axis = 1 + i % 60, hand + i // 60 % 3 + (12 if i >= 180 else 0)
            changed = [[*row] for row in rows]
            changed[frame][axis] = f"{float(rows[frame][axis]) + .01:.4f}"
            (self.folder / f"{i}.csv").write_text("".join(",".join(row) + "\n" for row in changed))
        clips = [str(self.folder / "*.csv"), "builtin:wave"]
        summary = json.loads(self.etude("bridge", *clips, "--json").stdout)
        self.assertEqual(complaints(summary, load_schema("bridge-summary.schema.json")), [])
        self.assertNotIn("pairs", summary)
        self.assertEqual(len(summary["clips"]), 302)
        self.assertEqual({clip["leads_into"] for clip in summary["clips"]}, {None})
        self.assertEqual([clip["any"]["frame_share"] for clip in summary["clips"][:301]], [1] * 301)
        self.assertEqual([way["into"] for way in summary["corrective"]], ["builtin:wave"])
        self.assertIn("Pairs of clips were not compared; use --pairs to compare all pairs.", self.etude("bridge", *clips).stdout)

    def test_the_summary_for_people_names_clips_without_a_way(self):
        text = self.works(*FEW, "--to", "builtin:head_shake", "--threshold", "0.05")
        self.assertIn("into builtin:head_shake", text)
        self.assertIn("need an in-between clip", text)
        self.assertEqual(len([line for line in text.splitlines() if "builtin:head_shake" in line]), 3)

    def test_looser_rules_never_reach_less(self):
        def direct(threshold):
            pairs = json.loads(self.works(*FEW, "--json", "--threshold", threshold))["pairs"]
            return sum(pair["bridge_share"] for pair in pairs)
        self.assertLess(direct(0.1), direct(0.4))
        self.assertLess(direct(0.4), direct(1.5))

    def test_a_check_accepts_what_was_written_and_finds_what_was_changed(self):
        self.works(*FEW, "-o", self.tags, "--threshold", "0.3")
        self.assertIn("valid", self.works("--check", self.tags))
        self.assertIn("matches the clips", self.works("--check", self.tags, *FEW))
        self.refuses("--check", self.tags, *FEW[:3], says=["does not match"])
        self.tags.write_text(self.tags.read_text().replace('RH="down"', 'RH="dwn"', 1))
        self.refuses("--check", self.tags, says=["tags.xml:", "dwn", "down"])

    def test_a_check_sees_another_fuzzy_system(self):
        self.works(*FEW, "-o", self.tags, "--fuzzy", "builtin:gaussian")
        self.assertIn("matches the clips", self.works("--check", self.tags, *FEW))
        self.refuses("--check", self.tags, *FEW, "--fuzzy", "builtin:paper", says=["does not match", "fuzzy system"])

    def test_it_takes_files_of_motion_capture(self):
        if not WALK.exists():
            self.skipTest("no assimp-testmodels")
        self.assertIn("01_03", self.works(WALK, "builtin:wave"))

    def test_one_clip_has_no_other_to_lead_into(self):
        said = self.works(FEW[0], "-o", self.tags)
        self.assertIn("has only one clip", said)
        self.assertNotIn("directly", said)
        self.assertIn("matches the clips", self.works("--check", self.tags, FEW[0]))

    def test_bad_input_is_one_line_and_leaves_nothing(self):
        self.refuses("-o", self.tags, says=["needs clips"])
        self.refuses("builtin:nothing", "-o", self.tags, says=["nothing"])
        self.refuses(*FEW, "-o", self.tags, "--threshold", "nan", says=["threshold"])
        self.refuses(*FEW, "-o", self.tags, "--min-clips", "0", says=["min-clips"])
        self.refuses(*FEW, "-o", self.tags, "--fuzzy", "builtin:none", says=["none"])
        self.refuses(*FEW, "-o", self.tags, "--check", self.tags, says=["check"])
        self.refuses("--check", self.tags, says=["tags.xml"])
        self.refuses("--check", self.tags, "--fuzzy", "builtin:paper", says=["--fuzzy", "add the clips"])
        self.assertFalse(self.tags.exists())
        self.tags.write_text("mine")
        self.refuses(*FEW, "-o", self.tags, says=["already exists"])
        self.assertEqual(self.tags.read_text(), "mine")


if __name__ == "__main__":
    unittest.main()

"""Tests scenarios/kept_out.txt: no shipped recogniser or fuzzy system was learnt from a clip of the list, and the
scenario capture_unseen films exactly the clips of the list."""
import fnmatch
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "scenarios"
LIST = [line for line in (SCENARIOS / "kept_out.txt").read_text().splitlines() if line and line[0] != "#"]


def taught_by(text):
    """Returns the clips that a file of `etude train` says it was learnt from."""
    return [clip for clips in re.findall(r"^#.* of\n#   (.*)", text, re.M) for clip in clips.split(", ")]


def kept_out(clips):
    names = [pattern.removeprefix("builtin:") for pattern in LIST]
    return [clip for clip in clips if any(fnmatch.fnmatch(clip.removeprefix("builtin:"), name) for name in names)]


class KeptOut(unittest.TestCase):
    def test_holds_every_act_and_the_captured_clips(self):
        acts = {f"builtin:{path.stem}" for path in (SCENARIOS / "choreography" / "acts").glob("*.yaml")}
        self.assertEqual(set(LIST), acts | {"assimp:*"})

    def test_taught_no_recogniser_and_no_fuzzy_system(self):
        found = 0
        for path in [*SCENARIOS.glob("recognisers/*.yaml"), *SCENARIOS.glob("fuzzy/*.yaml")]:
            clips = taught_by(path.read_text()[:2000])
            found += bool(clips)
            self.assertEqual(kept_out(clips), [], path)
        self.assertEqual(found, 2, "learnt and coached say what taught them")

    def test_is_what_the_scenario_of_unseen_clips_films(self):
        clips = re.search(r"^clips: \[(.*)\]$", (SCENARIOS / "full" / "capture_unseen.yaml").read_text(), re.M)[1]
        self.assertEqual(sorted(re.findall(r"'([^']+)'", clips)), sorted(LIST))

    def test_notices_a_setting_that_was_chosen_on_one(self):
        head = "# What it knows, by `etude train --recogniser` of\n#   aerobic, {}\n# Trees: measure\nmeasures: 1\n"
        self.assertEqual(kept_out(taught_by(head.format("wave"))), ["wave"])
        self.assertEqual(kept_out(taught_by(head.format("assimp:01_01"))), ["assimp:01_01"])
        self.assertEqual(kept_out(taught_by(head.format("clap"))), [])


if __name__ == "__main__":
    unittest.main()

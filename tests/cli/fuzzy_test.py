"""Tests `etude clip grades` and the scenario key `fuzzy`, with paper A's fuzzy system as a file."""
import csv
import pathlib
import unittest

from etude_case import EtudeCase

PAPER = pathlib.Path("scenarios/fuzzy/paper.yaml")
SCENARIO = """scenario: shapes
question: q
task: transition
clips: ['builtin:clap', 'builtin:sway', 'builtin:boxing']
trials: 2
{}
methods: [{{name: paper}}]
"""


class Fuzzy(EtudeCase):
    def works(self, *arguments):
        result = self.ends(0, *arguments)
        return result.stdout

    def test_a_clip_is_told_frame_by_frame(self):
        table = self.folder / "clap.csv"
        said = self.works("clip", "grades", "builtin:clap", "-o", table)
        with open(table, newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertIn(f"{len(rows)} frames", said)
        self.assertEqual(len(rows[0]), 2 + 10 + 24 + 10 + 1)
        for row in rows:
            terms = {term: float(row[f"RH_{term}"]) for term in ("down", "mid", "up")}
            self.assertTrue(all(0 <= grade <= 1 for grade in terms.values()))
            self.assertEqual(row["RH_tag"], max(terms, key=terms.get))

    def test_several_clips_are_compared_as_whole_motions(self):
        said = self.works("clip", "grades", "builtin:clap", "builtin:sway", "builtin:boxing")
        similarities = [float(line.split()[0]) for line in said.splitlines() if " – " in line]
        self.assertEqual(len(similarities), 3)
        self.assertTrue(all(0 < similarity < 1 for similarity in similarities), said)

    def test_a_run_keeps_the_system_that_it_was_given(self):
        mine = pathlib.Path(self.write("mine.yaml", PAPER.read_text().replace("[0, 0, 20, 90]", "[0, 0, 60, 90]")))
        scenario = self.write("s.yaml", SCENARIO.format(f"fuzzy: '{mine}'"))
        self.works("run", scenario, "-o", self.folder / "run")
        mine.unlink()  # the manifest holds its text
        self.works("run", "--from", self.folder / "run" / "manifest.json", "-o", self.folder / "again")
        for name in ("manifest.json", "cells.jsonl"):
            self.assertEqual((self.folder / "run" / name).read_bytes(), (self.folder / "again" / name).read_bytes())

    def test_what_is_wrong_with_a_system_is_said_where_it_stands(self):
        wrong = self.write("wrong.yaml", PAPER.read_text().replace("[20, 90, 180]}", "[90, 20, 180]}", 1))
        self.refusal("clip", "grades", "builtin:clap", "--fuzzy", wrong, says="wrong.yaml:12:")
        self.refusal("run", self.write("s.yaml", SCENARIO.format(f"fuzzy: '{wrong}'")), "-o", self.folder / "run",
                     says="wrong.yaml:12:")
        self.refusal("clip", "grades", "builtin:clap", "--fuzzy", "builtin:papper", says="did you mean 'paper'?")
        self.refusal("run", self.write("s.yaml", SCENARIO.format("fuzzy: ''")), "-o", self.folder / "run",
                     says="s.yaml:6:8: 'fuzzy' must be builtin:NAME or a file")
        self.assertFalse((self.folder / "run").exists())


if __name__ == "__main__":
    unittest.main()

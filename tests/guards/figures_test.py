"""Tests scripts/figures on this repository's pages, and on pages that it must flag."""
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOADER = importlib.machinery.SourceFileLoader("figures", str(ROOT / "scripts" / "figures"))

BASELINE = {"values": [
    {"scenario": "s", "condition": "n=1", "method": "a", "metric": "jump_cm", "values": [1.0, 2.26, None, 1234.5]},
    {"scenario": "s", "condition": "n=1", "method": "b", "metric": "jump_cm", "values": [2.0, 4.26, 1.0, 1235.5]},
    {"scenario": "s", "condition": "n=2", "method": "a", "metric": "jump_cm", "values": [5.0, 5.0, 5.0, 5.0]},
    {"scenario": "t", "condition": "n=1,m=2", "method": "a", "metric": "jump_cm", "values": [1.0, 7.0, 10.0, 30.0]},
    {"scenario": "s", "condition": "n=1", "method": "a", "metric": "solved", "values": [1.0, 1.0, 0.0, 1.0]}]}


def bound(*entries):
    return "\n<!-- bound\n" + "".join(f"{entry}\n" for entry in entries) + "-->\n"


class Figures(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        (self.root / "scenarios" / "baselines").mkdir(parents=True)
        (self.root / "docs").mkdir()
        (self.root / "scenarios" / "baselines" / "quick.json").write_text(json.dumps(BASELINE))

    def figures(self, *arguments, root=None):
        tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("figures", LOADER))
        LOADER.exec_module(tool)  # load again, because the module caches files
        said = io.StringIO()
        with unittest.mock.patch.object(sys, "argv", ["figures", "--root", str(root or self.root), *map(str, arguments)]), \
                contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = tool.main()
        return code, said.getvalue()

    def of_page(self, text, *arguments):
        (self.root / "README.md").write_text(text)
        return self.figures(*arguments)

    def assert_right(self, text):
        code, output = self.of_page(text)
        self.assertEqual(code, 0, output)

    def assert_flagged(self, text, complaint):
        code, output = self.of_page(text)
        self.assertEqual(code, 1, output)
        self.assertIn(complaint, output)

    def test_of_this_repository_are_those_of_its_results(self):
        code, output = self.figures(root=ROOT)
        self.assertEqual(code, 0, output)
        print(output)

    def test_are_right_when_they_are(self):
        for text in ["2.3 cm" + bound("2.3 = quick: s/n=1/a/jump_cm"),
                     "2 cm" + bound("2 = quick: s/n=1/a/jump_cm"),
                     "two steps" + bound("two = quick: s/n=1/a/jump_cm"),
                     "412.6" + bound("412.6 = quick: s/n=1/a/jump_cm, mean"),
                     "12" + bound("12 = quick: t/n=1,m=2/a/jump_cm, mean"),
                     "1,234.50" + bound("1,234.50 = quick: s/n=1/a/jump_cm, max"),
                     "three of 4" + bound("three = quick: s/n=1/a/solved, ones", "4 = quick: s/n=1/a/solved, worlds"),
                     "75 %" + bound("75 = quick: s/n=1/a/solved, mean, times 100"),
                     "75 (30–95)" + bound("30 = quick: s/n=1/a/solved, share low, times 100",
                                          "95 = quick: s/n=1/a/solved, share high, times 100"),
                     "−1.0 cm" + bound("−1.0 = quick: s/n=1/a minus b/jump_cm"),
                     "1.0 cm" + bound("1.0 = quick: s/n=1/a minus b/jump_cm, without sign"),
                     "2 to\n5" + bound("2 = quick: s/*/a/jump_cm, lowest", "5 = quick: s/*/a/jump_cm, highest"),
                     "in 12 of 2 rooms, 2 of\nthem dark" + bound("2 of them = quick: s/n=1/a/jump_cm"),
                     "<!-- figures -->\n2, at 5°, `x 7`, F1" + bound("2 said, why", "5 said, a setting") +
                     "\n<!-- end of figures -->\n3" + bound("3 = quick: s/n=1/a/solved, ones")]:
            with self.subTest(text):
                self.assert_right(text)

    def test_are_flagged_when_they_are_wrong(self):
        for text, complaint in [
                ("2.4 cm" + bound("2.4 = quick: s/n=1/a/jump_cm"), "README.md:1: 2.4 is 2.3 in quick: s/n=1/a/jump_cm"),
                ("\n\nthree" + bound("three = quick: s/n=1/a/jump_cm"), "README.md:3: three is two in"),
                ("2" + bound("2 = quick: s/n=3/a/jump_cm"), "no jump_cm of a under n=3 in s"),
                ("2" + bound("2 = quick: s/n=1/c/jump_cm"), "no jump_cm of c"),
                ("9" + bound("9 = quick: t/n=1,m=2/a/jump_cm, share low"), "values other than 0 and 1 have no share"),
                ("9" + bound("9 = quick: t/n=1,m=2/a/jump_cm, mean"), "9 is 12 in quick: t/n=1,m=2/a/jump_cm, mean"),
                ("2" + bound("2 = quick: s/n=1/a/jump_cm, typical"), "'typical' is none of median"),
                ("2" + bound("2 = quick: s/n=1/a"), "is not SCENARIO/CONDITION/METHOD/METRIC"),
                ("2" + bound("2 = quick: s/*/a/jump_cm"), "'*' and lowest or highest go together"),
                ("2" + bound("2 = slow: s/n=1/a/jump_cm"), "no scenarios/baselines/slow.json and no docs/figures/slow.json"),
                ("It is 7" + bound("2 = quick: s/n=1/a/jump_cm"), "is bound to no number of the paragraph above"),
                ("2, then 7" + bound("7 said", "2 = quick: s/n=1/a/jump_cm"), "is bound to no number of the paragraph above"),
                ("22" + bound("2 = quick: s/n=1/a/jump_cm"), "is bound to no number of the paragraph above"),
                ("2" + bound("2 quick: s/n=1/a/jump_cm"), "is bound to no number of the paragraph above"),
                ("2\n\n<!-- bound\n2 = quick: s/n=1/a/jump_cm\n-->", "a <!-- bound is not written as"),
                ("2<!-- quick: s/n=1/a/jump_cm -->", "a comment binds nothing"),
                ("<!-- figures -->\n2 and 9 more" + bound("2 = quick: s/n=1/a/jump_cm") + "\n<!-- end of figures -->",
                 "9 is neither bound nor said"),
                ("<!-- figures -->\n2" + bound("2 = quick: s/n=1/a/jump_cm"), "a <!-- figures --> is not written as"),
                ("No figure at all.", "0 figures are bound")]:
            with self.subTest(text):
                self.assert_flagged(text, complaint)

    def test_of_answers_are_of_three_seeds(self):
        for seed, add in [(2, 0.1), (3, 1.2)]:
            lines = [line | {"values": [value and value + add for value in line["values"]]} for line in BASELINE["values"]]
            path = self.root / "scenarios" / "baselines" / f"quick-{seed}.json"
            path.write_text(json.dumps({"values": lines}))
        agrees = bound("407.0 said, another run", "0 = quick, seeds 1–3: s/n=1/a minus b/jump_cm, ones", "rest said, timing")
        ends = bound("2.26 = quick, seeds 1–3: s/n=1/a/jump_cm, lowest seed",
                     "3.46 = quick, seeds 1–3: s/n=1/a/jump_cm, median, highest seed")
        self.assert_right("**Answer.** 407.0, 0 and 7." + agrees + "\nIt is 9.")
        self.assert_right("**Answer.** 2.26 to 3.46" + ends)
        for text, complaint in [
                ("**Answer.** 2" + bound("2 = quick, seeds 1–3: s/n=1/a/jump_cm"), "2 is 2, 2, 3 in quick, seeds 1–3"),
                ("**Answer.** 2.26 to 3.50" + ends.replace("3.46", "3.50"), "3.50 is 3.46 in"),
                ("**Answer.** 2" + bound("2 = quick: s/n=1/a/jump_cm"), "jump_cm' is not of three seeds"),
                ("**Answer.** 2" + bound("2 said"), "'2 said' is not of three seeds"),
                ("**Answer.** 2" + bound("2 = quick: s/n=1/a/jump_cm", "rest said, why"), "is not of three seeds"),
                ("**Answer.** 2 and 7" + bound("2 = quick, seeds 1–3: s/n=1/a/jump_cm, lowest seed"), "7 is neither bound"),
                ("**Answer.** 2\n\n7", "2 is neither bound nor said"),
                ("<!-- figures -->\n2" + bound("2 = quick: s/n=1/a/jump_cm") + "\n<!-- end of figures -->",
                 "is not of three seeds"),
                ("2" + bound("2 = slow, seeds 1–3: s/n=1/a/jump_cm"), "no scenarios/baselines/slow.json")]:
            with self.subTest(text):
                self.assert_flagged(text, complaint)

    def test_of_runs_without_dice_are_of_three_seeds(self):
        (self.root / "docs" / "figures").mkdir()
        page, complaint = "**Answer.** 2" + bound("2 = fixed: s/-/a/jump_cm"), "jump_cm' is not of three seeds"
        for runs, is_flagged in [([(1, "f0"), (2, "f0"), (3, "f0")], False), ([(1, "f0"), (2, "f0"), (3, "f1")], True),
                                 ([(1, "f0"), (2, "f0")], True), ([(1, "f0")] * 3, True), ([(1, None), (2, None), (3, None)], True)]:
            with self.subTest(runs):
                kept = [{"suite": "s", "seed": seed} | ({"cells": cells} if cells else {}) for seed, cells in runs]
                (self.root / "docs" / "figures" / "fixed.json").write_text(json.dumps(
                    {"runs": kept, "of": {"etude": "0.3.0", "taken": "2026-11-30"}, "figures": {"s/-/a/jump_cm": 2}}))
                output = self.of_page(page)[1]
                self.assertIn("1 figures are bound to results", output)
                self.assertEqual(complaint in output, is_flagged, output)

    def test_are_written_anew_in_the_manner_that_they_had(self):
        page = ("9.99 cm, Nine, 7.5, −8" + bound("9.99 = quick: s/n=1/a/jump_cm", "Nine = quick: s/n=1/a/jump_cm",
                                                "7.5 = quick: s/n=1/a/jump_cm, max", "−8 = quick: s/n=1/a minus b/jump_cm"))
        self.of_page(page, "--write")
        self.assertEqual((self.root / "README.md").read_text(),
                         page.replace("9.99", "2.26").replace("Nine", "Two").replace("7.5", "1,234.5").replace("−8", "−1"))
        self.assertEqual(self.figures()[0], 0)

    def test_of_a_table_are_filled_by_one_directive(self):
        page = ("<!-- table: quick\npath: s/{column}/{row}\nrows: a/jump_cm | - | a/solved, ones & a minus b/jump_cm\n"
                "columns: n=1 | n=2 | -\n-->\n| of 3 | 1 | 2 | said |\n|---|---|---|---|\n"
                "| a |%s| **%s** cm (about) | 7 |\n| by hand | 5 | 6 | 8 |\n| both | %s of 4 | – | 9 |\n<!-- end -->\n")
        self.of_page(page % ("", "9.0", "1 and 9"), "--write")
        right = page % (" 2.26 ", "5.0", "3 and −1")
        self.assertEqual((self.root / "README.md").read_text(), right)
        self.assertIn("4 figures are bound to results, 0 complaints", self.figures()[1])
        self.assert_flagged("<!-- figures -->\n" + right + "<!-- end of figures -->\n", "README.md:2: a table is not of three seeds")
        for old, new, complaint in [("5.0", "5.1", "README.md:8: 5.1 is 5.0 in quick: s/n=2/a/jump_cm"),
                                    ("3 and −1 of 4", "3", "the cell '3' has 1 numbers for 2 results"),
                                    ("| 7 |", "| 7 | 7 |", "a row has 4 cells, its directive 3 columns"),
                                    ("| - | a/solved", "| a/solved", "a table has 3 rows, its directive 2"),
                                    ("columns: n=1", "columns: n=3", "no jump_cm of a under n=3 in s"),
                                    ("<!-- end -->", "", "a <!-- table: is not written as")]:
            with self.subTest(complaint):
                self.assert_flagged(right.replace(old, new), complaint)

    def test_of_a_table_may_stand_in_the_columns(self):
        self.assert_right("<!-- table: quick\nrows: a | b\ncolumns: s/n=1/{row}/jump_cm | s/n=1/{row}/jump_cm, max\n-->\n"
                          "| | median | max |\n|---|---|---|\n| a | 2 | 1,234.5 |\n| b | 3.13 | 1,236 |\n<!-- end -->\n")

    def a_run(self, **changes):
        """Makes a run's folder, and a tree with the run's version, metrics and scenarios."""
        run = self.root / "run"
        run.mkdir()
        asks = "# a comment\nscenario: s\ntrials: 5\n"
        manifest = {"suite": "large", "seed": 3, "etude": "0.2.0", "metrics": {"jump_cm": 1, "wait_s": 1},
                    "scenarios": [{"name": "s", "file": "s.yaml"}], "sources": {"s.yaml": asks}} | changes
        (run / "manifest.json").write_text(json.dumps(manifest))
        (run / "seal.json").write_text('{"files":{"cells.jsonl":"abc"}}')
        rows = [{"scenario": "s", "condition": "-", "method": "a", "trial": i, "jump_cm": float(i), "digest_world": str(i)}
                for i in range(5)]
        (run / "cells.jsonl").write_text("\n".join(map(json.dumps, rows)) + "\n")
        (self.root / "CMakeLists.txt").write_text("project(etude VERSION 0.2.0 LANGUAGES CXX)\n")
        (self.root / "bench" / "metrics" / "catalogue").mkdir(parents=True)
        (self.root / "bench" / "metrics" / "catalogue" / "1.yaml").write_text("metrics:\n  - id: jump_cm\n    label: jump\n")
        (self.root / "scenarios" / "s.yaml").write_text(asks.replace("a comment", "another"))
        return run

    LARGE = ("2 of 5" + bound("2 = large: s/-/a/jump_cm", "5 = large: s/-/a/jump_cm, worlds") +
             "\n<!-- age -->\n<!-- end of age -->\n")

    def test_are_taken_from_runs_that_are_too_large_to_keep(self):
        run = self.a_run()
        self.assert_flagged(self.LARGE, "no scenarios/baselines/large.json")
        code, output = self.figures("--take", "large", run)
        self.assertEqual(code, 0, output)
        self.assert_flagged(self.LARGE, "README.md:7: the age of its results is out of date")
        self.figures("--write")
        text = (self.root / "README.md").read_text()
        self.assert_right(text)
        self.assert_flagged(text.replace("2 ", "3 "), "3 is 2 in large")
        self.assert_flagged(text.replace("jump_cm\n", "jump_cm, mean\n"), "was not taken")
        self.assertEqual(self.figures("--take", "small", run)[0], 2)

    def test_say_how_old_their_results_are(self):
        run = self.a_run()
        self.of_page(self.LARGE)
        self.figures("--take", "large", run)
        kept = json.loads((self.root / "docs/figures/large.json").read_text())
        self.assertEqual(kept["of"]["metrics"], {"jump_cm": 1})  # only the metrics that pages use
        self.assertEqual(kept["runs"], [{"suite": "large", "seed": 3, "cells": "abc"}])
        self.assertEqual(list(kept["of"]["stages"]), ["s"])
        catalogue, scenario = self.root / "bench/metrics/catalogue/1.yaml", self.root / "scenarios/s.yaml"
        for file, old, new, says in [
                (None, "", "", f"seed 3: `large` ({kept['of']['taken']}). Since then, neither metrics nor scenarios of these runs have changed."),
                (self.root / "CMakeLists.txt", "0.2.0", "0.3.0", "Etude 0.2.0, seed 3, not run again with 0.3.0: `large`"),
                (catalogue, "    label", "    version: 2\n    label", "Since then, these have changed: metric `jump_cm` (1, now 2)."),
                (catalogue, "jump_cm", "jump_m", "metric `jump_cm` (1, now gone)"),
                (scenario, "trials: 5", "trials: 6", "scenario `s`"),
                (scenario, "trials", "question: What?\ntrials", None),
                (scenario, "# another", "# a third comment\n", None)]:
            with self.subTest(new):
                page = (self.root / "README.md").read_text()
                if file:
                    file.write_text(file.read_text().replace(old, new))
                self.figures("--write")
                now = (self.root / "README.md").read_text()
                self.assertIn(says or page, now)
                self.assertEqual(self.figures()[0], 0)
        self.assert_flagged(now.split("<!-- age")[0], "binds large and must have exactly one <!-- age -->")
        self.assert_flagged(now + now[now.index("<!-- age"):], "binds large and must have exactly one <!-- age -->")


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Tests `etude report --blind` and `etude blind`: the page of films in a browser, its key, and the summary of
answers."""
import base64
import json
import pathlib
import re
import shutil
import subprocess
import time
import unittest

from browser import CHROMIUM, Browser
from etude_case import EtudeCase, heavy

SCENARIO = """scenario: change
question: Which transition looks better?
task: transition
clips: ['builtin:clap', 'builtin:sway', 'builtin:wave']
trials: 4
methods: [{name: abrupt-one, choice: now, join: cut}, {name: faded-one, choice: now, join: crossfade}]
video: {compare: [abrupt-one, faded-one], trials: [0, 1, 2, 3]}
"""


class Blind(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.run_folder = cls.run_once(SCENARIO)[1]
        done = cls.etude("report", cls.run_folder, "--blind", "abrupt-one", "faded-one", "--pairs", "2", "--seed", "3")
        assert done.returncode == 0, done.stderr
        [cls.page] = (cls.run_folder / "blind").glob("*.html")
        cls.key_file = cls.page.with_suffix(".key.json")
        cls.key = json.loads(cls.key_file.read_text())

    def answers(self, rater, preferred, **changed):
        text = {"format": "etude-blind-answers", "version": 1, "page": self.key["page"], "rater": rater, "preferred": preferred, **changed}
        return self.write(f"{rater}.json", json.dumps(text))

    def side_of(self, method):
        return ["left" if pair["left"] == method else "right" for pair in self.key["pairs"]]

    def test_the_page_names_no_method_and_the_key_does(self):
        text = self.page.read_text()
        for secret in ["abrupt-one", "faded-one", "seed", "jump_cm", "crossfade"]:
            self.assertNotIn(secret, text)
            self.assertNotIn(secret, self.page.name)
        for pair in self.key["pairs"]:
            self.assertEqual({pair["left"], pair["right"]}, {"abrupt-one", "faded-one"})
            jump = next(metric for metric in pair["metrics"] if metric["id"] == "jump_cm")
            faded, abrupt = ("left", "right") if pair["left"] == "faded-one" else ("right", "left")
            self.assertLess(jump[faded], jump[abrupt])
        self.assertEqual(self.key["worlds"], 4)

    @heavy
    def test_the_same_seed_makes_the_same_page_and_another_one_another(self):
        before = self.page.read_bytes()
        self.ends(0, "report", self.run_folder, "--blind", "abrupt-one", "faded-one", "--pairs", "2", "--seed", "3")
        self.assertEqual(self.page.read_bytes(), before)
        self.ends(0, "report", self.run_folder, "--blind", "abrupt-one", "faded-one", "--pairs", "2", "--seed", "4")
        others = set((self.run_folder / "blind").glob("*.html")) - {self.page}
        self.assertEqual(len(others), 1)
        others.pop().unlink()
        self.ends(0, "verify", self.run_folder, "--sample", "1")

    def test_answers_become_shares_and_agreement(self):
        files = [self.answers(name, self.side_of("faded-one")) for name in "abcdefg"]
        facts = self.facts("blind", self.key_file, *files)
        self.assertEqual([method["method"] for method in facts["methods"]], ["faded-one", "abrupt-one"])
        self.assertEqual(facts["methods"][0]["preferred_share"], 1)
        self.assertEqual(facts["methods"][0]["interval"], [1, 1])
        jump = next(metric for metric in facts["metrics"] if metric["metric"] == "jump_cm")
        self.assertEqual((jump["agreed"], jump["decided"]), (2, 2))
        told = self.ends(0, "blind", self.key_file, files[0])
        self.assertIn("Intervals need 6 raters", told.stdout)

    def test_a_rater_is_known_by_the_name_without_case_and_spaces(self):
        twice = [self.answers(name, self.side_of("faded-one")) for name in ("Anna B.", "annab. ")]
        done = self.ends(2, "blind", self.key_file, *twice)
        self.assertIn("annab. .json: is a second file with answers of 'Anna B.' to the page", done.stderr)
        self.assertIn("rater: the name is empty; needed: the rater's name", self.ends(2, "blind", self.key_file, self.answers(" ", ["left", "left"])).stderr)

    def test_a_damaged_file_is_one_line_with_its_place(self):
        for changed, words in [({"preferred": ["left", "up"]}, "ben.json: preferred[1]: 'up'; allowed"),
                               ({"preferred": ["left"]}, "the number of answers by 'ben'"),
                               ({"page": "0"}, "'ben' answered the page 0, but the key of this page is not given"),
                               ({"version": 2}, "ben.json: version: 2; allowed: 1")]:
            done = self.ends(2, "blind", self.key_file, self.answers("ben", **{"preferred": ["left", "left"], **changed}))
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)

    def test_methods_that_cannot_be_compared_are_refused(self):
        for methods, words in [(["abrupt-one", "faded-one", "fadedone"], "unknown method 'fadedone'; did you mean 'faded-one'?"),
                               (["abrupt-one", "faded-one", "abrupt-one"], "found the method 'abrupt-one' twice; allowed: each")]:
            self.refusal("report", self.run_folder, "--blind", *methods, says=["--blind", words])

    def test_a_run_without_recordings_is_refused(self):
        bare = self.folder / "bare"
        self.ends(0, "run", self.write("bare.yaml", SCENARIO.rsplit("video", 1)[0]), "-o", bare)
        self.refusal("report", bare, "--blind", "abrupt-one", "faded-one",
                     says="no world has recorded motions of two of these methods: abrupt-one, faded-one")

    @unittest.skipUnless(shutil.which("ffmpeg"), "without ffmpeg")
    @heavy
    def test_a_side_is_empty_where_its_motion_is_not_recorded(self):
        run = self.folder / "waiting"
        self.ends(0, "run", self.write("waiting.yaml", SCENARIO.replace("choice: now, join: cut", "choice: wait-for-end, join: cut")), "-o", run)
        self.ends(0, "report", run, "--blind", "abrupt-one", "faded-one", "--pairs", "2")
        [page] = (run / "blind").glob("*.html")
        pairs = json.loads(page.with_suffix(".key.json").read_text())["pairs"]
        width, height, half, empty = 976, 480, 480, 0
        for pair, film in zip(pairs, re.findall(r"base64,([^\"]+)\"", page.read_text()), strict=True):
            recorded = {}
            for side in "left", "right":
                cell = f"change~-~{int(pair['world'].split()[-1]):03}~{pair[side]}.json"
                recording = json.loads((run / "recordings" / cell).read_text())
                begin = -recording["extras"]["request_frame"]
                recorded[side] = range(begin, begin + len(recording["tracks"][0]["poses"]))
            first = max(-30, min(times.start for times in recorded.values()))
            file = self.folder / "pair.mp4"
            file.write_bytes(base64.b64decode(film))
            raw = subprocess.run(["ffmpeg", "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "gray", "-"],
                                 capture_output=True, check=True).stdout
            for frame in range(0, len(raw) // (width * height), 5):
                for side, x in ("left", 20), ("right", width - half + 20):
                    begin = frame * width * height + height // 2 * width + x
                    row = raw[begin:begin + half - 40]
                    self.assertEqual(max(row) - min(row) > 20, first + frame in recorded[side], (pair["world"], side, frame))
                    empty += first + frame not in recorded[side]
        self.assertGreater(empty, 0)

    @heavy
    @unittest.skipUnless(CHROMIUM, "without chromium")
    def test_a_rater_watches_answers_by_keyboard_and_saves_a_file_that_is_read(self):
        with Browser() as page:
            page.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(self.folder))
            page.open(self.page)
            self.assertTrue(page.ask("[...document.querySelectorAll('[data-answer]')].every((b) => b.disabled)"))
            page.press("ArrowLeft")  # no answer counts before the film was seen
            self.assertEqual(page.ask("document.getElementById('place').textContent"), "Pair 1 of 2")
            page.ask("document.querySelector('.pair:not([hidden]) video').dispatchEvent(new Event('ended'))")
            for held in "repeat", "altKey", "ctrlKey", "metaKey":
                page.ask(f"document.dispatchEvent(new KeyboardEvent('keydown', {{key: 'ArrowLeft', {held}: true}}))")
            self.assertEqual(page.ask("document.getElementById('place').textContent"), "Pair 1 of 2")
            for key in ["ArrowLeft", "ArrowDown"]:
                page.ask("document.querySelector('.pair:not([hidden]) video').dispatchEvent(new Event('ended'))")
                page.press(key)
            self.assertTrue(page.ask("document.getElementById('save').disabled"))  # the name is still missing
            page.ask("(() => { rater.value = 'Anna B.'; rater.dispatchEvent(new Event('input')); save.click(); })()")
            self.assertEqual(page.logged, [])
            saved = self.folder / f"answers-{self.key['page']}-Anna_B..json"
            end = time.monotonic() + 600
            while not saved.exists() and time.monotonic() < end:
                time.sleep(0.05)
        self.assertEqual(json.loads(saved.read_text())["preferred"], ["left", "same"])
        self.assertEqual(self.facts("blind", self.key_file, pathlib.Path(saved))["answers"], 2)


if __name__ == "__main__":
    unittest.main()

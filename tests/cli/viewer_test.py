"""Tests the page's motion viewer in a browser, opened from disk, by its keys."""
import json
import os
import shlex
import shutil
import time
import unittest

from browser import CHROMIUM, Browser
from etude_case import EtudeCase, heavy, ik_scenario

CELL = "ik/joint_noise_deg=5/000/fixed"
OPENED = "etudeViewer.opened && etudeViewer.drawn > 0"


@unittest.skipUnless(CHROMIUM, "needs Chromium")
class Viewer(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario, cls.whole = cls.run_once(ik_scenario(trials=2) + "video: {compare: [fixed, least-squares], trials: [0]}\n")
        cls.page_file = cls.whole / "report" / "index.html"
        cls.done("report", "--no-video", cls.whole)

    @classmethod
    def done(cls, *arguments):
        result = cls.etude(*arguments)
        assert result.returncode == 0, result.stderr

    @heavy
    def test_it_opens_by_keys_plays_and_has_its_errors_as_a_table(self):
        with Browser() as page:
            page.set(prefers_reduced_motion="reduce")
            page.open(self.page_file)
            self.assertTrue(page.ask(f"etudeViewer.has({CELL!r}) && !etudeViewer.has('ik/joint_noise_deg=5/001/fixed')"))
            page.ask(f"document.querySelector('.watch [data-cell=\"{CELL}\"]').focus()")
            page.press("Enter")
            page.wait(OPENED)
            at = "etudeViewer.opened.state.t"
            self.assertEqual(page.ask(at), 0, "who wants less motion is not shown any unasked")
            self.assertFalse(page.ask("etudeViewer.opened.state.playing"))
            page.press("ArrowRight")
            page.press("ArrowRight")
            self.assertEqual(page.ask(at), 2)
            page.press("k")
            page.wait(at + " > 2")
            page.press("k")
            page.press("End")
            last = page.ask(at)
            self.assertEqual(last, page.ask("etudeViewer.opened.world.frames - 1"))
            page.press("e")
            self.assertFalse(page.ask("etudeViewer.opened.state.byError"))
            # The focus stays in the viewer: Tab reaches the picture, and keys turn it.
            yaw = page.ask("etudeViewer.opened.view.yaw")
            for _ in range(30):
                if page.ask("document.activeElement.tagName") == "CANVAS":
                    break
                page.press("Tab")
            page.press("ArrowLeft")
            self.assertNotEqual(page.ask("etudeViewer.opened.view.yaw"), yaw)
            self.assertTrue(page.ask("etudeViewer.opened.dialog.contains(document.activeElement)"))
            # The table's numbers equal the recording's in the last frame.
            table = page.ask("[...document.querySelectorAll('.viewer tbody tr')].map((r) => [...r.children].map((c) => c.textContent))")
            self.check_table(table)
            page.press("Escape")
            page.wait("!etudeViewer.opened")
            self.assertEqual(page.ask("document.activeElement.dataset.cell"), CELL, "the focus goes back")
            self.assertEqual(page.logged, [])

    def check_table(self, table):
        """Returns the errors of the last frame and of all frames, from the recording itself."""
        self.assertEqual([row[0] for row in table][:4] + [table[-1][0]], ["hip centre", "spine", "shoulder centre", "head", "all joints"])
        recording = json.loads((self.whole / "recordings" / (CELL.replace("/", "~") + ".json")).read_text())
        places = {track["name"]: track["poses"] for track in recording["tracks"]}
        self.assertEqual(len(table), 21)
        for joint, row in enumerate(table[:20]):
            errors = [100 * sum((a[3 * joint + i] - b[3 * joint + i]) ** 2 for i in range(3)) ** .5 for a, b in zip(places["truth"], places["solution"])]
            for shown, true in zip(row[2:4], [sum(errors) / len(errors), max(errors)]):
                self.assertAlmostEqual(float(shown), true, delta=.006 + .006 * true, msg=f"joint {row[0]}")

    def test_it_names_the_command_that_writes_its_motion(self):
        with Browser() as page:
            page.open(self.page_file)
            page.ask(f"etudeViewer.open({CELL!r})")
            page.wait(OPENED)
            said = page.ask("document.querySelector('.viewer code.file').textContent")
            words = shlex.split(said.replace("RUN", str(self.whole)).replace("motion.bvh", str(self.folder / "motion.csv")))
            self.assertEqual(words[0], "etude")
            self.done(*words[1:])
            solution = self.folder / "solution.csv"
            self.done("clip", "convert", f"{self.whole}#{CELL}@solution", solution)
            self.assertEqual((self.folder / "motion.csv").read_text(), solution.read_text())

    @heavy
    def test_without_webgl_it_draws_on_a_plain_canvas(self):
        with Browser("--disable-3d-apis") as page:
            page.open(self.page_file)
            page.ask(f"etudeViewer.open({CELL!r})")
            page.wait(OPENED)
            self.assertEqual(page.ask("document.querySelector('.stage').dataset.renderer"), "2D canvas")
            page.press("k")
            seen = page.ask("(() => { const c = document.querySelector('.stage canvas'); const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
                            "const seen = new Set(); for (let i = 0; i < d.length; i += 4) seen.add(d[i] * 65536 + d[i + 1] * 256 + d[i + 2]); return seen.size; })()")
            self.assertGreater(seen, 20, "somebody is there")
            self.assertEqual(page.logged, [])

    @heavy
    def test_motions_that_are_not_beside_the_page_are_told_of(self):
        alone = self.folder / "alone.html"
        shutil.copy(self.page_file, alone)
        with Browser() as page:
            page.open(alone)
            page.ask("window.alert = (text) => { window.told = text; }")
            self.assertFalse(page.ask(f"etudeViewer.open({CELL!r})"))
            self.assertIn("not beside this page: report/motions/ik-2.js", page.ask("told"))

    @heavy
    def test_it_is_quick(self):
        if os.getloadavg()[0] > os.cpu_count():
            self.skipTest("the machine is busy with something else")
        with Browser() as page:
            page.open(self.page_file)
            begin = time.monotonic()
            page.ask(f"etudeViewer.open({CELL!r})")
            page.wait(OPENED)
            self.assertLess(time.monotonic() - begin, 1)
            page.ask("etudeViewer.opened.state.playing = true; 0")
            before, begin = page.ask("etudeViewer.drawn"), time.monotonic()
            time.sleep(4)
            rate = (page.ask("etudeViewer.drawn") - before) / (time.monotonic() - begin)
            print(f"{rate:.1f} frames a second, {page.ask('document.querySelector(`.stage`).dataset.renderer')}")
            self.assertGreaterEqual(rate, 30)

    def test_its_data_are_small(self):
        script = (self.page_file.parent / "motions" / "ik-1.js").read_text()
        world = json.loads(script[len("etudeMotion("):-len(");\n")])
        for body in world["bodies"]:
            self.assertLessEqual(len(body["data"]) * 3 // 4, 120 * body["frames"] + 2)
        self.assertEqual(world["bodies"][0]["label"], "truth")
        self.assertEqual(len(world["bodies"][0]["data"]), 160, "what stands still is one frame")


if __name__ == "__main__":
    unittest.main()

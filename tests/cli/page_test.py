#!/usr/bin/env python3
"""Tests a run's page in a headless browser, as its readers use it: at every width, in every mode, by keyboard."""
import base64
import json
import pathlib
import re
import shlex
import unittest

from browser import CHROMIUM, Browser
from etude_case import IK, EtudeCase

HOSTILE = "Is <b id=broken>this</b> & \\\"that\\\" text?"
SCENARIO = f"""scenarios:
  - scenario: ik-with-a-name-that-is-longer-than-a-telephone-is-wide
    question: "{HOSTILE}"
    description: "{HOSTILE}"
    task: ik
    trials: 8
    sweep: {{joint_noise_deg: [2, 5]}}
    methods:
      - {{name: fixed, solver: ccd, weights: fixed, description: "{HOSTILE}"}}
      - {{name: a-method-with-a-name-that-is-longer-than-any-table-of-ours-is-wide, solver: gauss-newton}}
      - {{name: least-squares, solver: damped-least-squares}}
    metrics: [orientation_error_deg, position_error_cm, iterations]
    expect: [{{metric: orientation_error_deg, of: least-squares, below: fixed}}]
    video: {{compare: [fixed, least-squares], trials: [3]}}
  - scenario: change
    question: Does a transition without a cut jump less?
    task: transition
    clips: ['builtin:clap', 'builtin:sway']
    trials: 6
    methods: [{{name: cut, choice: now, join: cut}}, {{name: end, choice: wait-for-end, join: cut}}]
"""

OPEN = "document.querySelectorAll('details').forEach((d) => { d.open = true; })"
WORDS = "document.body.innerText.trim().split(/\\s+/).length"
# Returns elements that are clipped, or wider than the window, without a place to scroll.
CLIPPED = """[...document.querySelectorAll('body *')].filter((e) => {
  const box = e.getBoundingClientRect();
  if (!box.width || e.closest('.scroll, .skip, .defs, svg, .menu, .tools') || e.matches('script, style, br')) return false;
  const inner = getComputedStyle(e).overflowX !== 'visible' && e.scrollWidth > e.clientWidth + 1;
  return box.right > innerWidth + 1 || box.left < -1 || inner;
}).map((e) => e.tagName + '.' + e.className + ' ' + e.textContent.slice(0, 40))"""
# Returns the texts whose contrast with their background is below 4.5, and the number of texts.
CONTRAST = """(() => {
  const parse = (text) => { const n = text.match(/[\\d.]+/g).map(Number); return [n[0], n[1], n[2], n[3] ?? 1]; };
  const light = (c) => c.slice(0, 3).map((v) => v / 255).map((v) => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4)
      .reduce((sum, v, i) => sum + v * [.2126, .7152, .0722][i], 0);
  const behind = (e) => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c[3] === 1) return c; }
                          return parse(getComputedStyle(document.documentElement).getPropertyValue('--page') ? 'rgb(255,255,255)' : ''); };
  const low = []; let count = 0;
  for (const e of document.querySelectorAll('body *')) {
    if (e.closest('script, style, .skip, .defs') || ![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())) continue;
    if (!e.getClientRects().length) continue;
    const style = getComputedStyle(e), front = parse(e instanceof SVGElement ? style.fill : style.color), back = behind(e);
    const [a, b] = [light(front), light(back)].sort((x, y) => y - x), ratio = (a + .05) / (b + .05);
    ++count;
    if (ratio < 4.5) low.push(ratio.toFixed(2) + ' ' + e.tagName + '.' + (e.className.baseVal ?? e.className) + ' ' + e.textContent.trim().slice(0, 30));
  }
  return {low: [...new Set(low)].slice(0, 10), count};
})()"""
FOCUS = """(() => { const e = document.activeElement, box = e.getBoundingClientRect(); return {tag: e.tagName.toLowerCase(), cell: e.dataset?.t !== undefined,
  style: e.className.baseVal ?? e.className, text: e.textContent.trim().slice(0, 40), y: box.top + scrollY,
  place: [...document.querySelectorAll('*')].indexOf(e), seen: box.width > 0}; })()"""


@unittest.skipUnless(CHROMIUM, "needs Chromium")
class Page(EtudeCase):
    @classmethod
    def setUpClass(cls):
        shared = cls.shared_folder()
        scenario, cls.run_folder = shared / "two.yaml", shared / "a run's folder"
        scenario.write_text(SCENARIO)
        for arguments in (("run", scenario, "-o", cls.run_folder), ("report", cls.run_folder, "--no-video")):
            result = cls.etude(*arguments)
            assert result.returncode == 0, result.stderr
        cls.page = cls.run_folder / "report" / "index.html"
        cls.browser = cls.enterClassContext(Browser())

    def test_it_fits_every_width_and_mode_and_can_be_read(self):
        narrow_and_wide = ({"scheme": "dark"}, {"forced": True}, {"script": False})
        modes = {400: ({}, *narrow_and_wide), 800: ({}, {"media": "print"}), 1280: ({}, *narrow_and_wide), 2560: ({},)}
        for width, each in modes.items():
            for mode in each:
                with self.subTest(width=width, **mode):
                    self.browser.open(self.page, width, **mode)
                    self.browser.ask(OPEN)
                    self.assertLessEqual(self.browser.ask("document.documentElement.scrollWidth"), width)
                    self.assertEqual(self.browser.ask(CLIPPED), [])
                    if "forced" not in mode:  # with forced colours, the reader's own colours apply
                        contrast = self.browser.ask(CONTRAST)
                        self.assertEqual(contrast["low"], [])
                        self.assertGreater(contrast["count"], 200)
        # The controls: too wide or too pale elements are found.
        self.browser.open(self.page, 400)
        self.browser.ask("document.querySelector('h2').style.width = '500px'; document.querySelector('h1').style.color = '#bbb'")
        self.assertEqual(len(self.browser.ask(CLIPPED)), 1)
        self.assertRegex(self.browser.ask(CONTRAST)["low"][0], "H1")

    def test_it_answers_in_few_words_and_its_facts_need_no_script(self):
        self.browser.open(self.page, 1280, script=False)
        self.assertLess(self.browser.ask(WORDS), 2 * 175 + 40)
        self.assertEqual(self.browser.ask("document.querySelectorAll('.more').length && "
                                          "getComputedStyle(document.querySelector('.more')).display !== 'none'"), True)
        self.assertGreater(self.browser.ask("document.querySelectorAll('figure svg use[data-t]').length"), 50)
        self.assertEqual(self.browser.ask("document.querySelectorAll('#broken').length"), 0)
        self.assertIn('<b id=broken>this</b> & "that" text?', self.browser.ask("document.querySelector('h2').textContent"))

    def test_every_link_leads_to_a_file(self):
        self.browser.open(self.page, 1280)
        links = self.browser.ask("[...document.querySelectorAll('a[href]')].map((a) => a.href)")
        files = {link for link in links if "#" not in link}
        self.assertGreater(len(files), 8)
        for link in files:
            target = pathlib.Path(self.browser.ask(f"decodeURIComponent(new URL({link!r}).pathname)"))
            self.assertTrue(target.is_file(), link)
            self.assertTrue(target.is_relative_to(self.run_folder), link)

    def test_the_keyboard_reaches_everything_in_the_order_of_the_page(self):
        browser = self.browser
        browser.open(self.page, 1280)
        stops = []
        while len(stops) < 60:
            browser.press("Tab")
            stop = browser.ask(FOCUS)
            if stop["tag"] == "body":
                break
            stops.append(stop)
        self.assertEqual(stops[0]["style"], "skip")
        self.assertEqual([stop["place"] for stop in stops], sorted(stop["place"] for stop in stops))
        self.assertTrue(all(stop["seen"] for stop in stops))
        self.assertIn("How to read this", [stop["text"] for stop in stops])
        self.assertEqual(sum(stop["cell"] for stop in stops), 2)  # an open picture is one stop

    def test_a_dot_tells_how_to_run_its_cell_again_by_keyboard(self):
        browser = self.browser
        browser.open(self.page, 1280)
        browser.ask("document.addEventListener('etude:cells', (e) => { window.told = e.detail; });"
                    "document.querySelector('use[data-t]').focus()")
        for _ in range(3):
            browser.press("ArrowRight")
        dot = browser.ask("document.activeElement.dataset.t")
        browser.press("Enter")
        command = browser.ask("document.querySelector('.row-card code').textContent")
        words = shlex.split(command)
        self.assertRegex(browser.ask("document.querySelector('.row-card p').textContent"), rf"^fixed, trial {dot}: [\d.e-]+°$")
        self.assertEqual(words[:3], ["etude", "replay", str(self.run_folder)])
        self.assertEqual(words[4].split("/")[2], dot.zfill(3))
        self.assertIn("1 of 1 cells are identical to the run", self.etude(*words[1:]).stdout)
        self.assertEqual(browser.ask("told.cells"), [words[4]])
        self.assertEqual(browser.ask("told.kept"), [words[4]] if dot == "3" else [])
        self.assertEqual(browser.ask("document.querySelector('use[data-t=\"3\"]').dataset.cell"),
                         "ik-with-a-name-that-is-longer-than-a-telephone-is-wide/" + words[4].split("/")[1] + "/003/fixed")
        browser.press("Escape")
        self.assertEqual(browser.ask("document.activeElement.dataset.t"), dot)

    def test_a_row_opens_the_card_of_the_trial_that_was_recorded(self):
        browser = self.browser
        browser.open(self.page, 1280)
        browser.ask(OPEN)
        browser.ask("document.addEventListener('etude:cells', (e) => { window.told = e.detail; });"
                    "window.rows = [...document.querySelectorAll('tr[data-ids]')].filter((r) => r.dataset.ids.includes('\\n'));"
                    "rows.find((r) => /fixed/.test(r.dataset.ids) && /least/.test(r.dataset.ids)).cells[1].click()")
        told = browser.ask("told")
        self.assertEqual(sorted(cell.split("/", 2)[2] for cell in told["cells"]), ["003/fixed", "003/least-squares"])
        self.assertEqual(told["kept"], told["cells"])
        self.assertEqual(browser.ask("[...document.querySelectorAll('.row-card code')].map((c) => c.textContent.split(' ').at(-1))"), told["cells"])
        self.assertTrue(browser.ask("document.querySelector('.row-card .watched') !== null"))
        browser.ask("rows.find((r) => /longer-than-any/.test(r.dataset.ids)).cells[1].click()")
        self.assertEqual({cell.split("/")[2] for cell in browser.ask("told.cells")}, {"003"})  # the world with a film
        browser.ask("[...document.querySelectorAll('tr[data-ids]')].find((r) => r.dataset.ids.startsWith('change/')).cells[1].click()")
        self.assertEqual({cell.split("/")[2] for cell in browser.ask("told.cells")}, {"000"})  # no world has a film

    def test_tables_sort_filter_choose_columns_and_are_copied(self):
        browser = self.browser
        browser.open(self.page, 1280)
        browser.ask(OPEN)
        browser.ask("window.table = document.querySelector('.glance'); window.tools = table.closest('.scroll').previousElementSibling;"
                    "document.addEventListener('etude:copied', (e) => { window.copied = e.detail; })")
        values = "[...table.tBodies[0].rows].filter((r) => !r.hidden).map((r) => Number(r.cells[2].dataset.v))"
        first = browser.ask(values)
        browser.ask("table.tHead.rows[0].cells[2].querySelector('button').click()")
        self.assertEqual(browser.ask(values), sorted(first))
        self.assertNotEqual(first, sorted(first))
        browser.ask("table.tHead.rows[0].cells[2].querySelector('button').click()")
        self.assertEqual(browser.ask(values), sorted(first, reverse=True))
        browser.ask("table.tHead.rows[0].cells[2].querySelector('button').click()")
        self.assertEqual(browser.ask(values), first)
        browser.ask("const f = tools.querySelector('input'); f.value = 'least deg=5'; f.dispatchEvent(new Event('input'))")
        self.assertEqual(len(browser.ask(values)), 1)
        browser.ask("[...tools.querySelectorAll('button')].find((b) => b.textContent === 'TSV').click()")
        head, row = browser.ask("copied").splitlines()
        self.assertEqual(row.split("\t")[:2], ["least-squares", "joint_noise_deg=5"])
        columns = len(head.split("\t"))
        browser.ask("[...table.tBodies[0].rows].find((r) => !r.hidden).cells[0].textContent = '=1+1'")
        browser.ask("[...tools.querySelectorAll('button')].find((b) => b.textContent === 'TSV').click()")
        self.assertTrue(browser.ask("copied").splitlines()[1].startswith("'=1+1\t"), "no formula in a spreadsheet")
        browser.ask("[...tools.querySelectorAll('button')].find((b) => b.textContent === 'Columns').click();"
                    "tools.querySelector('.menu input:not(:checked)').click()")
        browser.ask("[...tools.querySelectorAll('button')].find((b) => b.textContent === 'LaTeX').click()")
        lines = browser.ask("copied").splitlines()
        self.assertEqual(lines[0], "\\begin{tabular}{" + "l" * (columns + 1) + "}")
        self.assertIn("joint\\_noise\\_deg=5", lines[4])
        self.assertIn("$\\downarrow$", lines[2])
        self.assertTrue("".join(lines).isascii(), "LaTeX knows every sign")
        browser.ask("tools.querySelector('.menu input').focus()")
        browser.press("Escape")
        self.assertEqual(browser.ask("document.activeElement.textContent + tools.querySelectorAll('.menu').length"), "Columns0")
        browser.ask("[...tools.querySelectorAll('button')].find((b) => b.textContent === 'Markdown').click()")
        self.assertIn("joint\\_noise\\_deg=5", browser.ask("copied"))

    def test_a_picture_is_saved_whole(self):
        browser = self.browser
        browser.open(self.page, 1280)
        picture = browser.ask("""new Promise((done) => {
          const made = URL.createObjectURL;
          URL.createObjectURL = (blob) => { blob.text().then(done); return made.call(URL, blob); };
          document.querySelector('figure .save').click();
        })""")
        checked = browser.ask(f"(() => {{ const svg = new DOMParser().parseFromString({picture!r}, 'image/svg+xml');"
                              "const ids = new Set([...svg.querySelectorAll('[id]')].map((e) => '#' + e.id));"
                              "const uses = [...svg.querySelectorAll('use')]; return {error: svg.querySelector('parsererror') !== null,"
                              "uses: uses.length, lost: uses.filter((u) => !ids.has(u.getAttribute('href'))).length,"
                              "bare: uses.filter((u) => !u.style.fill.startsWith('rgb')).length}; })()")
        self.assertEqual({**checked, "uses": checked["uses"] > 10}, {"error": False, "uses": True, "lost": 0, "bare": 0})

    def test_a_picture_is_printed_alone_on_a_page_of_its_size(self):
        browser = self.browser
        browser.open(self.page, 1280)
        printed = browser.ask("""new Promise((done) => {
          document.addEventListener('etude:printed', (event) => {
            const inside = event.target.contentDocument, box = document.querySelector('figure svg').getBoundingClientRect();
            done({html: '<!doctype html>' + inside.documentElement.outerHTML, pictures: inside.querySelectorAll('svg').length, width: box.width});
          });
          document.querySelector('figure .pdf').click();
        })""")
        alone = self.folder / "alone.html"
        alone.write_text(printed["html"])
        browser.open(alone)
        pdf = base64.b64decode(browser.send("Page.printToPDF", preferCSSPageSize=True, printBackground=True)["data"])
        pages = re.findall(rb"/MediaBox \[0 0 ([\d.]+) [\d.]+\]", pdf)
        self.assertEqual(len(pages), printed["pictures"])
        self.assertAlmostEqual(float(pages[0]) / 72 * 96, printed["width"] + 24, delta=2)
        self.assertNotIn(b"/Subtype /Image", pdf)
        self.assertIn(b"/Subtype /Type", pdf)  # the PDF embeds fonts, not outlines


class Descriptions(EtudeCase):
    def test_what_methods_are_is_told_and_changes_nothing_of_the_results(self):
        folders = []
        for name, text in (("bare", IK), ("told", IK.replace("weights: fixed}", "weights: fixed, description: Stays.}")
                                          .replace("question:", "description: Bodies reach.\nquestion:"))):
            scenario = self.folder / f"{name}.yaml"
            scenario.write_text(text)
            folders.append(self.folder / name)
            self.run_suite(scenario, out=folders[-1])
        self.assertEqual(*[(folder / "cells.jsonl").read_bytes() for folder in folders])
        summaries = [json.loads((folder / "summary.json").read_text())["scenarios"][0] for folder in folders]
        self.assertEqual(summaries[0]["descriptions"], ["solver ccd, weights fixed", "solver damped-least-squares"])
        self.assertEqual((summaries[1]["description"], summaries[1]["descriptions"][0]), ("Bodies reach.", "Stays."))
        baseline = self.folder / "baseline.json"
        self.ends(0, "gate", folders[0], "--baseline", baseline, "--update")
        self.assertNotIn("changed", self.ends(0, "gate", folders[1], "--baseline", baseline).stdout)


if __name__ == "__main__":
    unittest.main()

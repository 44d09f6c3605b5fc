"""Tests `etude verify`: it detects a forged and resealed run, by repeating cells or by its owner's signature."""
import base64
import ctypes
import json
import math
import re
import shutil
import subprocess
import unittest

from etude_case import EtudeCase, heavy, ik_scenario

SCENARIO = ik_scenario(trials=6, question="Is it true?") + """expect: [{metric: iterations, of: fixed, at_most: 1000}]
video: {compare: [fixed, least-squares], trials: [1]}
"""


def fingerprint(data):
    """Returns the digest that seals and journals use."""
    xxh3 = ctypes.CDLL("libxxhash.so.0").XXH3_64bits
    xxh3.restype = ctypes.c_uint64
    return f"{xxh3(data, ctypes.c_size_t(len(data))):016x}"


def reseal(folder):
    """Seals a folder again, as a forger would."""
    seal = json.loads((folder / "seal.json").read_text())
    others = ("report", "video", "seal.json", "signed.b2", "signed.b2.minisig")
    files = [path.relative_to(folder) for path in folder.rglob("*") if path.is_file()]
    seal["files"] = {str(name): fingerprint((folder / name).read_bytes()) for name in files if name.parts[0] not in others}
    (folder / "seal.json").write_text(json.dumps(seal))


def forge(path, old, new):
    text = path.read_text()
    assert old in text, (path, old)
    path.write_text(text.replace(old, new, 1))


class Verify(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario, cls.whole = cls.run_once(SCENARIO)
        made = cls.etude("report", cls.whole)
        assert made.returncode == 0, made.stderr

    def setUp(self):
        super().setUp()
        shutil.copytree(self.whole, self.out)

    def verify(self, *arguments, expect):
        result = self.etude("verify", self.out, *arguments)
        self.assertEqual(result.returncode, expect, result.stdout + result.stderr)
        return result.stdout + result.stderr

    def differences(self, *arguments):
        text = self.verify(*arguments, expect=1)
        return re.findall(r"^differs +([\w.]+)", text, re.M), text

    def test_one_shard_is_no_run_for_any_command_that_judges(self):
        shard = self.folder / "shard"
        self.ends(0, "run", self.scenario, "--shard", "1/2", "-o", shard)
        for command in (["verify", shard], ["verify", shard, "--sample", 0], ["gate", shard], ["compare", self.out, shard],
                        ["compare", shard, self.out], ["report", shard], ["cite", shard], ["rows", shard]):
            with self.subTest(command):
                said = self.ends(2, *command).stderr
                self.assertIn("is shard 1/2 of a run; 'etude merge DIR… -o DIR' makes one run of all its shards", said)

    def test_a_run_that_nobody_touched_agrees_line_by_line(self):
        text = self.verify(expect=0)
        for said in ("seal.json", "rows: exactly the rows", "files: only files that", "texts: only lines and keys", "host.json: only keys",
                     "manifest.json: equal to the manifest that a run of its scenarios writes", "worlds: every row",
                     "summary.json: equal to a summary computed again from 24 rows",
                     "20 of 20 cells, and 4 cells with a recording, run again", "report: "):
            self.assertRegex(text, f"(?m)^agrees   .*{re.escape(said)}")
        self.assertRegex(text, r"10 of 10 checks agree")
        self.assertIn("Etude ran every cell again that can be run again.", text)
        self.assertNotIn("run again:", self.verify("--sample", 0, expect=0))

    def test_a_change_without_a_new_seal_is_told_of_and_the_rest_all_the_same(self):
        forge(self.out / "host.json", '"jobs":', '"jobs":1')
        found, text = self.differences("--sample", 0)
        self.assertEqual(found, ["seal.json"])
        self.assertIn("host.json: was changed after the run wrote it", text)

    def forgeries(self):
        """Yields forgeries: name, change, the command that finds it, and the message."""
        summary, manifest = self.out / "summary.json", self.out / "manifest.json"
        host, times, metric = self.out / "host.json", self.out / "timings.jsonl", {
            "aggregate": "mean", "definition": "d", "direction": "lower", "domain": "own", "formula": "", "id": "ours", "inputs": {},
            "label": "l", "null_rule": "", "practical_reason": "", "practical_threshold": 1, "reads": "amount", "source": "", "unit": "cm",
            "vectors": [], "version": 1}
        recording = sorted((self.out / "recordings").iterdir())[0]
        curves = self.out / "series" / "ik.jsonl"
        number = re.search(r'"median":([0-9.e-]+)', summary.read_text())[1]
        height = re.search(r"\[([0-9.e-]{4,}),", recording.read_text())[1]
        error = re.search(r"\[([0-9.e-]{4,}),", curves.read_text())[1]
        row = re.search(r'"position_error_cm":([0-9.e-]+)', (self.out / "cells.jsonl").read_text())[1]
        return [
            ("a figure", lambda: forge(summary, f'"median":{number}', '"median":0.001'), "summary.json", "median was 0.001 and is"),
            ("a verdict", lambda: forge(summary, '"met"', '"unmet"'), "summary.json", "unmet"),
            ("the question", lambda: forge(manifest, "Is it true?", "Is it so?"), "summary.json", "question was"),
            ("an expectation", lambda: forge(manifest, "at_most: 1000", "at_most: 0.5"), "summary.json", "expectations"),
            ("a row", lambda: forge(self.out / "cells.jsonl", row, "0.25"), "summary.json", "was"),
            ("a recording", lambda: forge(recording, height, "1.25"), "cells", "recording was"),
            ("a curve", lambda: forge(curves, error, "1.25"), "cells", "curves was"),
            ("files more", lambda: [shutil.copy(recording, recording.with_name("ik~other.json")),
                                    (self.out / "notes.html").write_text("ours is best"),
                                    shutil.copytree(self.out / "series", self.out / "series" / "old")], "files",
             "notes.html does not belong to a run.*recordings/ik~other.json does not belong to a run.*"
             "series/old/ik.jsonl does not belong to a run"),
            ("pages and films more", lambda: [(self.out / "report" / "final.html").write_text("ours is best"),
                                              (self.out / "video").mkdir(exist_ok=True),
                                              (self.out / "video" / "best.mp4").write_bytes(b"")], "report",
             "final.html is not a file of this run.*best.mp4 is not a file of this run"),
            ("what only others read", lambda: [
                forge(manifest, '"schema":', '"suite":"x","schema":'),
                forge(self.out / "cells.jsonl", '"trial":0', '"our_error":0,"trial":0'),
                curves.write_text(curves.read_text() + curves.read_text().splitlines()[0] + "\n")], "texts",
             "'suite' appears twice.*cells.jsonl:1 differs from the text that a run writes.*ik.jsonl:25 differs from the text that a run writes"),
            ("a page", lambda: forge(self.out / "report" / "index.html", "Is it true?", "Is it so?"), "report", "index.html"),
            ("a style", lambda: forge(self.out / "report" / "index.html", "</body>", "<style>main{display:none}</style></body>"), "report",
             "index.html differs from a new report of this run"),
            ("a style among films", lambda: forge(self.out / "report" / "index.html", "<!--/media-->", "<style>main{display:none}</style>"
                                                  "<!--/media-->"), "report", "index.html differs from a new report of this run"),
            ("another verdict", lambda: forge(self.out / "report" / "index.html", '<p class="verdict">', '<p class="verdict">Ours is best. '),
             "report", "index.html differs from a new report of this run"),
            ("a gate", lambda: [self.etude("gate", self.out, "--unsealed"), forge(self.out / "report" / "gate.md", "gate of", "gate that passed of")],
             "report", "gate.md differs from a new report of this run"),
            ("a key of the manifest", lambda: forge(manifest, '"metrics":{', '"metrics":{"ours":7,'), "manifest.json", "metrics.ours was 7"),
            ("a metric", lambda: forge(manifest, '"packages":', f'"own_metrics":[{json.dumps(metric, separators=(",", ":"))}],"packages":'),
             "manifest.json", "own_metrics: no scenario defines the metric 'ours'"),
            ("a time", lambda: forge(times, '{"', '{"ours":1,"'), "texts", "timings.jsonl:1 differs from the text that a run writes"),
            ("times of no cell", lambda: times.write_text(times.read_text() + times.read_text().splitlines()[0] + "\n"), "texts",
             "timings.jsonl:25 differs from the text that a run writes"),
            ("a key of the machine", lambda: forge(host, '"jobs":', '"is_fast":true,"jobs":'), "host.json", "no run writes 'is_fast'"),
            ("a figure of the machine", lambda: forge(host, '"jobs":', '"jobs":"no","shards":[{}],"wall_seconds":'), "host.json",
             r"'jobs' is .*shards\[0\]: 'host' is missing.*differs from the text that a run writes"),
            ("the environment of the machine", lambda: forge(host, "LC_ALL=C.UTF-8", "LC_ALL=C"), "host.json",
             "'pinned_environment' has the digest [0-9a-f]{16}, but 'environment' in manifest.json is"),
            ("the environment of the manifest", lambda: self.forge_environment(manifest), "host.json",
             "'pinned_environment' has the digest [0-9a-f]{16}, but 'environment' in manifest.json is .*0123456789abcdef"),
            ("the seed", lambda: forge(manifest, '"suite":"ik","seed":1', '"suite":"ik","seed":777'), "manifest.json", "seed: it differs from the seeds of the scenarios"),
            ("a platform", lambda: forge(manifest, '"trials":', '"platform":"ours","trials":'), "manifest.json", "platform was"),
            ("a source", lambda: forge(manifest, '"sources":{', '"sources":{"ours":"best",'), "manifest.json", "'ours' is used by no scenario and by no other source"),
            ("a table", lambda: forge(self.out / "report" / "tables" / "ik.csv", "fixed", "fixes"), "report", "ik.csv"),
        ]

    def forge_environment(self, manifest):
        forge(manifest, json.loads(manifest.read_text())["environment"], "0123456789abcdef")

    def test_what_was_forged_and_sealed_anew_is_found(self):
        for i in range(len(self.forgeries())):
            name, change, found_by, said = self.forgeries()[i]
            with self.subTest(forged=name):
                change()
                reseal(self.out)
                replays = found_by == "cells" or name == "a platform"
                found, text = self.differences("--sample", 24 if replays else 0)
                self.assertIn(found_by, [words.lstrip("0123456789 ") or "cells" for words in found], text)
                self.assertIn("agrees   seal.json", text)
                self.assertRegex(text, re.compile(said, re.S))
            shutil.rmtree(self.out)
            shutil.copytree(self.whole, self.out)

    @heavy
    def test_a_sample_tells_its_dice_and_what_it_misses(self):
        def facts(*more):
            return self.facts("verify", self.out, "--sample", 7, *more)["sample"]
        first, second = facts(), facts()
        self.assertNotEqual(first["seed"], second["seed"])  # nobody can predict the seed
        self.assertEqual(facts("--sample-seed", first["seed"]), first)
        self.assertEqual((first["drawn"], first["cells"], first["recorded"]), (7, 20, 4))
        for missed, (method, forged, cells) in zip(first["missed"], [(None, 1, 20), ("ik/fixed", 5, 10), (None, 1, 20)]):
            self.assertEqual((missed["method"], missed["forged"], missed["cells"]), (method, forged, cells))
            self.assertAlmostEqual(missed["chance"], math.comb(20 - forged, 7) / math.comb(20, 7), 12)
        said = self.verify("--sample", 7, "--sample-seed", 5, expect=0)
        self.assertIn("65 % of the forgeries that change 1 of the 20 cells, 1 in 12 of the forgeries that change 5 of the cells of ik/fixed", said)
        self.assertIn("--sample-seed 5 draws the same sample again", said)
        self.assertEqual(self.facts("verify", self.out, "--sample", "all")["sample"]["missed"], [])
        self.assertIn("'some' is not a sample size; allowed: 0 to 10000000, or 'all'", self.verify("--sample", "some", expect=2))

    def test_a_seal_says_nothing_else(self):
        forge(self.out / "seal.json", '"version"', '"ours":"best","version"')
        self.assertEqual(self.differences("--sample", 0)[0], ["seal.json"])

    def keys(self, name, *arguments):
        secret, public = self.folder / f"{name}.key", self.folder / f"{name}.pub"
        subprocess.run(["minisign", "-G", *arguments, "-s", secret, "-p", public], check=True, capture_output=True,
                       input="a\na\n", text=True)
        return secret, public

    @unittest.skipUnless(shutil.which("minisign"), "needs minisign")
    def test_who_has_no_key_cannot_forge_what_is_signed(self):
        secret, public = self.keys("mine", "-W")
        self.assertIn("signed.b2.minisig", self.verify("--sample", 0, "--sign", secret, expect=0))
        text = public.read_text().splitlines()[1]
        for key in public, text:
            self.assertRegex(self.verify("--sample", 0, "--check", key, expect=0), r"agrees   signature of key [0-9A-F]{16}")
        # Other tools can check the signature without Etude.
        for command in ["minisign", "-V", "-p", public, "-m", "signed.b2"], ["b2sum", "-c", "--quiet", "signed.b2"]:
            self.assertEqual(subprocess.run(command, cwd=self.out, capture_output=True).returncode, 0, command)
        self.ends(0, "gate", self.out)  # a signed run works like any other
        self.assertIn("was made with key", self.differences("--sample", 0, "--check", self.keys("other", "-W")[1])[1])
        forge(self.out / "host.json", '"jobs":', '"jobs":1')  # only the signature notices this change
        reseal(self.out)
        self.verify("--sample", 0, expect=0)
        found, text = self.differences("--sample", 0, "--check", public)
        self.assertEqual(found, ["signature"])
        self.assertIn("seal.json: was changed after it was signed", text)
        forge(self.out / "signed.b2", "0", "1")
        self.assertIn("is not a valid signature of signed.b2", self.differences("--sample", 0, "--check", public)[1])

    def test_what_is_no_key_and_what_does_not_agree_signs_nothing(self):
        other = self.write("other.key", "untrusted comment: x\nRWQ=\n")
        self.assertIn("is not a secret key of minisign", self.verify("--sample", 0, "--sign", other, expect=2))
        self.assertIn("is neither a public key of minisign nor a file with a public key", self.verify("--sample", 0, "--check", other, expect=2))
        locked = b"Ed" + b"Sc" + b"B2" + bytes(152)  # the format of `minisign -G` without -W
        other = self.write("locked.key", "untrusted comment: x\n" + base64.b64encode(locked).decode() + "\n")
        self.assertIn("with a password", self.verify("--sample", 0, "--sign", other, expect=2))
        forge(self.out / "summary.json", '"met"', '"unmet"')
        reseal(self.out)
        self.verify("--sample", 0, "--sign", other, expect=1)
        self.assertFalse((self.out / "signed.b2").exists())

    @heavy
    def test_rows_that_no_cell_can_confirm_are_counted_by_method(self):
        shutil.rmtree(self.out)
        hello = '{"type": "hello", "protocol": 1, "name": "m", "version": "1"}'  # it never answers
        text = ik_scenario(trials=2) + f"  - {{name: mine, exec: [sh, -c, 'read x; echo ''{hello}''']}}\n"
        self.run_suite(self.write("ik.yaml", text), code=1)
        self.assertIn("ik/mine: all 4 cells: they run programs (--allow-exec allows it)", self.verify(expect=0))
        told = self.facts("verify", self.out)
        self.assertEqual((told["sample"]["cells"], len(told["not_verified"])), (8, 1))
        self.assertNotIn("Not verified", self.verify("--allow-exec", expect=0))

    def test_what_is_no_run_is_bad_input(self):
        self.ends(2, "verify", self.folder / "none")


class Forgers(EtudeCase):
    """Forgers who have the program, and let it summarise and seal what they forged."""

    WORLDS = 40  # of two methods; least-squares is the better one

    @classmethod
    def setUpClass(cls):
        shared = cls.shared_folder()
        cls.scenario = shared / "ik.yaml"
        cls.scenario.write_text(ik_scenario(trials=cls.WORLDS // 2))
        cls.shards = [shared / "1", shared / "2"]
        for shard in cls.shards:
            made = cls.etude("run", cls.scenario, "--shard", f"{shard.name}/2", "-j", 1, "-o", shard)
            assert made.returncode == 0, made.stderr

    def merge_forged(self, forge_line):
        """Merges the shards' journals after `forge_line(cell, text)` changed each line."""
        shards = []
        for shard in self.shards:
            shards.append(self.folder / shard.name)
            shutil.copytree(shard, shards[-1])
            journal = shards[-1] / "journal.jsonl"
            *lines, _ = journal.read_text().split("\n")
            for i, line in enumerate(lines[2:], 2):
                text = line[:line.rindex(',"sum":')]
                text = forge_line(int(re.match(r'{"cell":(\d+)', text)[1]), text)
                lines[i] = f'{text},"sum":"{fingerprint(text.encode())}"}}'
            journal.write_text("\n".join(lines) + "\n")
        merged = self.etude("merge", *shards, "-o", self.out)
        self.assertLess(merged.returncode, 2, merged.stderr)  # 1 means that a method has no answer

    def verdict(self):
        comparison = json.loads((self.out / "summary.json").read_text())["scenarios"][0]["conditions"][0]["comparisons"]
        return [one["verdict"] for one in comparison if one["metric"] == "orientation_error_deg"]

    def forge_all_but(self, spared):
        """Exchanges the two methods' answers in every world without a spared cell."""
        def swap(cell, text):
            return text if cell // 2 in spared else text.replace(f'{{"cell":{cell},', f'{{"cell":{cell ^ 1},', 1)
        self.merge_forged(swap)

    @heavy
    def test_cannot_foresee_which_cells_are_run_again(self):
        self.merge_forged(lambda cell, text: text)
        honest = self.verdict()
        names = [json.loads(line)["cell"] for line in (self.out / "cells.jsonl").read_text().splitlines()]
        drawn = json.loads(self.etude("replay", self.out, "--sample", 10, "--json").stdout)["cells"]
        spared = {names.index(one["cell"]) // 2 for one in drawn}
        for folder in self.out, self.folder / "1", self.folder / "2":
            shutil.rmtree(folder)
        self.forge_all_but(spared)
        self.assertNotEqual(self.verdict(), honest)
        # A forger who knows the sampling seed avoids the sampled cells; everything else is consistent.
        self.ends(0, "verify", self.out, "-j", 1, "--sample", 10, "--sample-seed", 1)
        self.ends(1, "verify", self.out, "-j", 1)  # misses with probability 10⁻¹¹
        told = json.loads(self.etude("verify", self.out, "-j", 1, "--sample", "all", "--json").stdout)
        self.assertFalse(told["agrees"])
        self.assertEqual(sum(len(check["differences"]) for check in told["checks"]), 2 * (self.WORLDS - len(spared)))

    def test_cannot_pass_off_the_answers_of_rivals_as_timeouts(self):
        def time_out(cell, text):
            if cell % 2 == 0:
                return text
            return f'{{"cell":{cell},"status":"timeout","reason":"took longer than 10 s","usage":[10,10,60]'
        self.merge_forged(time_out)
        said = self.etude("verify", self.out, "-j", 1, "--sample", 10, "--sample-seed", 2).stdout
        self.assertIn("status was timeout and is ok; either the machines differ, or the run was forged; this check cannot distinguish the two", said)
        self.assertIn(f"ik/least-squares: {self.WORLDS} of {self.WORLDS} cells ended with the status timeout on the run's machine", said)

    def test_cannot_exchange_the_names_of_methods(self):
        """Every row has its cell's answer in its cell's place, but under the other method's name."""
        def methods(fixed, least_squares):
            return ik_scenario(trials=4).split("  - ")[0] + (f"  - {{name: fixed, {fixed}, description: one}}\n"
                                                             f"  - {{name: least-squares, {least_squares}, description: other}}\n")
        ccd, squares = "solver: ccd, weights: fixed", "solver: damped-least-squares"
        lie = self.folder / "lie"
        lie.mkdir()
        (lie / "ik.yaml").write_text(methods(squares, ccd))
        self.run_suite(self.write("ik.yaml", methods(ccd, squares)), "-j", 1)
        self.run_suite(lie / "ik.yaml", "-j", 1, out=lie / "out")
        for name in "cells.jsonl", "series/ik.jsonl":
            lines = (lie / "out" / name).read_text().splitlines(keepends=True)
            (self.out / name).write_text("".join(b + a for a, b in zip(lines[::2], lines[1::2])))
        shutil.copy(lie / "out" / "summary.json", self.out)
        reseal(self.out)
        found = self.ends(1, "verify", self.out, "-j", 1, "--sample", "all")
        self.assertIn("row 1 is ik/joint_noise_deg=2/000/least-squares; expected ik/joint_noise_deg=2/000/fixed", found.stdout)
        self.assertIn("0 of 16 cells are identical to the run", self.ends(1, "replay", self.out).stdout)

    def test_cannot_change_what_worlds_were_drawn_from(self):
        scenario = self.write("t.yaml", "scenario: t\nquestion: q\ntask: tracking\nclips: ['builtin:clap', 'builtin:sway']\n"
                                        "trials: 2\nmethods: [{name: a, solver: damped-least-squares}]\n")
        self.run_suite(scenario, "-j", 1)
        self.ends(0, "verify", self.out, "-j", 1)
        cells = self.out / "cells.jsonl"
        units = re.findall(r'"units":(\[[^]]+\])', cells.read_text())
        self.assertEqual(len(set(units)), 2)
        forge(cells, f'"units":{units[0]}', f'"units":{units[1]}')
        reseal(self.out)
        found = self.ends(1, "verify", self.out, "--sample", 1)
        self.assertRegex(found.stdout, r"(?m)^differs +worlds: every row .*\n  t/-/000/a: units was")


if __name__ == "__main__":
    unittest.main()

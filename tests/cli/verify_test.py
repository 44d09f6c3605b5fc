"""`etude verify`: who forges a run and seals it anew is found out by its cells, or by its owner's signature."""
import base64
import ctypes
import json
import re
import shutil
import subprocess
import unittest

from etude_case import EtudeCase, ik_scenario

SCENARIO = ik_scenario(trials=6, question="Is it true?") + """expect: [{metric: iterations, of: fixed, at_most: 1000}]
video: {compare: [fixed, least-squares], trials: [1]}
"""


def digest_of(path):
    """As seals tell it."""
    xxh3 = ctypes.CDLL("libxxhash.so.0").XXH3_64bits
    xxh3.restype = ctypes.c_uint64
    data = path.read_bytes()
    return f"{xxh3(data, ctypes.c_size_t(len(data))):016x}"


def reseal(folder):
    """Seals a folder anew, as a forger would."""
    seal = json.loads((folder / "seal.json").read_text())
    for name in seal["files"]:
        seal["files"][name] = digest_of(folder / name)
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

    def test_a_run_that_nobody_touched_agrees_line_by_line(self):
        text = self.verify(expect=0)
        for said in ("seal.json", "rows: those that", "summary.json: computed again from 24 rows", "recordings",
                     "cells, the recorded ones among them, run again", "report: "):
            self.assertRegex(text, f"(?m)^agrees   .*{re.escape(said)}")
        self.assertRegex(text, r"6 of 6 agree")
        self.assertNotIn("run again", self.verify("--sample", 0, expect=0))

    def test_a_change_without_a_new_seal_is_told_of_and_the_rest_all_the_same(self):
        forge(self.out / "host.json", '"jobs":', '"jobs": ')
        found, text = self.differences("--sample", 0)
        self.assertEqual(found, ["seal.json"])
        self.assertIn("host.json: is not as the run wrote it", text)

    def forgeries(self):
        """Name, the forgery, what finds it, and what is said of it."""
        summary, manifest = self.out / "summary.json", self.out / "manifest.json"
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
            ("a recording more", lambda: shutil.copy(recording, recording.with_name("ik~other.json")), "recordings", "belongs to no cell"),
            ("a page", lambda: forge(self.out / "report" / "index.html", "Is it true?", "Is it so?"), "report", "index.html"),
            ("a table", lambda: forge(self.out / "report" / "tables" / "ik.csv", "fixed", "fixes"), "report", "ik.csv"),
        ]

    def test_what_was_forged_and_sealed_anew_is_found(self):
        for i in range(len(self.forgeries())):
            name, change, found_by, said = self.forgeries()[i]
            with self.subTest(forged=name):
                change()
                seal = json.loads((self.out / "seal.json").read_text())
                if name == "a recording more":
                    seal["files"]["recordings/ik~other.json"] = ""
                    (self.out / "seal.json").write_text(json.dumps(seal))
                reseal(self.out)
                replays = found_by in ("cells", "recordings")
                found, text = self.differences("--sample", 24 if replays else 0)
                self.assertIn(found_by, [words.lstrip("0123456789 ") or "cells" for words in found], text)
                self.assertIn("agrees   seal.json", text)
                self.assertIn(said, text)
            shutil.rmtree(self.out)
            shutil.copytree(self.whole, self.out)

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
        # Others need no Etude to check it.
        for command in ["minisign", "-V", "-p", public, "-m", "signed.b2"], ["b2sum", "-c", "--quiet", "signed.b2"]:
            self.assertEqual(subprocess.run(command, cwd=self.out, capture_output=True).returncode, 0, command)
        self.assertEqual(self.etude("gate", self.out).returncode, 0)  # what is signed is a run like any other
        self.assertIn("is of key", self.differences("--sample", 0, "--check", self.keys("other", "-W")[1])[1])
        forge(self.out / "host.json", '"jobs":', '"jobs": ')  # which nothing else would find
        reseal(self.out)
        self.verify("--sample", 0, expect=0)
        found, text = self.differences("--sample", 0, "--check", public)
        self.assertEqual(found, ["signature"])
        self.assertIn("seal.json: is not as it was signed", text)
        forge(self.out / "signed.b2", "0", "1")
        self.assertIn("does not hold", self.differences("--sample", 0, "--check", public)[1])

    def test_what_is_no_key_and_what_does_not_agree_signs_nothing(self):
        other = self.write("other.key", "untrusted comment: x\nRWQ=\n")
        self.assertIn("no secret key of minisign", self.verify("--sample", 0, "--sign", other, expect=2))
        self.assertIn("no public key of minisign", self.verify("--sample", 0, "--check", other, expect=2))
        locked = b"Ed" + b"Sc" + b"B2" + bytes(152)  # as minisign -G without -W writes them
        other = self.write("locked.key", "untrusted comment: x\n" + base64.b64encode(locked).decode() + "\n")
        self.assertIn("with a password", self.verify("--sample", 0, "--sign", other, expect=2))
        forge(self.out / "summary.json", '"met"', '"unmet"')
        reseal(self.out)
        self.verify("--sample", 0, "--sign", other, expect=1)
        self.assertFalse((self.out / "signed.b2").exists())

    def test_what_is_no_run_is_bad_input(self):
        self.assertEqual(self.etude("verify", self.folder / "none").returncode, 2)


if __name__ == "__main__":
    unittest.main()

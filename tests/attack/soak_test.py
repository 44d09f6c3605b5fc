"""Tests the driver of the attacks: it repeats no round, and shows failed rounds in the table and in the exit code."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import soak

PASSES = "import unittest\nclass T(unittest.TestCase):\n    def test_a(self): pass\n    @unittest.skip('')\n    def test_b(self): pass\nunittest.main()\n"
FAILS = PASSES.replace("def test_a(self): pass", "def test_a(self): self.fail()")


class Soak(unittest.TestCase):
    def run_soak(self, folder, text, *words):
        test = pathlib.Path(folder) / "fake_test.py"
        test.write_text(text)
        said = io.StringIO()
        with mock.patch.object(soak, "TESTS", {"fake": test}), mock.patch.object(soak.os, "getuid", lambda: 1000), \
                mock.patch.object(sys, "argv", ["soak.py", "--only", "fake", "--out", str(folder), "--etude", "/bin/true", *words]), \
                contextlib.redirect_stdout(said):
            code = soak.main()
        return code, said.getvalue()

    def test_a_test_is_counted_and_what_failed_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            code, said = self.run_soak(folder, FAILS)
            self.assertEqual(code, 1)
            self.assertIn("fake, round 0: ['test_a']", said)
            self.assertRegex(said, r"\| fake \| user \| 1 \| 2 tests, 1 of them skipped \| 1 \| \d+ \|")
            self.assertIn("Not root", said)
            # The soak continues where it stopped: the round is not played again.
            self.assertEqual(self.run_soak(folder, PASSES)[0], 1)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.run_soak(folder, PASSES)[0], 0)

    def test_rounds_of_an_attack_are_added_up(self):
        with tempfile.TemporaryDirectory() as folder:
            record = soak.Record(pathlib.Path(folder), hours=1)
            for number in range(3):
                record.play("kills", number, lambda: {"killed": 2, "wrong": ["sh"] if number == 1 else []})
            rows = list(soak.rows_of(soak.Record(pathlib.Path(folder), 0), "root"))
            self.assertEqual([wrong for _, wrong in rows], [1])
            self.assertRegex(rows[0][0], r"\| kills \| root \| 3 \| 6 processes killed \| 1 \| 0 \|")


if __name__ == "__main__":
    unittest.main()

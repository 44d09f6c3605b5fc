"""The tables of verdicts in docs/figures/verdicts.txt are what the program measures, and docs/findings/verdicts.md shows lines of them."""

import os
import re
import subprocess
import unittest
from pathlib import Path


def rows(markdown):
    """The numbers of every line of a table, but for its head."""
    lines = [line for line in markdown.splitlines() if re.match(r"\| \d", line)]
    return [[float(number) for number in re.findall(r"\d+(?:\.\d+)?", line.replace("t₃", ""))] for line in lines]


class Published(unittest.TestCase):
    def test_the_page_shows_lines_of_what_was_measured(self):
        page = Path("docs/findings/verdicts.md").read_text()
        shown = re.search(r"<!-- verdicts -->\n(.*?)<!-- /verdicts -->", page, re.S).group(1)
        published = Path("docs/figures/verdicts.txt").read_text().splitlines()
        lines = [line for line in shown.splitlines() if line]
        self.assertGreater(len(lines), 12)
        self.assertEqual([line for line in lines if line not in published], [])

    def test_the_program_measures_what_was_published(self):
        published = Path("docs/figures/verdicts.txt").read_text()
        command = [os.environ["ETUDE"], "gate", "--self-test", "--verdicts", "--repetitions", "10000"]
        measured = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(measured.returncode, 0, measured.stdout[-500:])
        expected, found = rows(published), rows(measured.stdout)
        self.assertEqual(len(expected), 67)
        self.assertEqual(len(found), 67)
        for line, (a, b) in enumerate(zip(expected, found)):
            self.assertEqual(len(a), len(b), line)
            # Another library of mathematics may draw a last bit otherwise.
            self.assertLess(max(abs(x - y) for x, y in zip(a, b)), 1.01, line)


if __name__ == "__main__":
    unittest.main()

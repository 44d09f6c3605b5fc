"""Runs every ```sh block of README and the guide, in the order of its page, in one scratch folder per page, with the
built program first in PATH. The word after `sh` gives the kind of a block:

    ```sh            run here and on every change
    ```sh heavy      takes long: run with ETUDE_HEAVY=1
    ```sh not-run    needs what no test has (another machine, films); its options must be known, and NOT_RUN counts it
"""
import functools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import protocol_page

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from source_files import source_files  # noqa: E402

ETUDE = pathlib.Path(os.environ["ETUDE"]).resolve()
ROOT = pathlib.Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs" / "guide").glob("*.md"))]
NOT_RUN = {"README.md": 2, "ci.md": 1, "cite.md": 1, "cluster.md": 2, "coach.md": 1, "install.md": 3, "own-cameras.md": 3,
           "own-recordings.md": 1}
WORDS = 700  # most words per page
MADE = {ROOT / "docs" / "reference" / f"{name}.md" for name in ("commands", "keys", "metrics", "protocol", "recordings")}  # by the program


class Wrong(Exception):
    pass


def blocks(text):
    """Returns a page's shell blocks: (line, kind, commands). A command outside such a block is an error, because no
    test runs it."""
    found, fence, commands = [], None, []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```") and fence is None:
            fence, commands = (number, line[3:].strip()), []
        elif line.startswith("```"):
            if fence[1].split(" ")[0] in ("", "sh", "bash", "console"):
                if fence[1] not in ("sh", "sh heavy", "sh not-run"):
                    raise Wrong(f"line {fence[0]}: '```{fence[1]}' is none of: sh, sh heavy, sh not-run")
                found.append((fence[0], fence[1][3:], "\n".join(commands)))
            fence = None
        elif fence:
            commands.append(line)
        elif re.match(r" {4,}\S", line):
            raise Wrong(f"line {number}: commands stand in ```sh blocks")
    if fence:
        raise Wrong(f"line {fence[0]}: this block does not end")
    return found


def words(text):
    """Returns the words that a reader sees; table rules do not count."""
    seen = re.sub(r"<!--.*?-->|!\[.*?\]\(.*?\)|\]\(.*?\)", " ", text, flags=re.S)
    return sum(bool(re.search(r"\w", word)) for word in seen.split())


def anchors(text):
    """Returns the anchors of a page: its headings as GitHub writes them."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)
    return {re.sub(r"[^\w -]", "", re.sub(r"\[(.*?)\]\(.*?\)", r"\1", heading).lower()).replace(" ", "-")
            for heading in re.findall(r"^#+ +(.*?) *$", text, re.M)}


def dead_links(root, pages):
    """Returns links of pages to missing files and headings, and the number of links."""
    dead, count = [], 0
    for page in pages:
        text = re.sub(r"^```.*?^```$|`[^`\n]*`", "", page.read_text(), flags=re.S | re.M)
        for link in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            if not target.exists() or (anchor and target.suffix == ".md" and anchor not in anchors(target.read_text())):
                dead.append(f"{page.relative_to(root)}: {link}")
    return dead, count


@functools.cache
def commands_page():
    """Returns the page of every command's help, by the program."""
    return subprocess.run([ETUDE, "man", "--markdown"], capture_output=True, text=True, check=True).stdout


def unknown_options(commands):
    """Returns options in commands that are not run, and that etude's help does not have."""
    helps, found = dict(re.findall(r"^## etude (.*?)\n(.*?)(?=^## |\Z)", commands_page(), re.M | re.S)), []
    for name, rest in re.findall(r"(?:^|[|&;(]) *etude (\w[\w-]*)([^|&;\n]*)", commands.replace("\\\n", " "), re.M):
        if name not in helps:
            found.append(name)
            continue
        for option in re.findall(r"(?<=\s)(-o|--[\w-]+)(?=[\s=]|$)", rest.split(" -- ")[0]):
            if not re.search(rf"(?<![\w-]){option}(?![\w-])", helps[name]):
                found.append(f"{name} {option}")
    return found


def run_page(text, heavy):
    """Runs a page's blocks; returns their number. Raises Wrong with the line and the output."""
    count = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder, home = pathlib.Path(scratch) / "here", pathlib.Path(scratch) / "home"
        folder.mkdir()
        (home / "bin").mkdir(parents=True)
        (home / "bin" / "etude").symlink_to(ETUDE)
        environment = {"PATH": f"{home}/bin:/usr/bin:/bin", "HOME": str(home), "LANG": "C.UTF-8"}
        for line, kind, commands in blocks(text):
            if kind == "not-run":
                if unknown := unknown_options(commands):
                    raise Wrong(f"line {line}: etude knows no {', '.join(unknown)}")
            elif kind == "" or heavy:
                result = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, env=environment, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                if result.returncode != 0:
                    raise Wrong(f"line {line}: exit code {result.returncode}\n{commands}\n\n{result.stdout[-3000:]}")
                count += 1
    return count


class Pages(unittest.TestCase):
    def test_every_block_runs(self):
        heavy, ran = bool(os.environ.get("ETUDE_HEAVY")), 0
        for page in PAGES:
            with self.subTest(page.name):
                try:
                    ran += run_page(page.read_text(), heavy)
                except Wrong as error:
                    self.fail(f"{page.relative_to(ROOT)}, {error}")
        self.assertGreaterEqual(ran, 30)

    def test_what_is_not_run_is_counted(self):
        self.assertEqual(NOT_RUN, {page.name: count for page in PAGES
                                   if (count := sum(kind == "not-run" for _, kind, _ in blocks(page.read_text())))})

    def test_pages_are_short(self):
        self.assertEqual([f"{page.name}: {count} words" for page in PAGES if (count := words(page.read_text())) > WORDS], [])
        self.assertEqual(words("one [two](three.md) <!-- four -->\n|---|\n![five](six.png)"), 2)

    def test_all_pages_together_are_short(self):
        written = [page for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))] if page not in MADE]
        total = sum(words(page.read_text()) for page in written)
        print(f"{total} words on {len(written)} pages")
        self.assertLessEqual(total, 37_000)

    def test_findings_have_their_form(self):
        pages = sorted(set((ROOT / "docs" / "findings").glob("*.md")) - {ROOT / "docs/findings/README.md"})
        self.assertGreater(len(pages), 15)
        listed = (ROOT / "docs/findings/README.md").read_text()
        for page in pages:
            with self.subTest(page.name):
                text = page.read_text()
                places = [text.find(part) for part in ("\n**Answer.**", "\n|--", "\n**Where it fails.**", "\n**How it was measured.**")]
                self.assertNotIn(-1, places)
                self.assertEqual(places[2:], sorted(places[2:]))
                self.assertLess(places[0], places[2])
                answer = re.match(r".*?(?=\n\n|\n<!--|$)", text[places[0] + 1:], re.S)[0]
                said = answer.partition("**Answer.**")[2]
                self.assertIn(len(re.findall(r"[.!?](?=\s|$)", said)), range(3, 7), "sentences")
                self.assertLessEqual(len(said.split()), 95, "words")
                self.assertLessEqual(words(text), 1_200)
                self.assertIn(f"]({page.name})", listed)

    def test_verdicts_shows_lines_of_what_was_measured(self):
        page = (ROOT / "docs/findings/verdicts.md").read_text()
        shown = re.search(r"<!-- verdicts -->\n(.*?)<!-- /verdicts -->", page, re.S)[1].splitlines()
        published = (ROOT / "docs/figures/verdicts.txt").read_text().splitlines()
        self.assertGreater(len(shown), 12)
        self.assertEqual([line for line in shown if line and line not in published], [])

    def test_links_lead_somewhere(self):
        dead, count = dead_links(ROOT, [ROOT / name for name in source_files(ROOT) if name.suffix == ".md"])
        self.assertEqual(dead, [])
        self.assertGreater(count, 150)
        with tempfile.TemporaryDirectory() as scratch:
            page = pathlib.Path(scratch).resolve() / "page.md"
            page.write_text("# A b: `c`\n[1](#a-b-c) [2](#d) [3](no.md) [4](page.md#a-b-c) `[5](no.md)` [6](https://host/x)\n")
            self.assertEqual(dead_links(page.parent, [page]), (["page.md: #d", "page.md: no.md"], 4))

    def test_every_room_is_one_click_from_the_architecture(self):
        page = (ROOT / "docs" / "architecture.md").read_text()
        rooms = [path.relative_to(ROOT) for floor in ("engine", "sim", "io", "bench", "tools", "reports", "cli")
                 for path in sorted((ROOT / floor).rglob("README.md"))]
        self.assertGreater(len(rooms), 70)
        self.assertEqual([str(room) for room in rooms if f"](../{room})" not in page], [])

    def test_the_reference_has_every_command(self):
        page = commands_page()
        self.assertEqual((ROOT / "docs/reference/commands.md").read_text(), page, "write it anew: scripts/docs")
        for words in (["gate"], ["clip", "info"]):
            printed = subprocess.run([ETUDE, *words, "--help"], capture_output=True, text=True, check=True).stdout.strip("\n")
            self.assertIn(f"\n## etude {' '.join(words)}\n\n```text\n{printed}\n```\n", page)

    def test_the_reference_has_the_whole_protocol(self):
        schema = protocol_page.read_schema()
        self.assertEqual((ROOT / "docs/reference/protocol.md").read_text(), protocol_page.page(schema), "write it anew: scripts/docs")
        fields = [(name, key, value) for name, one in schema["$defs"].items() for key, value in one.get("properties", {}).items()]
        self.assertGreater(len(fields), 200)
        self.assertEqual([(name, key) for name, key, value in fields if not re.match(r"\S.*\.$", value.get("description", ""))], [])

    def test_what_is_wrong_is_found(self):
        for text, complaint in [("```sh\necho fine\nfalse\n```\n", "line 1: exit code 1"),
                                ("```sh\nfalse | cat\n```\n", "exit code 1"),
                                ("\n```sh\netude runn quick\n```\n", "line 2: exit code"),
                                ("```bash\ntrue\n```\n", "is none of"),
                                ("```sh skip\ntrue\n```\n", "is none of"),
                                ("```\netude run\n```\n", "is none of"),
                                ("    etude run quick\n", "commands stand in"),
                                ("```sh\ntrue\n", "does not end"),
                                ("```sh not-run\netude run quick --job 4\n```\n", "etude knows no run --job"),
                                ("```sh not-run\netude runn quick\n```\n", "etude knows no runn")]:
            with self.subTest(complaint), self.assertRaisesRegex(Wrong, re.escape(complaint)):
                run_page(text, heavy=False)
        self.assertEqual(run_page("```sh\necho 1 > a\n```\n```sh heavy\nfalse\n```\n```sh\ntest -f a\n```\n", heavy=False), 2)


if __name__ == "__main__":
    unittest.main()

"""Tests that every command's help ends with three examples of this command, and that the names in them exist."""
import os
import re
import shlex
import shutil
import subprocess
import unittest

from etude_case import COMMAND_GROUPS, ETUDE, EtudeCase, commands_in


# Typed texts, and the only word that completes each.
ASKED = ["ga", "gate --basel", "clip in", "clip info --js", "run full/ik_we", "scenario copy full/ik_we", "help clip rend", "hel",
         "completion z"]
COMPLETED = ["gate", "--baseline", "info", "--json", "full/ik_weights", "full/ik_weights", "render", "help", "zsh"]


class Help(EtudeCase):
    def test_of_every_command_ends_with_examples_that_it_understands(self):
        seen, waiting = {}, [()]
        while waiting:
            words = waiting.pop()
            text = self.etude(*words, "--help").stdout
            seen[words] = text
            waiting += [(*words, name) for name in commands_in(text)]
        self.assertGreater(len(seen), 35)
        for words, text in seen.items():
            if not words:
                continue
            with self.subTest(" ".join(words)):
                self.assertIn("Examples:\n", text)
                lines = text.split("Examples:\n")[1].strip().splitlines()
                self.assertEqual(len(lines), 3, lines)
                for line in lines:
                    call = shlex.split(line[line.index("etude "):].split("|")[0].split(">")[0], comments=True)[1:]
                    path = ()
                    while (*path, *call[:1]) in seen and call:
                        path, call = (*path, call[0]), call[1:]
                    self.assertTrue(path, line)
                    for word in call[:call.index("--")] if "--" in call else call:
                        if word.startswith("-") and word != "-":
                            self.assertRegex(seen[path], rf"(?m)^  (-\w,)?{re.escape(word)}\b|^  {re.escape(word)}[ ,]", line)

    def test_lists_every_command_in_a_group(self):
        text = self.etude("--help").stdout
        self.assertNotIn("Subcommands:", text)
        self.assertEqual([group for group in COMMAND_GROUPS if f"\n{group}:\n" in text], COMMAND_GROUPS)
        self.assertIn(" ".join(text.split("\nUsage")[0].split())[:60], " ".join(open("README.md").read().replace("**", "").split()))

    def test_of_no_command_names_the_nearest(self):
        for words in (["help", "repotr"], ["repotr", "--help"], ["help", "clip", "inof"]):
            asked = self.etude(*words)
            self.assertEqual((asked.returncode, asked.stdout), (2, ""), words)
            self.assertIn("did you mean '" + ("info" if "clip" in words else "report") + "'", asked.stderr)

    def test_completion_knows_every_command_and_its_options(self):
        script = self.write("complete.bash", self.etude("completion", "bash").stdout + """
_try() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _etude; echo "${COMPREPLY[*]}"; }
""" + "".join(f"_try etude {line}\n" for line in ASKED))
        said = subprocess.run(["bash", script], capture_output=True, text=True, check=True)
        self.assertEqual(said.stdout.splitlines(), COMPLETED)
        self.assertEqual(said.stderr, "")

    @unittest.skipUnless(shutil.which("zsh"), "needs zsh")
    def test_completion_of_zsh_knows_the_same(self):
        script = self.write("complete.zsh", f"""compadd() {{ shift; print -- ${{(M)@:#$words[CURRENT]*}} }}; _files() {{ }}
_etude() {{
{self.etude("completion", "zsh").stdout}}}
""" + "".join(f"words=(etude {line}); CURRENT=$#words; _etude\n" for line in ASKED))
        said = subprocess.run(["zsh", "-f", script], capture_output=True, text=True, check=True)
        self.assertEqual((said.stdout.splitlines(), said.stderr), (COMPLETED, ""))

    @unittest.skipUnless(shutil.which("fish"), "needs fish")
    def test_completion_of_fish_knows_the_same(self):
        script = self.write("complete.fish", self.etude("completion", "fish").stdout)
        for line, completed in zip(ASKED, COMPLETED):
            said = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C 'etude {line}'"], cwd=self.folder,
                                  env={"HOME": str(self.folder), "PATH": os.environ["PATH"]}, capture_output=True, text=True, check=True)
            self.assertEqual(([option.split("\t")[0] for option in said.stdout.splitlines()], said.stderr), ([completed], ""), line)

    def test_manual_pages_are_of_every_command(self):
        self.ends(0, "man", self.folder / "man")
        pages = sorted(path.name for path in (self.folder / "man").iterdir())
        self.assertIn("etude.1", pages)
        self.assertIn("etude-clip-info.1", pages)
        self.assertGreater(len(pages), 35)
        self.assertIn("\n.TP\n\\fB\\-\\-baseline\\fR \\fITEXT\\fR\n", (self.folder / "man" / "etude-gate.1").read_text())


if __name__ == "__main__":
    unittest.main()

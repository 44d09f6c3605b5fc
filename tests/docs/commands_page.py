"""The page docs/reference/commands.md, made of the help of every command.

    commands_page.py ETUDE > docs/reference/commands.md
"""
import re
import subprocess
import sys

HEAD = """# Every command

Written by `scripts/docs` from each command's own help; a test compares the two.
"""


def help_of(etude, *names):
    return subprocess.run([etude, *names, "--help"], capture_output=True, text=True, check=True).stdout.strip("\n")


def commands_in(text):
    """The names under 'Subcommands:' of a help."""
    listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text + "\n", re.M)
    return re.findall(r"^  (\w[\w-]*) ", listed[1], re.M) if listed else []


def page(etude):
    sections, waiting = [HEAD], [(name,) for name in commands_in(help_of(etude))]
    while waiting:
        names, *waiting = waiting
        text = help_of(etude, *names)
        sections.append(f"\n## etude {' '.join(names)}\n\n```text\n{text}\n```\n")
        waiting = [(*names, name) for name in commands_in(text)] + waiting
    return "".join(sections)


if __name__ == "__main__":
    sys.stdout.write(page(sys.argv[1]))

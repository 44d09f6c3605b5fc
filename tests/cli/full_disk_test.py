"""Tests places that accept no more data: a full disk, a limit on file sizes, a read-only disk, another user's
folder. Every command that writes ends with exit code 3 and one sentence, and leaves no incomplete file."""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import unittest

import etude_case
from etude_case import HEAVY, EtudeCase, ik_scenario

ETUDE = os.path.abspath(etude_case.ETUDE)

SCENARIO = ik_scenario(trials=4) + "video: {compare: [fixed], trials: [0]}\n"
PLACE = "PLACE"  # placeholder for the folder that accepts no more data
COMMANDS = {
    "run": ["run", "s.yaml", "-o", "PLACE/out", "--jobs", "1"],
    "run --overwrite": ["run", "s.yaml", "-o", "PLACE/run", "--overwrite", "--jobs", "1"],
    "merge": ["merge", "shard-1", "shard-2", "-o", "PLACE/merged"],
    "report": ["report", "PLACE/run", "--no-video"],
    "gate": ["gate", "PLACE/run"],
    "gate --update": ["gate", "run", "--baseline", "PLACE/b.json", "--update"],
    "rows": ["rows", "run", "-o", "PLACE/rows.jsonl"],
    "replay --pack": ["replay", "run", "--cell", "CELL", "--pack", "PLACE/cell.etude"],
    "export": ["export", "s.yaml", "-o", "PLACE/data"],
    "scenario copy": ["scenario", "copy", "quick", "PLACE/quick"],
    "clip convert": ["clip", "convert", "builtin:clap", "PLACE/clap.bvh"],
    "clip render": ["clip", "render", "builtin:clap", "-o", "PLACE/sheet.png", "--frames", "2", "--size", "96x120"],
    "clip grades": ["clip", "grades", "builtin:clap", "-o", "PLACE/grades.csv"],
    "bridge": ["bridge", "builtin:clap", "builtin:sway", "-o", "PLACE/tags.xml"],
    "teach": ["teach", "clap.csv", "-o", "PLACE/moves.yaml"],
}
SLOW = {
    "score": ["score", "s.yaml", "answers", "-o", "PLACE/scored", "--allow-missing"],
    "train": ["train", "builtin:*", "-o", "PLACE/learnt.yaml", "--hold-out", "0", "--generations", "1", "--population", "8"],
    "clip render film": ["clip", "render", "builtin:clap", "-o", "PLACE/film.mp4"],
    "report with films": ["report", "PLACE/run"],
}
# Leaves $FREE bytes in the place, runs the command, and prints the temporary files that it left.
FULL = """mount -t tmpfs -o size=4m tmpfs "$PLACE" && cp -r run "$PLACE" && cat /dev/zero > "$PLACE/filler" 2>/dev/null
truncate -s "-$FREE" "$PLACE/filler"
"$@"; code=$?
find "$PLACE" -name '*partial*' -o -name 'etude-temporary-*' -o -name 'etude-kept-*'
exit $code"""


class FullDisk(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = cls.shared_folder()
        cls.shared.chmod(0o755)
        (cls.shared / "s.yaml").write_text(SCENARIO)
        (cls.shared / "answers").mkdir()
        for words in (["run", "s.yaml", "-o", "run"], *(["run", "s.yaml", "-o", f"shard-{i}", "--shard", f"{i}/2"] for i in (1, 2)),
                      ["clip", "convert", "builtin:clap", "clap.csv"]):
            made = subprocess.run([ETUDE, *words], cwd=cls.shared, capture_output=True, text=True)
            assert made.returncode == 0, made.stderr
        cls.cell = json.loads((cls.shared / "run" / "cells.jsonl").read_text().splitlines()[0])["cell"]

    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        self.place = self.folder / "place"
        shutil.copytree(self.shared / "run", self.place / "run")

    def words(self, name):
        return [ETUDE, *(word.replace(PLACE, str(self.place)).replace("CELL", self.cell) for word in (COMMANDS | SLOW)[name])]

    def call(self, words, **how):
        return subprocess.run(words, cwd=self.shared, capture_output=True, text=True, timeout=300, **how)

    def full(self, words):
        return self.call(["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", FULL, "sh", *words],
                         env=os.environ | {PLACE: str(self.place), "FREE": "16K" if words[1] == "run" else "0"})

    def limited(self, words):
        return self.call(words, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (16, 16)))

    def read_only(self, words):
        return self.call(["bwrap", "--dev-bind", "/", "/", "--ro-bind", self.place, self.place, *words])

    def forbidden(self, words):
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.getuid() == 0 else {}
        for path in (self.place, *self.place.rglob("*")):
            if path.is_dir():
                path.chmod(0o555)
        try:
            return self.call(words, **nobody)
        finally:
            for path in (self.place, *self.place.rglob("*")):
                if path.is_dir():
                    path.chmod(0o755)

    def check(self, name, setting):
        before = sorted(self.place.rglob("*"))
        ended = getattr(self, setting)(self.words(name))
        with self.subTest(command=name, setting=setting):
            complaints = [line for line in ended.stderr.splitlines() if line.startswith("etude: ")]
            self.assertEqual(ended.returncode, 3, ended.stdout[-500:] + ended.stderr)
            self.assertEqual(len(complaints), 1, ended.stderr)
            self.assertTrue(complaints[0].startswith("etude: this machine: "), complaints)
            self.assertNotIn("partial", ended.stdout + " ".join(path.name for path in self.place.rglob("*")))
            if setting in ("read_only", "forbidden"):
                self.assertEqual(sorted(self.place.rglob("*")), before)

    def test_whatever_writes_tells_that_the_place_takes_no_more(self):
        settings = ("full", "limited", "read_only", "forbidden")
        names = COMMANDS | SLOW if HEAVY else COMMANDS
        for number, name in enumerate(names):
            for setting in settings if HEAVY else settings[number % 4:number % 4 + 1]:
                self.check(name, setting)

    def test_what_is_wrong_with_a_name_is_bad_input(self):
        (self.folder / "file").touch()
        for name in ("file/x/clap.bvh", "x" * 300 + ".bvh"):
            refused = self.call([ETUDE, "clip", "convert", "builtin:clap", self.folder / name])
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertNotIn("this machine", refused.stderr)


if __name__ == "__main__":
    unittest.main()

"""Tests an installed Etude: it is found by name from any folder and by any user, and gives the bytes of the build
tree. Heavy: installs a package in a bare Debian root that mmdebstrap makes; skipped if no root can be made."""
import os
import pathlib
import platform
import re
import shlex
import shutil
import subprocess
import unittest

from ci_files_test import CI, containerfile
from etude_case import ETUDE, EtudeCase, heavy

BUILD = pathlib.Path(ETUDE).resolve().parent
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "library"
SUITE = "quick/ik"


class Installed(EtudeCase):
    def same_as_here(self, out, suite, *options):
        here = self.folder / "here"
        subprocess.run([ETUDE, "run", suite, *map(str, options), "-o", here], check=True, capture_output=True)
        for name in ("cells.jsonl", "summary.json"):
            self.assertEqual((here / name).read_bytes(), (out / name).read_bytes(), name)

    @heavy
    def test_a_prefix_that_was_moved_finds_what_it_ships(self):
        prefix, moved, empty = self.folder / "prefix", self.folder / "moved", self.folder / "empty"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        prefix.rename(moved)
        empty.mkdir()
        etude = moved / "bin" / "etude"

        def run(*words):
            return subprocess.run([etude, *map(str, words)], cwd=empty, capture_output=True, text=True)

        self.assertIn("full/ik_weights ", run("list", "scenarios").stdout)
        result = run("run", SUITE, "--trials", 6, "-o", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.same_as_here(empty / "out", SUITE, "--trials", 6)
        manifest = (empty / "out" / "manifest.json").read_text()
        for path in str(moved), str(BUILD), "/usr/share":
            self.assertNotIn(path, manifest)
        # A local folder without scenarios is not used. A local folder with scenarios is used instead of the shipped
        # one, and this is reported.
        (empty / "quick").mkdir()
        (empty / "quick" / "notes.txt").touch()
        told = run("run", "quick", "--dry-run")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual("etude: quick: this folder contains no scenario (*.yaml), so etude uses its own scenario with this name\n",
                         told.stderr)
        self.assertEqual(run("scenario", "copy", SUITE, "quick").returncode, 0)
        wins = run("run", "quick", "--trials", 6, "-o", "mine")
        self.assertIn("quick: etude uses this file or folder instead of its own scenario with the same name", wins.stderr)
        twice = run("scenario", "copy", SUITE, "quick")
        self.assertEqual(twice.returncode, 2)
        self.assertIn("already exists; nothing was copied", twice.stderr)
        unknown = run("run", "ful/ik_weights")
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("did you mean 'full/ik_weights'?", unknown.stderr)
        self.assertIn("@software{etude,", run("cite", "out").stdout)
        self.assertTrue((moved / "share" / "man" / "man1" / "etude-run.1.gz").exists())
        self.links_lead_somewhere(moved / "share" / "doc" / "etude")
        self.assertTrue(os.access(moved / "share" / "etude" / "ci" / "gate", os.X_OK))

    def links_lead_somewhere(self, docs):
        """Checks every link of an installed page, except links to source folders, which are not installed."""
        rooms, followed = {"engine", "sim", "io", "bench", "tools", "reports", "cli", "tests", "CONTRIBUTING.md"}, 0
        for page in docs.rglob("*.md"):
            text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(), flags=re.S)
            for link in re.findall(r"\]\((?!\w+:)([^)#\s]+)", text):
                place = pathlib.Path(os.path.normpath(page.parent / link))
                if place.relative_to(docs).parts[0] not in rooms:
                    self.assertTrue(place.exists(), f"{page}: {link}")
                    followed += 1
        self.assertGreater(followed, 100)

    @heavy
    def test_a_package_runs_in_a_bare_root_as_an_ordinary_user(self):
        self.make_packages()
        package = next(self.folder.glob("etude_*.deb"))
        # Runs the steps of ci/Containerfile in a root, without a container builder.
        image = containerfile((CI / "Containerfile").read_text())
        self.assertEqual(image[:2], [["FROM", "debian:13"], ["COPY", "etude_*.deb /tmp/"]])
        steps = [f"chroot \"$1\" sh -c {shlex.quote(words)}" for name, words in image if name == "RUN"]
        root = self.make_root(f"copy-in {package} /tmp", *steps)
        self.assertFalse((root / "usr" / "bin" / "c++").exists(), "a compiler came along")
        told = self.run_inside(root, "etude run quick -o out",
                               "etude gate out --baseline /usr/share/etude/scenarios/baselines/quick.json",
                               "etude report out --no-video", "etude clip convert builtin:clap own.bvh",
                               "etude run quick/capture --clips own.bvh --trials 1 -o own",
                               "cp -r /usr/share/etude/examples/outside-methods .",
                               "etude check-method --task ik --no-fence -- python3 outside-methods/ik_dls.py")
        self.assertIn("Gate: pass", told)
        self.assertIn("9 of 9", told)
        self.same_as_here(root / "home" / "etude" / "out", "quick")

    @heavy
    def test_the_librarys_package_builds_programs_in_a_root_with_a_compiler(self):
        self.make_packages()
        clip = self.folder / "clap.bvh"
        self.ends(0, "clip", "convert", "builtin:clap", clip)
        packages = [next(self.folder.glob(f"{name}_*.deb")) for name in ("libetude", "libetude-dev")]
        inside = " ".join(f"/tmp/{package.name}" for package in packages)
        root = self.make_root(f"copy-in {' '.join(map(str, packages))} /tmp", f"copy-in {clip} {EXAMPLES} /srv", 'chroot "$1" sh -c ' +
                              shlex.quote(f"apt-get update -q && apt-get install -y -q {inside} g++ cmake make libosmesa6 && "
                                          "useradd --create-home etude"))
        self.assertFalse((root / "usr" / "bin" / "etude").exists(), "the program came along")
        told = self.run_inside(root, "cmake -S /srv/library -B built", "cmake --build built", "built/thousand_poses",
                               "built/two_clips /srv/clap.bvh /srv/clap.bvh", "built/two_cameras /srv/clap.bvh > captured.bvh",
                               "head -1 captured.bvh", "built/two_sensors /srv/clap.bvh", "ls -s left.ppm right.ppm")
        for words in ("of 1000 poses solved", "bridge frames: ", "HIERARCHY", "% of the joints tracked", "right.ppm"):
            self.assertIn(words, told)

    def make_packages(self):
        if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
            self.skipTest("needs root and mmdebstrap")
        subprocess.run(["cpack", "-G", "DEB", "-B", self.folder], cwd=BUILD, check=True, stdout=subprocess.DEVNULL)

    def make_root(self, *hooks):
        """Returns a bare root of this machine's Debian in which these hooks of mmdebstrap ran."""
        root = self.folder / "root"
        suite = platform.freedesktop_os_release()["VERSION_CODENAME"]
        made = subprocess.run(["mmdebstrap", "--variant=apt", "--mode=root", suite, root,
                               *(f"--customize-hook={hook}" for hook in hooks)], capture_output=True, text=True)
        if made.returncode != 0 and not (root / "usr" / "bin").exists():
            self.skipTest("no mirror is to be had: " + made.stderr[-300:])
        self.assertEqual(made.returncode, 0, made.stderr[-2000:])
        return root

    def run_inside(self, root, *commands):
        """Returns the output of an ordinary user's commands, run in sequence in the root with an empty home."""
        script = f"mount -t proc proc {root}/proc && chroot {root} su etude -c {shlex.quote(' && '.join(['cd', *commands]))}"
        ran = subprocess.run(["unshare", "--mount", "sh", "-c", script], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stdout[-2000:] + ran.stderr[-2000:])
        return ran.stdout


if __name__ == "__main__":
    unittest.main()

"""Tests Etude on the systems that docs/guide/install.md names: in a bare root of each, it is built with warnings as
errors from the packages of scripts/setup, tested and packaged, and its quick suite is compared with this machine's.
Heavy: half an hour of two cores per root; skipped, with a message, without mmdebstrap or a mirror."""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import unittest

from etude_case import ETUDE, EtudeCase, heavy
from source_files import source_files

ROOT = pathlib.Path(__file__).resolve().parents[2]
SNAPSHOT = "http://snapshot.debian.org/archive/debian/20261101T000000Z"  # a snapshot of sid, which changes daily
UNDATED = 'Acquire::Check-Valid-Until "false"'  # old package lists of a snapshot or a mirror are accepted

# Makes a folder a process's root by pivoting, because a fence cannot be made inside a chroot.
ENTER = """set -e
mount --bind "$1" "$1"
mount --rbind /dev "$1/dev"; mount --rbind /sys "$1/sys"; mount -t proc proc "$1/proc"
cd "$1"; mkdir -p old; pivot_root . old; cd /srv/etude; umount -l /old
export HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin
"""


def mirror():
    """Returns the mirror from which this machine gets its packages."""
    told = subprocess.run(["apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages"],
                          capture_output=True, text=True).stdout.split()
    return next((uri for uri in told if uri.rstrip("/").endswith("/debian")), "http://deb.debian.org/debian")


class Systems(EtudeCase):
    def make_root(self, suite, *uris, name=None):
        """Returns a bare root of the suite from the first reachable mirror, with an empty /srv/etude."""
        if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
            self.skipTest("needs root and mmdebstrap")
        root = self.folder / (name or suite)
        for uri in uris:
            made = subprocess.run(["mmdebstrap", "--variant=apt", "--mode=root", "--include=mount", f"--aptopt={UNDATED}", suite,
                                   root, f"deb {uri} {suite} main"], capture_output=True, text=True)
            if made.returncode == 0:
                print(f"{suite}: {uri}", flush=True)
                break
            shutil.rmtree(root, ignore_errors=True)
        else:
            self.skipTest(f"{suite} is not to be had: {made.stderr[-300:]}")
        shutil.copy("/etc/resolv.conf", root / "etc")
        (root / "srv/etude").mkdir()
        return root

    def make_root_with_tree(self, suite, *uris):
        root = self.make_root(suite, *uris)
        for file in source_files(ROOT):
            (root / "srv/etude" / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / file, root / "srv/etude" / file)
        return root

    def inside(self, root, *commands, **environment):
        script = ENTER + "".join(f"export {name}={shlex.quote(value)}\n" for name, value in environment.items()) + \
            "\n".join(commands)
        log = root.parent / f"{root.name}.log"
        with open(log, "a") as into:
            code = subprocess.run(["unshare", "--mount", "--propagation", "private", "bash", "-c", script, "in", root],
                                  env={}, stdout=into, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode
        self.assertEqual(code, 0, log.read_text()[-5000:])

    def builds_passes_and_runs_quick(self, suite, number):
        """Builds, tests and runs the quick suite; results may differ from this machine's by no more than the shipped
        table."""
        root = self.make_root_with_tree(suite, mirror())
        self.inside(root, "scripts/test", ETUDE_WERROR="ON")
        self.runs_quick_as_measured(root, f"Debian {number}")
        # A release holds both Debians' packages side by side.
        self.inside(root, "mkdir -p packages && (cd build/release && cpack -G DEB -B ../../packages) >/dev/null")
        clean = self.make_root(suite, mirror(), name="clean")
        package = next((root / "srv/etude/packages").glob(f"etude_*+deb{number}_amd64.deb"))
        shutil.copy(package, clean / "srv/etude/etude.deb")
        self.inside(clean, "apt-get update -q", "apt-get install -y -q --no-install-recommends ./etude.deb",
                    "cd /tmp && etude run quick/ik --trials 3 -o packed",
                    "apt-get purge -y -q etude", "! find /usr /etc /var/lib -name '*etude*' -not -path '*/dpkg/*' | grep .")

    def runs_quick_as_measured(self, root, name):
        self.inside(root, "build/release/etude run scenarios/quick -o out/quick")
        here = self.folder / "here"
        if not here.exists():
            subprocess.run([ETUDE, "run", "quick", "-o", here], check=True, capture_output=True)
        told = self.ends(0, "compare", here, root / "srv/etude/out/quick")
        self.assertIn(f"({name})", told.stdout)
        ours, theirs = ([json.loads(line) for line in (folder / "cells.jsonl").read_text().splitlines()]
                        for folder in (here, root / "srv/etude/out/quick"))
        self.assertEqual([row["cell"] for row in ours], [row["cell"] for row in theirs])
        differ = sum(a != b for a, b in zip(ours, theirs))
        print(f"{name}: {differ} of {len(ours)} cells differ from those of here", flush=True)
        print(told.stdout, flush=True)
        self.assertNotIn("larger than in that test", told.stdout)

    @heavy
    def test_debian_12(self):
        self.builds_passes_and_runs_quick("bookworm", 12)

    @heavy
    def test_debian_13(self):
        self.builds_passes_and_runs_quick("trixie", 13)

    @heavy
    def test_what_comes_after_debian_13_builds_and_runs_quick_by_egl(self):
        root = self.make_root_with_tree("sid", SNAPSHOT, mirror())
        self.inside(root, "scripts/setup", "cmake --preset release", "cmake --build build/release")
        self.runs_quick_as_measured(root, "Debian sid of November 2026")
        manifest = json.loads((root / "srv/etude/out/quick/manifest.json").read_text())
        self.assertIn("by EGL", json.dumps(manifest))


if __name__ == "__main__":
    unittest.main()

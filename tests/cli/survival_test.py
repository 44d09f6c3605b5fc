"""Tests that a run survives: killed anywhere and resumed, cut into shards, or repeated on another machine, it gives
the same bytes."""
import ctypes
import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from etude_case import ETUDE, HEAVY, IK, EtudeCase, cells_in_journal, heavy

KILLS = 100 if HEAVY else 3
LONGER = IK.replace("trials: 4", "trials: 40") + "video: {compare: [fixed], trials: [0, 1]}\n"


class Survival(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario, cls.made = cls.run_once(LONGER)
        cls.made_shards = [cls.made.parent / f"shard-{index}-of-3" for index in (1, 2, 3)]
        for index, folder in enumerate(cls.made_shards, 1):
            result = cls.etude("run", cls.scenario, "-o", folder, "--shard", f"{index}/3")
            assert result.returncode == 0, result.stderr

    def setUp(self):
        super().setUp()
        self.whole = self.folder / "whole"
        shutil.copytree(self.made, self.whole)

    def start(self, *arguments):
        return subprocess.Popen([ETUDE, "run", self.scenario, "-o", str(self.out), *arguments],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def resume(self, out=None):
        self.ends(0, "run", self.scenario, "-o", out or self.out, "--resume")

    def test_killed_at_random_moments_and_resumed_it_gives_the_same_bytes(self):
        dice = random.Random(3)
        cells = []
        while len(cells) < KILLS:
            run = self.start("--resume")
            # Kill the run after up to 59 further cells; this may be before the first cell or after the last one.
            moment = cells_in_journal(self.out) + dice.randrange(60)
            while run.poll() is None and cells_in_journal(self.out) < moment:
                time.sleep(0.001)
            time.sleep(dice.uniform(0, 0.03))
            if run.poll() is not None:  # the run ended: start again
                self.assertEqual(run.returncode, 0)
                self.assert_same_results(self.whole, self.out)
                shutil.rmtree(self.out)
                continue
            run.kill()
            run.wait()
            cells.append(cells_in_journal(self.out))
        self.assertGreater(len(set(cells)), 1, "the kills all came at the same moment")
        self.resume()
        self.assert_same_results(self.whole, self.out)
        self.assertFalse((self.out / "journal.jsonl").exists())
        print(f"{KILLS} kills, at cells {cells}")

    @heavy
    def test_cut_anywhere_in_its_last_line_the_journal_is_good(self):
        run = self.start()
        self.wait_for_cells(self.out, 5)
        run.kill()
        run.wait()
        journal = self.out / "journal.jsonl"
        text = journal.read_bytes()
        for cut in (1, 2, 50, 300):
            journal.write_bytes(text[:-cut])
            copy = self.folder / f"cut-{cut}"
            shutil.copytree(self.out, copy, ignore=shutil.ignore_patterns("lock"))  # the lock is not readable
            self.resume(copy)
            self.assert_same_results(self.whole, copy)

    def test_killed_while_its_journal_began_it_begins_anew(self):
        self.out.mkdir()
        shutil.copy(self.whole / "manifest.json", self.out)
        (self.out / "journal.jsonl").write_text('{"journal":1,"mani')
        self.resume()
        self.assert_same_results(self.whole, self.out)

    def test_resuming_nothing_begins_and_resuming_a_whole_run_does_nothing(self):
        self.resume()
        before = (self.out / "host.json").read_bytes()
        self.resume()
        self.assertEqual((self.out / "host.json").read_bytes(), before)
        self.assert_same_results(self.whole, self.out)

    @heavy
    def test_another_run_is_not_gone_on_with(self):
        run = self.start()
        self.wait_for_cells(self.out)
        run.kill()
        run.wait()
        for arguments, complaint in ((["--seed", "9"], "seed was 1 and is 9"), (["--trials", "41"], "scenarios[0].trials was 40 and is 41"),
                                     (["--shard", "1/2"], "belongs to shard 1/1, not 1/2")):
            self.assertIn(complaint, self.ends(2, "run", self.scenario, "-o", self.out, "--resume", *arguments).stderr)
        unasked = self.ends(2, "run", self.scenario, "-o", self.out)
        self.assertIn("already contains an unfinished run; --resume continues it", unasked.stderr)
        self.resume()
        self.assert_same_results(self.whole, self.out)

    @staticmethod
    def change_a_library(folder):
        """Makes the folder look like a run under another libm; returns that library's name."""
        xxh3 = ctypes.CDLL("libxxhash.so.0").XXH3_64bits
        xxh3.restype, xxh3.argtypes = ctypes.c_uint64, [ctypes.c_char_p, ctypes.c_size_t]
        path, journal = folder / "manifest.json", folder / "journal.jsonl"
        manifest = json.loads(path.read_text())
        name = next(name for name in manifest["libraries"] if name.startswith("libm."))
        text = path.read_text().replace(manifest["libraries"][name], "0123456789abcdef0123", 1)
        path.write_text(text)
        lines = journal.read_text().splitlines(keepends=True)
        head = json.loads(lines[0])
        old = head["manifest"]
        head = lines[0].replace(old, f"{xxh3(text.encode(), len(text.encode())):016x}").split(',"sum":')[0]
        lines[:2] = [f'{head},"sum":"{xxh3(head.encode(), len(head)):016x}"}}\n'] * 2
        journal.write_text("".join(lines))
        return name

    def test_a_library_that_changed_is_named_and_its_acceptance_recorded(self):
        folders = self.shards()
        name = self.change_a_library(folders[1])
        refused = self.ends(2, "merge", *folders, "-o", self.out)
        self.assertRegex(refused.stderr, rf'used different libraries than the shards before it: libraries\.{name} was "\w+" '
                                         r'and is "0123456789abcdef0123"; --other-libraries merges')
        self.assertFalse(self.out.exists())
        self.ends(0, "merge", *folders, "-o", self.out, "--other-libraries")
        recorded = json.loads((self.out / "other_libraries.json").read_text())
        self.assertEqual([(one["path"], one["now"]) for one in recorded],
                         [(f"libraries.{name}", '"0123456789abcdef0123"')])
        self.ends(0, "report", self.out, "--no-video")
        self.assertIn("libraries changed meanwhile", (self.out / "report" / "index.html").read_text())
        # A resumed run says the same.
        resumed = self.ends(2, "run", self.scenario, "-o", folders[1], "--shard", "2/3", "--resume")
        self.assertIn(f"libraries have changed since the run began: libraries.{name} was", resumed.stderr)
        self.ends(0, "run", self.scenario, "-o", folders[1], "--shard", "2/3", "--resume", "--other-libraries")
        self.assertTrue((folders[1] / "other_libraries.json").exists())

    def shards(self):
        """Returns copies of the run's three shards."""
        return [shutil.copytree(made, self.folder / made.name) for made in self.made_shards]

    @heavy
    def test_shards_started_in_different_folders_merge(self):
        (self.folder / "shared").mkdir()
        (self.folder / "suite" / ".git").mkdir(parents=True)  # the top of a repository, and an include outside it
        self.write("shared/common.yaml", "defaults: {trials: 4}\n")
        self.write("suite/ik.yaml", "include: [../shared/common.yaml]\n" + IK.replace("trials: 4\n", ""))
        (self.folder / "link").symlink_to(self.folder / "suite")
        starts = [(self.folder, "suite/ik.yaml"), (self.folder / "suite", "ik.yaml"),
                  (self.folder / "shared", "../suite/ik.yaml"), (self.folder, "link/ik.yaml"),
                  (self.folder, self.folder / "suite" / "ik.yaml")]
        shards = []
        for index, (start, path) in enumerate(starts, 1):
            shards.append(self.folder / f"shard-{index}")
            subprocess.run([ETUDE, "run", path, "--shard", f"{index}/{len(starts)}", "-o", shards[-1]], cwd=start,
                           check=True, capture_output=True)
            self.assertEqual((shards[-1] / "manifest.json").read_bytes(), (shards[0] / "manifest.json").read_bytes())
        self.ends(0, "merge", *shards, "-o", self.folder / "merged")
        self.run_suite(self.folder / "suite" / "ik.yaml", out=self.folder / "one-piece")
        self.assert_same_results(self.folder / "merged", self.folder / "one-piece")
        self.assertIn('"ik.yaml"', (shards[0] / "manifest.json").read_text())
        # Another text under the same name is another suite.
        self.write("suite/ik.yaml", IK)
        self.etude("run", self.folder / "suite" / "ik.yaml", "--shard", "1/5", "-o", self.folder / "other")
        refused = self.ends(2, "merge", self.folder / "other", *shards[1:], "-o", self.folder / "none")
        self.assertIn("belongs to a different run", refused.stderr)

    def test_shards_merge_to_the_same_bytes_in_any_order(self):
        folders = self.shards()
        host = (folders[0] / "host.json").read_bytes()
        again = self.etude("run", self.scenario, "-o", folders[0], "--shard", "1/3", "--resume")
        self.assertEqual((again.returncode, (folders[0] / "host.json").read_bytes()), (0, host))
        self.ends(0, "merge", folders[2], folders[0], folders[1], "-o", self.out)
        self.assert_same_results(self.whole, self.out)

    @heavy
    def test_a_merge_tells_how_far_it_is_and_can_be_interrupted(self):
        many = self.write("many.yaml", IK.replace("trials: 4", "trials: 10000").replace("sweep: {joint_noise_deg: [2, 5]}",
                          "joint_noise_deg: 2").replace("ccd, weights: fixed", "gauss-newton").replace(
                          "damped-least-squares", "gauss-newton"))
        shards = [self.folder / "one", self.folder / "two"]
        for index, shard in enumerate(shards, 1):
            self.ends(0, "run", many, "--shard", f"{index}/2", "-o", shard)
        merge = subprocess.Popen([ETUDE, "merge", *shards, "-o", self.out], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, text=True)
        while not (self.out / "manifest.json").exists() and merge.poll() is None:
            time.sleep(0.001)
        merge.send_signal(signal.SIGINT)
        said = merge.communicate(timeout=600)[1]
        self.assertEqual(merge.returncode, 130, said)
        self.assertIn("and the shards are unchanged", said)
        self.assertFalse(self.out.exists())
        self.assertIn("100 %  merged", self.ends(0, "merge", *shards, "-o", self.out).stderr)

    @heavy
    def test_a_killed_shard_is_resumed(self):
        one, two = self.folder / "one", self.folder / "two"
        run = subprocess.Popen([ETUDE, "run", self.scenario, "-o", one, "--shard", "1/2"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for_cells(one)
        run.kill()
        run.wait()
        self.ends(0, "run", self.scenario, "-o", two, "--shard", "2/2")
        early = self.ends(2, "merge", one, two, "-o", self.out)
        self.assertRegex(early.stderr, r"not all 2 shards are finished .*: shard 1/2 in \S+ lacks \d+ of 80 cells; the first missing cell is ik/")
        self.assertFalse(self.out.exists())
        self.ends(0, "run", self.scenario, "-o", one, "--shard", "1/2", "--resume")
        self.ends(0, "merge", one, two, "-o", self.out)
        self.assert_same_results(self.whole, self.out)

    def test_shards_that_do_not_belong_together_are_refused(self):
        folders = self.shards()
        other = self.folder / "other"
        self.etude("run", self.scenario, "-o", other, "--shard", "3/3", "--seed", "2")
        for shards, complaint in ((folders[:2], "not all 3 shards are finished ('etude run --shard i/3 --resume' continues a shard): shard 3/3 is missing"),
                                  ([*folders[:2], folders[1]], "is shard 2/3, but"),
                                  ([*folders[:2], other], "belongs to a different run than"),
                                  ([*folders, self.whole], "is a whole run, not a shard"),
                                  ([*folders[:2], self.folder / "none"], "none contains no shard; shard 3/3 is missing")):
            self.refusal("merge", *shards, "-o", self.out, says=complaint, leaves=self.out)

    def test_a_shard_whose_journal_is_lost_is_no_whole_run(self):
        shard, *others = self.shards()
        whole = (shard / "journal.jsonl").read_text()
        for left in "", whole[:100]:
            (shard / "journal.jsonl").write_text(left)
            lost = "journal.jsonl: is empty or begins with a cut line, so its cells are lost; restore this file, or run again with --overwrite"
            self.refusal("merge", shard, *others, "-o", self.out, says=lost, leaves=self.out)
            self.refusal("run", self.scenario, "-o", shard, "--shard", "1/3", "--resume", says=lost)
        self.ends(0, "run", self.scenario, "-o", shard, "--shard", "1/3", "--overwrite")
        self.ends(0, "merge", shard, *others, "-o", self.out)
        self.assert_same_results(self.whole, self.out)

    def test_a_manifest_repeats_its_run(self):
        self.ends(0, "run", "--from", self.whole / "manifest.json", "-o", self.out)
        self.assert_same_results(self.whole, self.out)

    def test_a_manifest_whose_clips_have_changed_is_refused(self):
        clip = self.folder / "walk.bvh"
        shutil.copy("/usr/share/assimp/models/BVH/01_03.bvh", clip)
        scenario = self.cut_scenario("builtin:clap", clip, trials=2)
        self.run_suite(scenario)
        lines = clip.read_text().splitlines()
        clip.write_text("\n".join(lines[:-10] + [line.replace("1", "2") for line in lines[-10:]]) + "\n")
        self.assertRegex(self.refusal("run", "--from", self.out / "manifest.json", "-o", self.folder / "again"),
                         r"clip 2 of scenario t was walk \w+ \(.*\) in the run and is walk \w+ \(.*\) now")

    def test_cells_replay_to_the_same_stages(self):
        self.assertIn("10 of 10 cells are identical to the run", self.ends(0, "replay", self.whole, "--sample", 10).stdout)

    def test_a_cell_that_was_tampered_with_is_found_with_its_stage(self):
        cells = self.whole / "cells.jsonl"
        rows = [json.loads(line) for line in cells.read_text().splitlines()]
        rows[7]["digest_solution"] = "0123456789abcdef"
        cells.write_text("".join(json.dumps(row) + "\n" for row in rows))
        self.assertIn("cells.jsonl: was changed after the run wrote it", self.etude("replay", self.whole).stderr)
        result = self.ends(1, "replay", self.whole, "--unsealed")
        self.assertIn(f"differs: {rows[7]['cell']}\n  the first difference is in stage solution: 0123456789abcdef in the run,", result.stdout)
        self.assertIn("159 of 160 cells are identical to the run", result.stdout)

    @heavy
    def test_a_packed_cell_replays_without_anything_else(self):
        self.check_pack("t/-/001/fuzzy", "clips: ['{glb}#clap', {bvh}, 'builtin:sway']")

    @heavy
    def test_so_does_a_packed_cell_of_a_library(self):
        self.check_pack("t/library=two/001/fuzzy",
                        "libraries: {{one: ['{glb}#clap', 'builtin:sway'], two: [{bvh}, 'builtin:clap']}}")

    def check_pack(self, cell, clips):
        bvh, glb = self.folder / "walk.bvh", self.folder / "clap.glb"
        shutil.copy("/usr/share/assimp/models/BVH/01_03.bvh", bvh)
        self.ends(0, "clip", "convert", "builtin:clap", glb, "--character", "bear")
        scenario = self.cut_scenario(trials=3, more="  - {name: fuzzy, choice: fuzzy-bridge, join: cut}\n",
                                     clip_key=clips.format(glb=glb, bvh=bvh))
        self.run_suite(scenario)
        pack = self.folder / "cell.etude"
        packed = self.ends(0, "replay", self.out, "--cell", cell, "--pack", pack)
        bvh.unlink()
        glb.unlink()
        shutil.rmtree(self.out)
        replayed = subprocess.run([ETUDE, "replay", pack], cwd="/", capture_output=True, text=True, timeout=600)
        self.assertEqual(replayed.returncode, 0, replayed.stderr)
        self.assertIn(f"{cell}: all stages are identical", replayed.stdout)
        pack.write_bytes(pack.read_bytes()[:-20])
        self.assertIn("not a packed cell", self.ends(2, "replay", pack).stderr)

    def test_a_result_with_a_row_missing_or_twice_is_not_reported(self):
        cells = self.whole / "cells.jsonl"
        lines = cells.read_text().splitlines(keepends=True)
        for changed, complaint in ((lines[:-1], "contains 159 rows of scenario ik, but summary.json summarises 160 rows"),
                                   (lines[:-1] + lines[:1], "contains the cell ik/joint_noise_deg=2/000/fixed twice")):
            cells.write_text("".join(changed))
            self.assertIn(complaint, self.ends(2, "report", self.whole, "--no-video", "--unsealed").stderr)

    def test_a_full_disk_is_one_complaint_and_loses_nothing(self):
        limited = subprocess.run(["bash", "-c", 'ulimit -f 400; exec "$0" run "$1" -o "$2"', ETUDE, self.scenario, self.out],
                                 capture_output=True, text=True, timeout=600)
        self.assertEqual(limited.returncode, 3)
        self.assertEqual(len([line for line in limited.stderr.splitlines() if line.startswith("etude: ")]), 1)
        self.assertIn("--resume continues the run", limited.stderr)
        self.resume()
        self.assert_same_results(self.whole, self.out)

    def test_no_option_takes_an_empty_value(self):
        for arguments in (["run", self.scenario, "-o", ""], ["gate", self.whole, "--baseline", ""], ["report", ""]):
            self.assertIn("must not be empty", self.ends(2, *arguments).stderr)

    def test_an_unknown_cell_is_named_with_the_nearest(self):
        result = self.ends(2, "replay", self.whole, "--cell", "ik/joint_noise_deg=2/000/fixd")
        self.assertIn("did you mean 'ik/joint_noise_deg=2/000/fixed'?", result.stderr)


if __name__ == "__main__":
    unittest.main()

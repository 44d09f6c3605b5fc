"""Tests secret worlds: a key of 256 bits makes them, its digest names them, and nothing that Etude writes, prints or
starts reveals the key."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from etude_case import ETUDE, IK, EtudeCase, heavy, ik_scenario

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples/outside-methods/ik_dls.py"
KEY, OTHER = "0123456789abcdef" * 4, "f" * 64
MINE = f"  - {{name: mine, exec: [python3, '{EXAMPLE}']}}\n"
SAYS_WHAT_IT_SEES = """import json, os, sys
sys.path.insert(0, 'EXAMPLES')
print('sees', json.dumps(dict(os.environ)), open('/proc/1/environ').read(), file=sys.stderr)
"""


class SecretWorlds(EtudeCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = cls.shared_folder()
        cls.key, cls.other = cls.shared / "key", cls.shared / "other"
        for file, text in ((cls.key, KEY), (cls.other, OTHER)):
            file.write_text(text + "\n")
            file.chmod(0o600)
        cls.scenario = cls.shared / "ik.yaml"
        cls.scenario.write_text(ik_scenario(trials=2))
        cls.run_folder = cls.shared / "run"
        cls.said = cls.etude("run", cls.scenario, "-o", cls.run_folder, "--seed-file", cls.key)
        assert cls.said.returncode == 0, cls.said.stderr

    def refuse(self, *arguments, code=2):
        result = self.etude(*arguments)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for text in (KEY, OTHER):
            self.assertNotIn(text, result.stdout + result.stderr)
        return result.stderr

    @property
    def digest(self):
        return json.loads((self.run_folder / "manifest.json").read_text())["seed"].removeprefix("secret ")

    def test_the_key_is_nowhere_and_its_digest_in_the_manifest(self):
        self.assertRegex(self.digest, "^[0-9a-f]{64}$")
        self.assertNotIn("can be read", self.said.stderr)
        raw = bytes.fromhex(KEY)
        looked = 0
        for file in self.run_folder.rglob("*"):
            if file.is_file():
                looked += 1
                data = file.read_bytes()
                for form in (KEY.encode(), KEY.upper().encode(), raw, raw[::-1], KEY[:16].encode()):
                    self.assertNotIn(form, data, file)
        self.assertGreater(looked, 5)

    def test_the_same_key_gives_the_same_bytes_and_another_one_other_worlds(self):
        raw = self.shared / "raw"
        raw.write_bytes(b"".join(bytes.fromhex(KEY)[at:at + 8][::-1] for at in range(0, 32, 8)))
        raw.chmod(0o644)
        again = self.etude("run", self.scenario, "-o", self.out, "--seed-file", raw, "--jobs", 1)
        self.assertIn("can be read by other users", again.stderr)
        self.assert_same_results(self.run_folder, self.out)
        self.run_suite(self.scenario, "--seed-file", self.other, "--reuse-key", out=self.folder / "other")
        self.assertNotEqual((self.folder / "other/cells.jsonl").read_bytes(), (self.out / "cells.jsonl").read_bytes())

    def test_the_environment_of_a_server_gives_it_and_no_child_sees_it(self):
        script = self.folder / "method" / "method.py"
        script.parent.mkdir()
        script.write_text(SAYS_WHAT_IT_SEES.replace("EXAMPLES", str(EXAMPLE.parent)) + "exec(open(sys.argv[1]).read())\n")
        scenario = self.folder / "ik.yaml"
        scenario.write_text(ik_scenario(trials=1) + f"  - {{name: mine, exec: [python3, '{script}', '{EXAMPLE}'], "
                                                    f"files: ['{script.parent}', '{EXAMPLE.parent}']}}\n")
        run = subprocess.run([ETUDE, "run", scenario, "-o", self.out], capture_output=True, text=True, timeout=120,
                             env={**os.environ, "ETUDE_SEED_KEY": KEY})
        if "cannot run in a fence" in run.stderr:
            self.skipTest(run.stderr)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads((self.out / "manifest.json").read_text())["seed"], "secret " + self.digest)
        log = (self.out / "stderr" / "ik~mine.txt").read_text()
        self.assertIn("sees", log)
        for text in (KEY, "ETUDE_SEED", str(self.folder / "ik.yaml"), str(self.out)):
            self.assertNotIn(text, log)
        refused = subprocess.run([ETUDE, "run", scenario, "--seed", "3", "-o", self.folder / "no"], capture_output=True,
                                 text=True, env={**os.environ, "ETUDE_SEED_KEY": KEY})
        self.assertEqual(refused.returncode, 2)
        self.assertIn("ETUDE_SEED_KEY: and --seed are both set", refused.stderr)

    def test_the_folder_is_named_by_the_digest(self):
        run = subprocess.run([ETUDE, "run", self.scenario, "--trials", "1", "--seed-file", self.key, "--reuse-key"],
                             capture_output=True, text=True, cwd=self.folder, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([folder.name for folder in (self.folder / "out").iterdir()], [f"ik-secret-{self.digest[:8]}"])

    def test_what_is_no_key_is_refused_without_being_shown(self):
        for content in ("secret-words", KEY[:-1], KEY + "0", "x" * 64, ""):
            bad = self.write("bad", content)
            stderr = self.refuse("run", self.scenario, "-o", self.out, "--seed-file", bad)
            self.assertIn("are not a key; allowed: 64 hexadecimal digits, or 32 bytes", stderr)
            if content:
                self.assertNotIn(content, stderr)
        self.refuse("run", self.scenario, "-o", self.out, "--seed-file", self.folder / "none")
        self.assertIn("--seed", self.refuse("run", self.scenario, "-o", self.out, "--seed-file", self.key, "--seed", 1))
        self.assertFalse(self.out.exists())

    @heavy
    def test_it_is_gone_on_with_and_replayed_by_its_key_alone(self):
        self.run_suite(self.scenario, "--seed-file", self.key, "--reuse-key")
        (self.folder / "plain").mkdir()
        self.run_suite(self.scenario, out=self.folder / "plain")
        resume = ["run", self.scenario, "-o", self.out, "--resume"]
        self.assertIn("give the key again with --seed-file", self.refuse(*resume))
        self.assertIn('seed was "secret ' + self.digest[:8], self.refuse(*resume, "--seed-file", self.other))
        self.ends(0, *resume, "--seed-file", self.key)
        for command in (["replay", self.out], ["run", "--from", self.out / "manifest.json", "-o", self.folder / "from"]):
            self.assertIn(f"has secret worlds; give the key with the digest {self.digest[:16]}…",
                          self.refuse(*command))
            self.assertIn("has secret worlds of the key with digest " + self.digest[:16],
                          self.refuse(*command, "--seed-file", self.other))
        replayed = self.etude("replay", self.out, "--seed-file", self.key)
        self.assertEqual(replayed.stdout, "8 of 8 cells are identical to the run\n", replayed.stderr)
        self.assertIn("leave out --seed-file", self.refuse("replay", self.folder / "plain", "--seed-file", self.key))
        cell = json.loads((self.out / "cells.jsonl").read_text().splitlines()[3])["cell"]
        pack = self.folder / "cell.pack"
        self.ends(0, "replay", self.out, "--cell", cell, "--pack", pack)
        self.assertIn("has secret worlds", self.refuse("replay", pack))
        self.ends(0, "replay", pack, "--seed-file", self.key)

    def test_worlds_of_an_earlier_version_are_refused_with_the_reason(self):
        manifest = self.run_folder / "manifest.json"
        text = manifest.read_text()
        self.assertIn('"secret_worlds":3', text.replace(" ", ""))
        for version, older in ((1, re.sub(r'"secret_worlds":\s*3,\s*', "", text)),
                               (2, re.sub(r'"secret_worlds":\s*3', '"secret_worlds":2', text))):
            says = (f"contains secret worlds of version {version}, but this program makes version 3 "
                    "(separate random numbers for each condition)")
            self.assertIn(says, self.refuse("run", "--from", self.write("older.json", older), "-o", self.folder / "from",
                                            "--seed-file", self.key))
        shard = ["run", self.scenario, "--shard", "1/2", "-o", self.out, "--seed-file", self.key]
        self.ends(0, *shard, "--reuse-key")
        of_shard = self.out / "manifest.json"
        of_shard.write_text(re.sub(r'"secret_worlds":\s*3', '"secret_worlds":2', of_shard.read_text()))
        self.assertIn(says, self.refuse(*shard, "--resume"))
        # A run with a plain seed has no version of secret worlds, so it is refused as another run, not for its
        # version.
        plain = ["run", self.scenario, "--shard", "1/2", "-o", self.folder / "plain"]
        self.ends(0, *plain)
        told = self.refuse(*plain, "--resume", "--seed-file", self.key)
        self.assertIn("belongs to another run", told)
        self.assertNotIn("version", told)
        data = self.folder / "data"
        self.ends(0, "export", self.scenario, "-o", data, "--seed-file", self.key, "--reuse-key")
        (data / "manifest.json").write_text(older)
        self.assertIn(says, self.refuse("score", data, self.folder, "-o", self.folder / "scored", "--seed-file", self.key))

    def test_a_baseline_of_an_earlier_version_is_of_other_worlds(self):
        older, baseline = self.folder / "older", self.folder / "base.json"
        shutil.copytree(self.run_folder, older)
        manifest = older / "manifest.json"
        manifest.write_text(re.sub(r'"secret_worlds":\s*3', '"secret_worlds":2', manifest.read_text()))
        for run, code in ((self.run_folder, 0), (older, 2)):
            self.ends(0, "gate", run, "--baseline", baseline, "--update", "--unsealed")
            gate = self.etude("gate", self.run_folder, "--baseline", baseline)
            self.assertEqual(gate.returncode, code, gate.stdout + gate.stderr)
        self.assertIn("or different versions of secret worlds", gate.stderr)

    def test_conditions_have_dice_of_their_own_that_hang_on_no_other(self):
        def truths(name, *seed):
            self.ends(0, "export", self.scenario, "-o", self.folder / name, *seed)
            return {str(json.loads(file.read_text())["angles_deg"]) for file in (self.folder / name).glob("truth/*/*/*/truth.json")}

        self.assertEqual(len(truths("secret", "--seed-file", self.key, "--reuse-key")), 4)
        self.assertEqual(len(truths("plain")), 2, "the control: conditions of open worlds share their dice")
        rows = {row["cell"]: row for row in map(json.loads, (self.run_folder / "cells.jsonl").read_text().splitlines())}
        scenario = self.folder / "ik.yaml"
        scenario.write_text(self.scenario.read_text().replace("[2, 5]", "[5, 1, 2]"))
        again = self.run_suite(scenario, "--seed-file", self.key, "--reuse-key")
        same = [row for row in again if row["joint_noise_deg"] != 1]
        self.assertEqual(len(same), 8)
        for row in same:
            self.assertEqual(row, rows[row["cell"]])

    def key_of_its_own(self):
        """Makes an unused key; returns its path and the lines of its list of uses."""
        key = self.folder / "own-key"
        key.write_bytes(os.urandom(32))
        key.chmod(0o600)
        used = pathlib.Path(f"{key}.used")
        return key, lambda: [json.loads(line) for line in used.read_text().splitlines()] if used.exists() else []

    @heavy
    def test_a_key_is_used_once(self):
        key, used = self.key_of_its_own()
        asked = ["--seed-file", key]
        self.run_suite(self.scenario, *asked)
        self.assertEqual([line["command"] for line in used()], ["run"])
        self.assertEqual(pathlib.Path(f"{key}.used").stat().st_mode & 0o777, 0o600)
        says = f"own-key: was used before: 'etude run' with 'ik' wrote into {self.out} ({key}.used:1), so the worlds of this key may be known"
        again = self.folder / "again"
        for command in (["run", self.scenario, "-o", again], ["export", self.scenario, "-o", again],
                        ["run", self.scenario, "-o", again, "--resume"], ["run", self.scenario, "-o", again, "--shard", "1/2"],
                        ["run", self.scenario, "-o", self.out, "--overwrite"]):
            self.assertIn(says, self.refuse(*command, *asked))
        self.assertFalse(again.exists())
        self.assertTrue((self.out / "cells.jsonl").exists(), "what is refused overwrites nothing")
        for command in (["run", self.scenario, "-o", self.out, "--resume"], ["replay", self.out],
                        ["run", "--from", self.out / "manifest.json", "-o", again]):
            self.ends(0, *command, *asked)
        self.assert_same_results(self.out, again)
        self.assertEqual(len(used()), 2, "--from is told, too")
        self.ends(0, "export", self.scenario, "-o", self.folder / "data", *asked, "--reuse-key")
        self.assertEqual(used()[2]["command"], "export")
        self.assertIn("--reuse-key requires --seed-file", self.refuse("run", self.scenario, "-o", self.folder / "x", "--reuse-key"))

    def test_worlds_that_an_export_told_are_no_secret_of_a_run(self):
        key, used = self.key_of_its_own()
        data, out = self.folder / "data", self.folder / "again"
        self.ends(0, "export", self.scenario, "-o", data, "--seed-file", key, "--trials", 1)
        self.assertIn("was used before: 'etude export' with 'ik' wrote into", self.refuse("run", "--from", data / "manifest.json", "-o", out, "--seed-file", key))
        self.assertEqual(len(used()), 1)
        self.ends(0, "run", "--from", data / "manifest.json", "-o", out, "--seed-file", key, "--reuse-key")

    def test_a_key_that_a_program_could_read_is_refused_or_hidden(self):
        key, _ = self.key_of_its_own()
        os.link(key, self.folder / "innocent")
        self.assertIn("has a second name (a hard link)", self.refuse("run", self.scenario, "-o", self.out, "--seed-file", key))
        self.assertFalse(self.out.exists())

    def test_what_goes_on_is_a_run_that_the_list_tells_of(self):
        key, _ = self.key_of_its_own()
        shard, copy = self.folder / "shard", self.folder / "copy"
        self.ends(0, "run", self.scenario, "-o", shard, "--shard", "1/2", "--seed-file", key)
        copy.mkdir()
        for name in ("manifest.json", "journal.jsonl"):
            text = (shard / name).read_text()
            (copy / name).write_text("".join(text.splitlines(True)[:2]) if name == "journal.jsonl" else text)
        self.assertIn("was used before", self.refuse("run", self.scenario, "-o", copy, "--shard", "1/2", "--resume", "--seed-file", key))

    @heavy
    def test_a_dry_run_asks_about_other_worlds(self):
        key, used = self.key_of_its_own()
        script = self.folder / "method" / "method.py"
        script.parent.mkdir()
        script.write_text("import sys\nfor line in sys.stdin:\n    print(line, end='', file=sys.stderr, flush=True)\n"
                          "    kind = 'hello' if '\"hello\"' in line else 'ready'\n"
                          "    print('{\"type\": \"' + kind + '\", \"protocol\": 1, \"name\": \"m\", \"version\": \"1\"}', flush=True)\n")
        scenario = self.write("ik.yaml", ik_scenario(trials=2) + f"  - {{name: mine, exec: [python3, '{script}']}}\n")
        asked = lambda text: set(re.findall(r'"start_angles_deg":\[[^]]*\]', text))
        dry = self.ends(0, "run", scenario, "--seed-file", key, "--dry-run")
        self.assertEqual(used(), [])
        self.run_suite(scenario, "--seed-file", key, code=1)
        of_run = asked((self.out / "stderr/ik~mine.txt").read_text())
        self.assertEqual((len(of_run), bool(asked(dry.stderr))), (4, True))
        self.assertFalse(of_run & asked(dry.stderr))

    def test_an_export_uses_its_key_and_is_scored_by_it(self):
        key, used = self.key_of_its_own()
        data, answers = self.folder / "data", self.folder / "answers"
        self.ends(0, "export", self.scenario, "-o", data, "--seed-file", key, "--trials", 1)
        self.assertIn("was used before: 'etude export' with 'ik' wrote into", self.refuse("run", self.scenario, "-o", self.out, "--seed-file", key))
        answers.mkdir()
        scored = self.etude("score", data, answers, "--allow-missing", "-o", self.out, "--seed-file", key)
        self.assertLess(scored.returncode, 2, scored.stderr)
        self.assertEqual([line["command"] for line in used()], ["export", "score"])

    @heavy
    def test_what_is_interrupted_or_hindered_goes_on_with_its_key(self):
        key, used = self.key_of_its_own()
        scenario = self.write("ik.yaml", ik_scenario(trials=400))
        run = subprocess.Popen([ETUDE, "run", scenario, "-o", self.out, "--seed-file", key, "--sync-seconds", "0"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for_cells(self.out)
        self.assertEqual(len(used()), 1, "before the first cell")
        run.kill()
        run.wait()
        self.assertEqual(len(self.run_suite(scenario, "--seed-file", key, "--resume")), 1600)
        self.assertEqual(len(used()), 1)

    def test_shards_of_one_key_are_merged_and_of_another_refused(self):
        key = self.folder / "copy"  # a copy of the key has its own list of uses
        shutil.copy(self.key, key)
        shard = lambda index, key, *more: self.etude("run", self.scenario, "--seed-file", key, "--shard", f"{index}/2", *more)
        for index in (1, 2):
            done = shard(index, key, "-o", self.folder / str(index))
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("was used before", shard(2, key, "-o", self.folder / "second").stderr)
        shard(2, self.other, "--reuse-key", "-o", self.folder / "foreign")
        self.assertIn("belongs to a different run", self.refuse("merge", self.folder / "1", self.folder / "foreign", "-o", self.out,
                                                               "--seed-file", self.key))
        self.ends(0, "merge", self.folder / "1", self.folder / "2", "-o", self.out, "--seed-file", self.key)
        self.assert_same_results(self.run_folder, self.out)

    def test_an_export_tells_no_trial_and_is_scored_by_its_key(self):
        data = self.folder / "data"
        self.ends(0, "export", self.scenario, "-o", data, "--seed-file", self.key, "--reuse-key")
        problems = sorted(data.glob("inputs/ik/*/*/problem.json"))
        self.assertEqual(len(problems), 4)
        answers = self.folder / "answers"
        for problem in problems:
            self.assertRegex(problem.parent.name, "^[0-9a-f]{16}$")
            place = problem.parent.relative_to(data / "inputs")
            (answers / place.parent).mkdir(parents=True, exist_ok=True)
            truth = json.loads((data / "truth" / place / "truth.json").read_text())
            (answers / place.parent / (place.name + ".json")).write_text(json.dumps({"angles_deg": truth["angles_deg"]}))
        index = (data / "inputs/index.csv").read_text().splitlines()[1:]
        self.assertEqual(index, sorted(index))
        self.assertTrue(all(re.match("ik,ik,[^,]*,,,", line) for line in index), index)
        score = ["score", data, answers, "-o", self.out, "--alone"]
        self.assertIn("has secret worlds", self.refuse(*score))
        self.assertIn("has secret worlds of the key", self.refuse(*score, "--seed-file", self.other))
        self.ends(0, *score, "--seed-file", self.key)
        for line in (self.out / "cells.jsonl").read_text().splitlines():
            self.assertLess(json.loads(line)["hidden_angle_error_deg"], 1e-9)

    @heavy
    def test_the_page_and_compare_say_which_worlds_they_are(self):
        scenario = self.folder / "suite.yaml"
        scenario.write_text(ik_scenario(trials=1) + MINE)
        self.run_suite(scenario)
        self.run_suite(scenario, "--seed-file", self.key, "--reuse-key", "--no-fence", out=self.folder / "unfenced")
        for folder, says in ((self.out, "seed 1, open worlds"), (self.run_folder, f"secret worlds, key {self.digest[:16]}…, different worlds under each condition"),
                             (self.folder / "unfenced", f"secret worlds, key {self.digest[:16]}…, different worlds under each condition, programs ran without a fence")):
            self.ends(0, "report", folder, "--no-video")
            self.assertIn(f"<dd>{says}</dd>", (folder / "report" / "index.html").read_text())
            self.assertIn(says + ".\n", self.etude("compare", folder, folder).stdout)

    def test_a_method_that_would_be_shown_the_scenario_is_refused(self):
        scenario = self.folder / "suite.yaml"
        shown = f"  - {{name: mine, exec: [python3, '{EXAMPLE}'], files: ['{EXAMPLE.parent}', '{self.folder}']}}\n"
        scenario.write_text(ik_scenario(trials=1) + shown)
        stderr = self.refuse("run", scenario, "-o", self.shared / "out", "--seed-file", self.key)
        if "cannot run in a fence" not in stderr:
            self.assertIn(f"method 'mine' could read '{self.folder}', which contains the scenario of the secret "
                          "worlds", stderr)
        self.assertFalse((self.shared / "out").exists())
        scenario.write_text(ik_scenario(trials=1) + MINE.replace("]}", "], files: [no-such-folder]}"))
        self.assertIn("'no-such-folder' does not exist", self.refuse("run", scenario, "-o", self.shared / "out"))


if __name__ == "__main__":
    unittest.main()

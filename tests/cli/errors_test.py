"""Tests bad input: it gives one message with the place and the allowed values, exit code 2, and no file."""
import json
import os
import re
import subprocess
import unittest

from etude_case import ETUDE, IK, EtudeCase

BVH_HEAD = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotaton
"""


class Errors(EtudeCase):
    def refuses(self, *arguments, says):
        self.refusal(*arguments, says=says, leaves=self.out)

    def refuses_scenario(self, text, says):
        path = self.write("s.yaml", text)
        self.refuses("run", path, "-o", self.out, says=[path + says[0], *says[1:]])

    def test_missing_files(self):
        self.refuses("run", "no/such.yaml", "-o", self.out, says=["no/such.yaml: no such scenario file or folder"])
        self.refuses("run", self.folder, "-o", self.out, says=["contains no scenario (*.yaml)"])
        self.refuses("report", self.folder / "nothing", says=["nothing: no such folder"])
        self.refuses("report", self.folder, says=[f"{self.folder}: is not a run, because it contains no manifest.json; 'etude run' writes this file"])

    def test_names_near_those_of_scenarios_are_suggested(self):
        for name, meant in ("ikk", "ik"), ("quick/pose-distance", "full/pose_distance_weights"):
            self.refuses("run", name, "-o", self.out, says=["no such scenario file or folder", f"{meant}'?"])

    def test_a_folder_of_shards_is_no_shard(self):
        scenario, parts = self.write("ik.yaml", IK), self.folder / "parts"
        for i in 1, 2:
            self.ends(0, "run", scenario, "--shard", f"{i}/2", "-o", parts / str(i))
        self.refuses("merge", parts, "-o", self.out,
                     says=[f"{parts}: is no shard, but contains shards; allowed: these shards, {parts}/1 {parts}/2"])
        (self.folder / "other").mkdir()
        (self.folder / "other" / "notes.txt").write_text("no shard")
        self.refuses("merge", self.folder / "other", "-o", self.out, says=["other: is no shard; allowed: "])
        self.ends(0, "merge", parts / "1", parts / "2", "-o", self.out)

    def test_yaml_that_is_none(self):
        self.refuses_scenario(IK + "clips: [a, b\n", says=[":10:1: not valid YAML"])

    def test_clips_that_cannot_be_found_or_read(self):
        scenario = IK.replace("task: ik", "task: transition").replace("sweep: {joint_noise_deg: [2, 5]}\n", "")
        scenario = scenario[: scenario.index("methods:")] + "methods: [{name: now, choice: now}]\n"
        self.refuses_scenario(scenario + "clips: ['builtin:clapp']\n", says=["", "did you mean 'clap'?"])
        self.refuses_scenario(scenario + "clips: ['/nowhere/*.bvh']\n", says=["", "no clip matches '/nowhere/*.bvh'"])
        broken = self.write("broken.bvh", BVH_HEAD)
        path = self.write("t.yaml", scenario + "clips: ['builtin:clap']\n")
        self.refuses("run", path, "--clips", broken, "-o", self.out, says=[broken + ":5:", "Yrotaton", "Yrotation"])

    def test_arguments(self):
        path = self.write("s.yaml", IK)
        self.refuses("run", path, "--job", "2", "-o", self.out, says=["unknown option '--job'; did you mean '--jobs'?"])
        self.refuses("run", path, "--jobs", "0", "-o", self.out, says=["--jobs"])
        self.refuses("run", path, "--seed", "-1", "-o", self.out, says=["--seed"])
        self.refuses("clip", "render", path, "-o", self.out, "--view", "fornt", says=["--view: unknown value 'fornt'; did you mean 'front'? Allowed: front, "])
        self.refuses("forecast", path, "--size", "4,5", says=["--size", "received 2: Width (x), height and depth (z) of the volume, in m"])
        self.refuses("rnu", says=["unknown argument 'rnu'; did you mean 'run'?"])
        self.refuses(says=["--help explains"])

    def test_more_cells_than_memory_holds(self):
        many = IK.replace("[2, 5]", "[1, 2, 3, 4, 5, 6]")
        self.refuses("run", self.write("s.yaml", many), "--trials", "1000000", "-o", self.out,
                     says=["with this scenario (6 conditions × 2 methods × 1000000 trials), the run has more than 10000000 cells"])

    def test_a_manifest_of_nothing_or_of_too_much(self):
        whole = self.folder / "whole"
        self.run_suite(self.write("s.yaml", IK), "--trials", "1", out=whole)
        manifest = json.loads((whole / "manifest.json").read_text())
        for trials in (0, -3, 1.5, "3", 2**40):
            manifest["scenarios"][0]["trials"] = trials
            self.refuses("run", "--from", self.write("m.json", json.dumps(manifest)), "-o", self.out,
                         says=["m.json: 'trials' must be a whole number from 1 to 10000000, found " + json.dumps(trials)])
        manifest["scenarios"][0]["trials"] = 10_000_000
        self.refuses("run", "--from", self.write("m.json", json.dumps(manifest)), "-o", self.out,
                     says=["the run has more than 10000000 cells"])
        manifest["scenarios"] = []
        self.refuses("run", "--from", self.write("m.json", json.dumps(manifest)), "-o", self.out,
                     says=["m.json: contains no scenario"])

    def test_names_that_are_no_text(self):
        odd = os.fsencode(self.folder) + b"/caf\xe9"
        os.mkdir(odd)
        named = subprocess.run([ETUDE, "run", self.write("s.yaml", IK), "-o", odd], capture_output=True, text=True)
        inside = subprocess.run([ETUDE, "list", "metrics"], cwd=odd, capture_output=True, text=True)
        for result, complaint in ((named, "argument 4: is not UTF-8 text"), (inside, "the working folder is not UTF-8")):
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(complaint, result.stderr)
        self.assertEqual(os.listdir(odd), [])

    def test_no_message_and_no_table_shows_a_name_as_another(self):
        """Tests names and values that reverse the direction of writing, are invisible, or command a terminal."""
        hostile = "a\u202eb\u200f\u2066\ufeff\u009b"
        bare = IK.split("sweep")[0]
        files = {
            "s.yaml": (IK + f"{hostile}: 4\n", ["run", "FILE", "-o", self.out]),
            "solver.yaml": (IK.replace("solver: ccd", f"solver: '{hostile}'"), ["run", "FILE", "-o", self.out]),
            "clips.yaml": (bare.replace("task: ik", "task: transition") + f"clips: ['{hostile}.bvh']\nmethods: [{{name: a, choice: now}}]\n",
                           ["run", "FILE", "-o", self.out]),
            "m.bvh": (BVH_HEAD.replace("Yrotaton", hostile), ["clip", "info", "FILE"]),
            "m.trc": (f"PathFileType\t4\t{hostile}\n{hostile}", ["clip", "info", "FILE"]),
            "m.csv": (f"{hostile}\n{hostile}", ["clip", "info", "FILE"]),
            "m.glb": (hostile, ["clip", "info", "FILE"]),
            "m.gltf": ('{"asset": {"version": "' + hostile + '"}}', ["clip", "info", "FILE"]),
            "moves.yaml": (f"{hostile}: 1\n", ["recognise", "FILE", "--moves", "FILE"]),
            "tags.xml": (f"<{hostile}/>", ["bridge", "--check", "FILE"]),
            "manifest.json": ('{"schema": "' + hostile + '"}', ["run", "--from", "FILE", "-o", self.out]),
            "cell.etude": ('{"' + hostile + '": 1}', ["replay", "FILE"]),
            "fuzzy.yaml": (f"{hostile}: 1\n", ["clip", "grades", "builtin:clap", "--fuzzy", "FILE"]),
            "pairs.csv": (f"{hostile},x,y,z,u,v\n", ["calibrate", "FILE", "--size", "1920x1080", "-o", "rig.yaml"]),
        }
        unseen = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200b-\u200f\u202a-\u202e\u2060-\u2069\ufeff]")
        shown = 0
        for name, (text, words) in files.items():
            path = self.write(hostile + name, text)
            refused = self.ends(2, *(path if word == "FILE" else word for word in words))
            self.assertEqual(unseen.findall(refused.stdout + refused.stderr), [], name)
            shown += "[U+202E]" in refused.stderr
        self.assertGreater(shown, 10)
        for words in (["list", hostile], ["run", hostile], [hostile], ["clip", "info", f"builtin:{hostile}"], ["run", f"--{hostile}"]):
            refused = self.etude(*words)
            self.assertEqual((refused.returncode, unseen.findall(refused.stdout + refused.stderr)), (2, []), words)
        clip = self.folder / f"{hostile}.csv"
        self.assertEqual(unseen.findall(self.etude("clip", "convert", "builtin:clap", clip).stdout), [])
        self.assertEqual(unseen.findall(self.etude("clip", "info", clip).stdout), [])
        facts = self.etude("clip", "info", clip, "--json").stdout
        self.assertEqual(unseen.findall(facts), [])
        self.assertEqual(json.loads(facts)["clips"][0]["source"], str(clip))

    def test_a_full_output_is_told(self):
        clip = self.folder / "clap.csv"
        self.etude("clip", "convert", "builtin:clap", clip)
        # The coach writes each line at once, so a write before the last one fails.
        for words in (["list", "metrics"], ["coach", "warm_up", "--now", "--stream", clip]):
            with open("/dev/full", "w") as full:
                result = subprocess.run([ETUDE, *words], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(result.returncode, 3, words)
            self.assertIn("No space left on device", result.stderr)

    def test_a_run_that_cannot_write_leaves_no_folder(self):
        path = self.write("s.yaml", IK)
        limit = 'ulimit -f 0; trap "" XFSZ; exec "$0" run "$1" -o "$2"'
        result = subprocess.run(["sh", "-c", limit, ETUDE, path, self.out], capture_output=True, text=True, timeout=600)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("manifest.json: cannot write this file", result.stderr)
        self.assertFalse(self.out.exists())

    def test_a_folder_that_holds_something_is_left_alone(self):
        path = self.write("s.yaml", IK)
        self.write("precious.txt", "mine")
        result = self.ends(2, "run", path, "-o", self.folder, "--overwrite")
        self.assertIn("which is not a part of a run", result.stderr)
        self.assertEqual((self.folder / "precious.txt").read_text(), "mine")


if __name__ == "__main__":
    unittest.main()

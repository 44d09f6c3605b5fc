"""Tests `etude clip`: facts, conversion and rendering of motion files, on the clips of Debian's assimp-testmodels."""
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

from etude_case import ETUDE, EtudeCase, heavy, png_size

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from json_schema import complaints, load_schema  # noqa: E402

MODELS = pathlib.Path("/usr/share/assimp/models")
WALK = MODELS / "BVH" / "01_03.bvh"
T_POSE_FIRST = MODELS / "BVH" / "01_01.bvh"
NO_BODY = MODELS / "glTF2" / "simple_skin" / "simple_skin.gltf"
NO_ANIMATION = MODELS / "glTF2" / "BoxTextured-glTF-Binary" / "BoxTextured.glb"


class Clips(EtudeCase):
    def works(self, *arguments):
        result = self.ends(0, "clip", *arguments)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def refuses(self, *arguments, says, leaves=None):
        self.refusal("clip", *arguments, says=says, leaves=leaves)

    def info(self, *arguments, code=0):
        result = self.etude("clip", "info", "--json", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        told = json.loads(result.stdout)
        self.assertEqual(complaints(told, load_schema("clip-info.schema.json")), [])
        return told["clips"]

    def places(self, clip, *options):
        """Returns every joint's position in every frame, from the program's CSV."""
        path = self.folder / "places.csv"
        self.works("convert", clip, path, "--overwrite", *options)
        with open(path) as table:
            return [[float(cell) for cell in row[2:]] for row in list(csv.reader(table))[1:]]

    def assert_same_places(self, a, b, tolerance):
        self.assertEqual(len(a), len(b))
        self.assertGreater(len(a), 10)
        worst = max(abs(x - y) for first, second in zip(a, b) for x, y in zip(first, second))
        self.assertLess(worst, tolerance)


class Info(Clips):
    def test_a_clip_is_told_of_in_words_and_as_json(self):
        words = self.works("info", T_POSE_FIRST)
        for part in ("2,752 frames at 120 Hz", "31 joints, 7 end sites", "(CMU)", "dropped a leading T-pose",
                     "left_elbow = 'LeftForeArm'"):
            self.assertIn(part, words)
        [clip] = self.info(T_POSE_FIRST)
        body = clip["body"]
        self.assertEqual((clip["frames"], clip["rate_hz"], clip["format"]), (2752, 120, "BVH"))
        self.assertTrue(1.5 < body["stature_m"] < 2.0)
        self.assertLess(abs(body["lowest_foot_m"]), 0.1)
        self.assertEqual(body["roles"]["left_elbow"], {"joint": "LeftForeArm", "composed": False})
        self.assertTrue(0 < body["speed_median_m_s"] < body["speed_p95_m_s"] < body["speed_peak_m_s"] < 15)

    def test_several_clips_and_builtin_ones(self):
        clips = self.info(MODELS / "BVH" / "*.bvh", "builtin:*", "builtin:acts", "builtin:songs")
        names = [clip["name"] for clip in clips]
        self.assertEqual(names[:3], ["01_01", "01_03", "Boxing_Toes"])
        for name in ("builtin:clap", "builtin:wave"):
            self.assertIn(name, names)
        self.assertEqual({clip["format"] for clip in clips[3:]}, {"built-in"})
        for clip in clips:
            self.assertTrue(1.5 < clip["body"]["stature_m"] < 2.0, clip["name"])

    def test_a_folder_of_more_than_a_thousand_clips_is_listed(self):
        self.works("convert", "builtin:clap", self.folder / "0.csv", "--trim", ":0.2")
        for i in range(1, 1001):
            os.link(self.folder / "0.csv", self.folder / f"{i}.csv")
        self.assertEqual(len(self.info(self.folder / "*.csv")), 1001)

    def test_what_is_no_body_is_told_of_all_the_same(self):
        skin, box, broken, walk = self.info(NO_BODY, NO_ANIMATION, MODELS / "glTF2/RecursiveNodes/RecursiveNodes.gltf",
                                            WALK, code=2)
        self.assertIsNone(skin["body"])
        self.assertIn("no joint found for left_shoulder", skin["complaint"])
        self.assertGreater(skin["frames"], 1)
        self.assertEqual((box["frames"], box["meshes"], box["triangles"]), (0, 1, 12))
        self.assertIn("holds no animation", box["complaint"])
        self.assertIsNone(broken["format"])
        self.assertIn("its own ancestor", broken["complaint"])
        self.assertIsNone(walk["complaint"])

    def test_broken_files_are_told_in_one_line_each(self):
        paths = sorted((MODELS / "glTF2").rglob("*.gl*"))
        self.assertGreater(len(paths), 20)
        result = self.ends(2, "clip", "info", *paths)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), len(paths), result.stderr)
        for path, line in zip(paths, lines):
            self.assertTrue(line.startswith(f"etude: {path}"), line)

    def test_patterns_of_any_length(self):
        self.refuses("info", "/" * 5000, says=["no clip matches"])
        self.refuses("info", "*/" * 5000, says=["no clip matches"])

    def test_what_cannot_be_found(self):
        self.refuses("info", "nowhere.bvh", says=["no clip matches 'nowhere.bvh'; allowed: builtin:NAME"])
        self.refuses("info", "builtin:clapp", says=["did you mean 'clap'?"])
        self.refuses("info", f"{NO_BODY}#Jmp", says=["simple_skin.gltf: unknown animation 'Jmp'"])
        self.refuses("info", WALK, "--unit", "ell", says=["--unit: 'ell' is not a unit; allowed: m, cm"])
        self.refuses("info", says=["clips is required", "etude clip info --help explains"])


class Convert(Clips):
    def test_bvh_to_bvh_changes_nothing_that_info_tells(self):
        copy = self.folder / "01_03.bvh"
        self.works("convert", WALK, copy)
        before, after = self.info(WALK, copy)
        for key in ("frames", "rate_hz", "joints", "end_sites"):
            self.assertEqual(before[key], after[key], key)
        self.assertEqual(before["body"]["roles"], after["body"]["roles"])
        for key, value in before["body"].items():
            if isinstance(value, float):
                self.assertTrue(math.isclose(value, after["body"][key], rel_tol=1e-3, abs_tol=1e-4), key)

    def test_bvh_to_glb_to_bvh_leaves_the_joints_where_they_are(self):
        glb, bvh = self.folder / "walk.glb", self.folder / "walk.bvh"
        self.works("convert", WALK, glb)
        self.works("convert", glb, bvh)
        places = self.places(WALK)
        self.assert_same_places(places, self.places(glb), 1e-4)
        self.assert_same_places(places, self.places(bvh), 1e-4)
        with self.assertRaises(AssertionError, msg="the control"):
            self.assert_same_places(places, self.places(WALK, "--mirror"), 1e-4)

    def test_the_same_command_gives_the_same_bytes(self):
        for name, *options in (("a.bvh", "--retarget"), ("a.glb", "--character", "bear"), ("a.trc",), ("a.csv",)):
            first, second = self.folder / name, self.folder / ("b" + name)
            for path in (first, second):
                self.works("convert", WALK, path, *options)
            self.assertEqual(first.read_bytes(), second.read_bytes(), name)

    def test_trim_rate_and_mirror(self):
        part = self.folder / "part.bvh"
        self.works("convert", WALK, part, "--trim", "1:2", "--rate", "60", "--mirror")
        [clip] = self.info(part)
        self.assertEqual((clip["frames"], clip["rate_hz"]), (61, 60))
        self.refuses("convert", WALK, part, "--trim", "1:2000", "--overwrite", says=["01_03.bvh: "])
        self.refuses("convert", WALK, part, "--trim", "soon", "--overwrite", says=["--trim: 'soon' is not a time range"])
        for rate in ("nan", "inf", "0", "1001", "fast"):
            self.refuses("convert", WALK, part, "--rate", rate, "--overwrite", says=[f"--rate: '{rate}' is not a rate"])

    def test_everybody_dances_on_the_bear(self):
        bear = self.folder / "bear.glb"
        for clip in (WALK, "builtin:clap", "builtin:wave"):
            self.works("convert", clip, bear, "--character", "bear", "--overwrite")
            [told] = self.info(bear)
            self.assertGreater(told["triangles"], 500)
            self.assertEqual(told["body"]["unit"], "metre")
            self.assertTrue(1.5 < told["body"]["stature_m"] < 1.8)

    def test_nothing_is_replaced_or_half_written(self):
        path = self.folder / "there.bvh"
        path.write_text("mine")
        self.refuses("convert", WALK, path, says=["there.bvh: already exists; --overwrite replaces it"])
        self.assertEqual(path.read_text(), "mine")
        self.refuses("convert", WALK, self.folder, says=["is a folder"])
        for name, make in (("pipe.bvh", os.mkfifo), ("link.bvh", lambda link: os.symlink("nowhere.bvh", link))):
            make(self.folder / name)
        self.refuses("convert", WALK, self.folder / "pipe.bvh", "--overwrite", says=["is a device, pipe or socket"])
        self.refuses("convert", WALK, self.folder / "link.bvh", says=["already exists"])
        for name in ("pipe.bvh", "link.bvh"):
            (self.folder / name).unlink()
        fresh = self.folder / "new.bvh"
        self.refuses("convert", WALK, self.folder / "new.fbx", says=[".bvh, .glb, .trc, .csv"])
        self.refuses("convert", WALK, fresh, "--character", "bear", says=["only GLB holds a character"], leaves=fresh)
        self.refuses("convert", NO_ANIMATION, fresh, says=["holds no animation"], leaves=fresh)
        self.refuses("convert", "builtin:*", fresh, says=[" clips; only one can be converted at a time"], leaves=fresh)
        limited = subprocess.run(["sh", "-c", 'ulimit -f 8; trap "" XFSZ; exec "$0" clip convert "$1" "$2"', ETUDE, WALK,
                                  fresh], capture_output=True, text=True, timeout=600)
        self.assertEqual(limited.returncode, 3, limited.stderr)
        self.assertIn("cannot write this file", limited.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["there.bvh"])


class Render(Clips):
    def test_a_sheet_has_a_row_of_pictures_per_clip_and_always_the_same_bytes(self):
        sheet, again = self.folder / "a.png", self.folder / "b.png"
        for path in (sheet, again):
            self.works("render", WALK, "builtin:clap", "-o", path, "--frames", "3", "--size", "96x120")
        self.assertEqual(sheet.read_bytes(), again.read_bytes())
        width, height = png_size(sheet.read_bytes())
        self.assertGreaterEqual(width, 3 * 96)
        self.assertGreater(height, 2 * 120)
        self.works("render", WALK, "-o", again, "--frames", "3", "--size", "96x120", "--overwrite")
        self.assertLess(png_size(again.read_bytes())[1], height)

    @heavy
    def test_every_figure_and_view_draws_something_else(self):
        seen = set()
        for options in (["--character", "bear"], ["--character", "mannequin"], ["--character", "body"],
                        ["--character", "body", "--view", "front"], ["--character", "body", "--view", "side"]):
            path = self.folder / "a.png"
            self.works("render", WALK, "-o", path, "--frames", "1", "--overwrite", *options)
            seen.add(path.read_bytes())
        self.assertEqual(len(seen), 5)

    def test_a_film(self):
        film = self.folder / "clap.mp4"
        self.works("render", "builtin:clap", "-o", film, "--size", "64x96", "--trim", "0:1")
        data = film.read_bytes()
        self.assertEqual(data[4:8], b"ftyp")
        self.assertIn(b"moov", data)
        self.refuses("render", "builtin:*", "-o", self.folder / "b.mp4", says=["a film shows one clip"],
                     leaves=self.folder / "b.mp4")

    def test_what_cannot_be_drawn(self):
        path = self.folder / "a.png"
        for arguments, says in (
                ((NO_BODY, "-o", path), "no joint found"),
                ((WALK, "-o", path, "--character", "own"), "has no figure of its own"),
                ((WALK, "-o", path, "--size", "9x9"), "--size: '9x9' is not a size"),
                ((WALK, "-o", path, "--frames", "1000", "--columns", "100"), "the sheet would have"),
                ((WALK, "-o", self.folder / "a.gif"), "allowed: .png (a contact sheet), .mp4 (a film)")):
            self.refuses("render", *arguments, says=[says], leaves=path)


def lopsided(text):
    """A body whose proportions do not identify its arms: one upper arm is twice as long."""
    return re.sub(r"(JOINT LeftForeArm\s*\{\s*OFFSET)\s+(\S+)\s+(\S+)\s+(\S+)",
                  lambda m: " ".join([m[1]] + [str(2 * float(number)) for number in m.groups()[1:]]), text)


class Map(Clips):
    def test_a_map_that_was_written_is_read_back_as_the_same(self):
        path = self.folder / "map.yaml"
        self.assertIn("left_elbow       'LeftForeArm'", self.works("map", WALK, "-o", path))
        again = self.folder / "again.yaml"
        self.works("map", WALK, "--joint-map", path, "-o", again)
        self.assertEqual(path.read_text(), again.read_text())
        self.refuses("map", WALK, "-o", path, says=["--overwrite"])

    def test_names_nobody_knows_are_taught_by_a_file(self):
        odd = lopsided(WALK.read_text())
        known = self.write("known.bvh", odd)
        for name, number in (("LeftForeArm", 1), ("RightForeArm", 2)):
            odd = odd.replace(f"JOINT {name}\n", f"JOINT Q{number}\n")
        clip = self.write("odd.bvh", odd)
        template = self.folder / "odd.yaml"
        self.refuses("map", clip, "-o", template, says=["no joint found for", "left_elbow", "'Q1'"])
        self.assertIn("# left_elbow:", template.read_text())
        self.assertIn('"Q1"', template.read_text())
        self.assertEqual(template.read_text().count("\n  # "), 20 - 12)  # names identify ten limb joints, neck and head
        taught = self.write("taught.yaml", "roles:\n  left_elbow: Q1\n  right_elbow: Q2\n")
        self.assert_same_places(self.places(known), self.places(clip, "--joint-map", taught), 1e-9)
        wrong = self.write("wrong.yaml", "roles:\n  left_elbw: Q1\n")
        self.refuses("info", clip, "--joint-map", wrong, says=["wrong.yaml:2:3: ", "did you mean 'left_elbow'?"])

    def test_where_names_fail_the_build_tells_and_it_is_said(self):
        odd = WALK.read_text()
        for i, name in enumerate(re.findall(r"JOINT (\S+)", odd)):
            odd = re.sub(rf"JOINT {name}\b", f"JOINT ボーン{i}", odd)
        clip = self.write("odd.bvh", odd)
        (told,) = self.info(clip)
        self.assertIn("found by the skeleton's shape, not by names (confidence ", told["body"]["note"])
        self.assertRegex(told["body"]["roles"]["left_knee"]["joint"], "^ボーン")
        self.assertIn("left_knee = 'ボーン", self.works("info", clip))
        (ours,), limbs = self.info(WALK), ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")
        names = re.findall(r"JOINT (\S+)", WALK.read_text())
        for role in (f"{side}_{limb}" for side in ("left", "right") for limb in limbs):
            joint = names[int(told["body"]["roles"][role]["joint"].removeprefix("ボーン"))]
            self.assertEqual(joint, ours["body"]["roles"][role]["joint"], role)

    def test_a_run_keeps_what_it_was_taught(self):
        odd = self.write("odd.bvh", lopsided(WALK.read_text()).replace("JOINT LeftForeArm\n", "JOINT Q1\n"))
        taught = pathlib.Path(self.write("taught.yaml", "roles:\n  left_elbow: Q1\n"))
        scenario = self.cut_scenario(odd, "builtin:sway")
        self.assertIn("no joint found for left_elbow", self.ends(2, "run", scenario, "-o", self.out).stderr)
        self.ends(0, "run", scenario, "-o", self.out, "--joint-map", taught)
        taught.unlink()  # the manifest contains the map's text
        again = self.ends(0, "run", "--from", self.out / "manifest.json", "-o", self.folder / "again")
        for name in ("manifest.json", "cells.jsonl"):
            self.assertEqual((self.out / name).read_bytes(), (self.folder / "again" / name).read_bytes())

    def test_a_map_that_does_not_do_is_not_replaced_by_an_empty_one(self):
        text = "roles:\n  left_knee: RightLeg\n"
        mine = self.write("mine.yaml", text)
        self.refuses("map", WALK, "--joint-map", mine, "-o", mine, "--overwrite", says=["does not descend from"])
        self.assertEqual(pathlib.Path(mine).read_text(), text)


if __name__ == "__main__":
    unittest.main()

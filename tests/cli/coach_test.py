"""Tests `etude coach`: it reads skeletons, and prints what a stage should show."""
import json
import pathlib
import sys
import unittest
import wave

from etude_case import EtudeCase, heavy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from json_schema import complaints, load_schema  # noqa: E402

SCHEMA = load_schema("coach-line.schema.json")


class Coach(EtudeCase):
    @classmethod
    def setUpClass(cls):
        shared = cls.shared_folder()
        cls.take, cls.expert = shared / "take.csv", shared / "expert.csv"
        cls.etude("clip", "convert", "builtin:standby", cls.take)
        cls.etude("clip", "convert", "builtin:warm_up", cls.expert)
        # People who follow the coach are 0.3 s late.
        head, first, *rows = cls.expert.read_text().splitlines()
        poses = [row.split(",", 2)[2] for row in [first] * 10 + rows]
        cls.expert.write_text("\n".join([head] + [f"{i},{i / 30:.6f},{pose}" for i, pose in enumerate(poses)]) + "\n")

    def coach(self, *arguments, text=None):
        result = self.ends(0, "coach", "warm_up", *arguments, text=text)
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        for line in [line for line in lines[1:] if "events" in line or "music" in line] + lines[1:20]:
            self.assertEqual(complaints(line, SCHEMA), [])
        return lines[0], lines[1:]

    def refuses(self, *arguments, says, text=None):
        result = self.ends(2, "coach", *arguments, text=text)
        for words in says:
            self.assertIn(words, result.stderr.strip().splitlines()[-1])

    def events(self, frames):
        return [event for frame in frames for event in frame.get("events", [])]

    def test_a_head_and_a_line_for_each_frame(self):
        head, frames = self.coach("--stream", self.take)
        self.assertEqual(head["song"], "warm_up")
        self.assertEqual(len(head["joints"]), 20)
        self.assertTrue(all(len(move["key_pose"]) == 60 for move in head["moves"]))
        self.assertEqual([frame["frame"] for frame in frames], list(range(480)))
        self.assertTrue(all(len(frame["body"]) == 60 for frame in frames))
        self.assertEqual(frames[100]["mode"], "standby")
        self.assertEqual(frames[100]["say"], "Clap, and we dance!")

    def test_who_dances_it_as_it_was_made_is_right_every_time(self):
        head, frames = self.coach("--now", "--stream", self.expert, "--brief")
        judged = [event for event in self.events(frames) if event["event"] in ("right", "wrong", "unjudged")]
        self.assertEqual([event["event"] for event in judged], ["right"] * head["repetitions"])

    def test_who_dances_the_other_side_is_wrong_by_the_recommended_recogniser(self):
        def wrong(*options):
            _, frames = self.coach("--now", "--stream", self.expert, "--brief", "--policy", "never", *options)
            return [event["move"] for event in self.events(frames) if event["event"] == "wrong"]
        self.assertEqual(wrong("--mirror"), wrong("--mirror", "--recogniser", "coached"))
        self.assertTrue({"side_stretch", "side_kick", "robot"} <= set(wrong("--mirror")))

    @heavy
    def test_who_stands_there_is_corrected(self):
        rows = self.take.read_text().splitlines()
        rows = [rows[0]] + [f"{i},{i / 30:.6f}," + rows[1].split(",", 2)[2] for i in range(900)]
        _, frames = self.coach("--now", "--stream", "-", "--brief", text="\n".join(rows) + "\n")
        events = self.events(frames)
        wrong = [event for event in events if event["event"] == "wrong"]
        self.assertEqual(wrong[0]["mistake"], "stood still")
        self.assertIn("corrects", [event["event"] for event in events])
        self.assertNotIn("right", [event["event"] for event in events])

    @heavy
    def test_what_is_recorded_and_what_comes_live_are_coached_alike(self):
        _, recorded = self.coach("--now", "--stream", self.expert)
        _, live = self.coach("--now", "--stream", "-", text=self.expert.read_text())
        self.assertEqual(recorded, live)

    def test_moves_files_say_what_is_right(self):
        clap, swaying = self.folder / "clap.csv", self.folder / "clap_is_swaying.csv"
        self.etude("clip", "convert", "builtin:clap", str(clap))
        self.etude("clip", "convert", "builtin:fast_sway", str(swaying))
        dancer, taught = self.folder / "groove.csv", self.folder / "taught.yaml"
        self.etude("clip", "convert", "builtin:groove", str(dancer))

        def verdicts(stream):
            self.etude("teach", stream, "-o", taught, "--overwrite")
            taught.write_text(taught.read_text().replace("clap_is_swaying", "clap"))
            result = self.etude("coach", "groove", "--now", "--brief", "--policy", "never", "--recogniser", "dtw",
                                "--moves", taught, "--stream", dancer)
            events = self.events([json.loads(line) for line in result.stdout.splitlines()[1:]])
            return [(event["move"], event["event"]) for event in events if event["event"] in ("right", "wrong")]

        self.assertEqual({event for _, event in verdicts(clap)}, {"right"})
        self.assertEqual({move for move, event in verdicts(swaying) if event == "wrong"}, {"clap"})
        taught.write_text(taught.read_text().replace("clap", "yodel"))
        self.refuses("groove", "--moves", taught, "--stream", dancer, says=["yodel", "allowed: clap, fast_sway"])

    @heavy
    def test_the_dance_follows_music_that_runs_elsewhere(self):
        rows = self.expert.read_text().splitlines()
        told = [rows[0]]
        for i, row in enumerate(rows[1:]):
            told += [f"#music {i / 30 * 1.02:.4f}", row]
        _, frames = self.coach("--now", "--policy", "never", "--stream", "-", "--brief", text="\n".join(told) + "\n")
        tags = [event for event in self.events(frames) if event["event"] == "tag"]
        self.assertGreater(len(tags), 20)
        self.assertGreater(tags[-1]["rate"], 1.005)
        self.assertLess(abs(tags[-1]["beat_error_ms"]), 150)

    def test_a_song_of_ones_own(self):
        beats = self.folder / "beats.txt"
        beats.write_text("".join(f"{0.3 + i * 0.64:.3f}\n" for i in range(200)))
        clicks = self.folder / "clicks.wav"
        head, frames = self.coach("--now", "--stream", self.expert, "--beats", beats, "--click", clicks, "--brief")
        self.assertAlmostEqual(head["tempo_bpm"], 93.75)
        self.assertAlmostEqual(frames[0]["music"]["play_from_s"], 0.3, delta=0.02)  # tags are at whole frames
        with wave.open(str(clicks)) as sound:
            self.assertEqual(sound.getframerate(), 44100)
            self.assertAlmostEqual(sound.getnframes() / 44100, 0.3 + 199 * 0.64 + 1, places=3)
        self.refuses("warm_up", "--stream", self.expert, "--click", clicks, says=["clicks.wav", "--overwrite"])

    def test_the_time_of_frames_is_printed(self):
        result = self.etude("coach", "warm_up", "--now", "--stream", self.expert, "--brief", "--timing")
        self.assertRegex(result.stderr, r"\d+ frames; ms per frame: median \d+\.\d{3}, p99 \d+\.\d{3}, largest \d+\.\d{3}\n")

    def test_complaints(self):
        self.refuses("warm_op", "--stream", self.take, says=["unknown song 'warm_op'", "did you mean 'warm_up'"])
        self.refuses("warm_up", "--stream", self.folder / "none.csv", says=["none.csv", "cannot be read"])
        self.refuses("warm_up", "--stream", self.take, "--policy", "oracle", says=["--policy"])
        self.refuses("warm_up", "--stream", "-", says=["#music", "stream:2"],
                     text=self.take.read_text().replace("\n", "\n#music soon\n", 1))
        beats = self.folder / "beats.txt"
        beats.write_text("1\n2\nthree\n")
        self.refuses("warm_up", "--stream", self.take, "--beats", beats, says=["beats.txt:3:1", "'three'"])


if __name__ == "__main__":
    unittest.main()

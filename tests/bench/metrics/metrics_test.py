"""Tests that second implementations can agree with `etude list metrics`, and that a wrong one is noticed."""
import copy
import json
import math
import pathlib
import statistics
import subprocess
import sys
import unittest
import unittest.mock

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(ROOT / "tests" / "cli"), str(ROOT / "tests" / "support")]
import second_implementation as second  # noqa: E402
from independent import body, capture, coach, common, detection, evaluation, ik, pose_distance  # noqa: E402
from independent import support, tracking, transition  # noqa: E402
from etude_case import IK, EtudeCase, heavy  # noqa: E402
from json_schema import complaints, load_schema, own_complaints  # noqa: E402


def or_nothing(function):
    return lambda values: function(values) if values else None


# Mistakes of a second implementation: the module, the part to replace, and the metrics whose vectors must notice.
MUTANTS = {
    "median for mean": (common, {"mean": or_nothing(statistics.median)}, [
        "position_error_cm", "orientation_error_deg", "hidden_angle_error_deg", "hidden_angle_change_deg", "mpjpe_mm",
        "mpjpe_before_ik_mm", "pa_mpjpe_mm", "bone_length_error_cm", "limb_direction_error_deg",
        "triangulation_error_mm", "iou", "mask_precision", "mask_recall", "mask_f1", "shadow_error", "pwc",
        "mean_joint_jump_cm", "foot_slide_cmps", "sparc", "ldlj", "roc_auc", "retention",
        "iterations_per_frame"]),
    "worst for mean": (common, {"mean": or_nothing(max)}, [
        "position_error_cm", "orientation_error_deg", "orientation_error_max_deg", "hidden_angle_error_deg",
        "mpjpe_mm", "pa_mpjpe_mm", "bone_length_error_cm", "limb_direction_error_deg", "triangulation_error_mm",
        "reprojection_rms_px", "iou", "mask_precision", "mask_recall", "mask_f1", "shadow_error", "pwc",
        "mean_joint_jump_cm", "foot_slide_cmps", "ldlj", "iterations_per_frame"]),
    "mean for worst": (common, {"worst": lambda values: statistics.fmean(values) if values else 0.0}, [
        "position_error_max_cm", "orientation_error_max_deg", "solved_practical", "jump_cm", "mean_joint_jump_cm",
        "jerk_peak_mps3", "rotation_step_change_deg", "foot_slide_cmps", "pose_gap_cm", "velocity_gap_cmps",
        "natural_share", "fuzzy_distance", "frames_solved"]),
    "metres for centimetres": (common, {"CM": 1}, [
        "position_error_cm", "position_error_max_cm", "solved_practical", "bone_length_error_cm", "jump_cm",
        "mean_joint_jump_cm", "foot_slide_cmps", "pose_gap_cm", "velocity_gap_cmps", "natural_share", "frames_solved",
        "frames_solved_tight"]),
    "centimetres for millimetres": (common, {"MM": 100}, [
        "mpjpe_mm", "mpjpe_before_ik_mm", "pa_mpjpe_mm", "pck_50mm", "auc_200mm", "triangulation_error_mm"]),
    "radians for degrees": (common, {"degrees": lambda radians: radians}, [
        "orientation_error_deg", "orientation_error_max_deg", "limb_direction_error_deg", "rotation_step_change_deg",
        "frames_solved"]),
    "counts for shares": (common, {"share": sum}, [
        "limb_direction_coverage", "triangulation_coverage", "frames_in_view", "frames_recovered", "precision", "recall",
        "fault_found", "grey_called_right", "right_spotted", "move_named",
        "frames_solved", "frames_solved_tight"]),
    "a window of nine frames": (transition, {"REACH": 4}, ["jump_cm", "mean_joint_jump_cm", "jerk_peak_mps3"]),
    "a window of thirteen": (transition, {"REACH": 6}, ["jump_cm", "mean_joint_jump_cm", "jerk_peak_mps3"]),
    "joints within 49 mm": (capture, {"PCK_MM": 49}, ["pck_50mm"]),
    "joints within 51 mm": (capture, {"PCK_MM": 51}, ["pck_50mm"]),
    "an area up to 15 cm": (capture, {"AUC_MM": 150}, ["auc_200mm"]),
    "no alignment": (capture, {"aligned": lambda pose, truth: pose}, ["pa_mpjpe_mm"]),
    "feet to 5 cm": (transition, {"FOOT_HEIGHT_CM": 5}, ["foot_slide_cmps"]),
    "gaps above 19 cm": (transition, {"FALSE_SMOOTH_CM": 19}, ["false_smooth", "false_smooth_share"]),
    "gaps above 21 cm": (transition, {"FALSE_SMOOTH_CM": 21}, ["false_smooth", "false_smooth_share"]),
    "the 90th percentile": (transition, {"NATURAL_QUANTILE": 0.9}, ["natural_share"]),
    "the 90th percentile of steps": (tracking, {"PERCENTILE": 0.9}, ["iterations_per_frame_p95"]),
    "acceleration for jerk": (tracking, {"JERK_ORDER": 2}, ["angle_jerk_ratio"]),
    "solved within 0.05": (ik, {"PRACTICAL": 0.05}, ["solved_practical", "frames_solved"]),
    "solved within 0.3": (ik, {"PRACTICAL": 0.3}, ["solved_practical", "frames_solved"]),
    "tight within 0.0005": (ik, {"TIGHT": 0.0005}, ["solved_tight", "frames_solved_tight"]),
    "tight within 0.1": (ik, {"TIGHT": 0.1}, ["solved_tight", "frames_solved_tight"]),
    "a cut-off at 5 Hz": (transition, {"SPARC_CUT_OFF_HZ": 5}, ["sparc"]),
    "a cut-off at 20 Hz": (transition, {"SPARC_CUT_OFF_HZ": 20}, ["sparc"]),
    "a threshold of 0.1": (transition, {"SPARC_THRESHOLD": 0.1}, ["sparc"]),
    "acceleration for the speed's jerk": (transition, {"JERK_ORDER": 1}, ["ldlj"]),
    "the position's jerk": (transition, {"JERK_ORDER": 3}, ["ldlj"]),
    "matches up to the threshold, it included": (transition, {"matching": lambda given: [
        pair for pair in given["pairs"] if pair["distance"] <= given["threshold"]]}, [
            "direct_match", "matching_share", "false_smooth_share"]),
    "all pairs match": (transition, {"matching": lambda given: given["pairs"]}, [
        "direct_match", "matching_share", "false_smooth_share"]),
    "close within 16 cm": (pose_distance, {"CLOSE_CM": 16}, ["close_auc", "close_f1"]),
    "level pairs lost": (pose_distance, {"TIE_CREDIT": 0.0}, ["close_auc"]),
    "alike up to the threshold, it included": (pose_distance, {
        "alike": lambda given, pair: pair["distance"] <= given["threshold"]}, ["called_alike", "close_f1"]),
    "held up to 2 cm": (support, {"HEIGHT": 0.02}, ["unsupported_frames", "supported_share"]),
    "held up to 3 cm": (support, {"HEIGHT": 0.03}, ["unsupported_frames", "supported_share", "balance_cm"]),
    "rest below 0.3 m/s": (support, {"REST_MPS": 0.3}, ["unsupported_frames"]),
    "rest below 0.8 m/s": (support, {"REST_MPS": 0.8}, ["unsupported_frames"]),
    "any step is a surface": (support, {"LEVEL": 0.08}, ["unsupported_frames"]),
    "no step is one": (support, {"LEVEL": 0.25}, ["unsupported_frames"]),
    "a window of a fifth of a second": (support, {"WINDOW_S": 0.2}, ["unsupported_frames"]),
    "a window of half a second": (support, {"WINDOW_S": 0.5}, ["unsupported_frames"]),
    "whatever falls flies": (support, {"FALL_MPS2": (0, 13)}, ["unsupported_frames", "supported_share"]),
    "however fast": (support, {"FALL_MPS2": (6.5, 30)}, ["unsupported_frames"]),
    "nothing flies": (support, {"flies": lambda frames, rate: False}, ["unsupported_frames", "supported_share"]),
    "flights may wobble": (support, {"STRAY": 0.03}, ["unsupported_frames"]),
    "whatever leaves the floor was thrown": (support, {"MAX_PUSH": 10}, ["unsupported_frames", "supported_share"]),
    "the ground hardly throws": (support, {"MAX_PUSH": 1.5}, ["unsupported_frames", "supported_share"]),
    "judged for a second": (support, {"JUDGED_S": 1}, ["unsupported_frames"]),
    "judged for 1.4 s": (support, {"JUDGED_S": 1.4}, ["unsupported_frames"]),
    "the top of a jump is a floor": (support, {"falling": lambda frames, rate: [False] * len(frames)},
                                     ["unsupported_frames", "supported_share"]),
    "whoever moves glides": (support, {"GLIDING": 0}, ["unsupported_frames"]),
    "seen after three frames": (support, {"FLOATING_FRAMES": 3}, ["supported_share"]),
    "seen after five": (support, {"FLOATING_FRAMES": 5}, ["supported_share"]),
    "raised heels bear": (support, {"HEEL": 0.1}, ["unsupported_frames", "supported_share"]),
    "feet in the air bear": (support, {"TOES": 0.12}, ["unsupported_frames"]),
    "twice the gravity": (body, {"GRAVITY": 19.62}, ["zmp_off_cm", "slip_mps2"]),
    "half the friction": (body, {"FRICTION": 0.5}, ["slip_mps2"]),
    "weight on a ground that hardly bears": (body, {"CARRIED": 0.1}, ["zmp_off_cm"]),
    "accelerations fitted over more than a second": (body, {"REACH": 20}, ["zmp_off_cm"]),
    "a frame is enough": (body, {"SUSTAINED": dict.fromkeys(body.SUSTAINED, 1)}, [
        "zmp_off_cm", "beyond_joint_deg", "overlap_cm", "sunk_cm"]),
    "clips excuse nothing": (body, {"ALLOWANCE": 0}, [
        "zmp_off_cm", "slip_mps2", "foot_turn_deg", "beyond_joint_deg", "overlap_cm"]),
    "clips excuse the same frame alone": (body, {"NEAR": 0}, ["beyond_joint_deg"]),
    "a glide for a third of a second": (body, {"GLIDE_FRAMES": 10}, ["glide_cm"]),
    "knees may go 40° back": (body, {"KNEE": 40}, ["beyond_joint_deg"]),
    "a stiffer neck": (body, {"NECK": 70}, ["beyond_joint_deg"]),
    "a stiffer trunk": (body, {"TRUNK": 70}, ["beyond_joint_deg"]),
    "hips that turn less inwards": (body, {"INWARD": 50}, ["beyond_joint_deg"]),
    "hips that turn less outwards": (body, {"OUTWARD": 100}, ["beyond_joint_deg"]),
    "elbows fold flat": (body, {"FOLD": 5}, ["beyond_joint_deg"]),
    "thicker arms": (body, {"ARM_CM": 5}, ["overlap_cm"]),
    "thicker legs": (body, {"LEGS_CM": 5}, ["overlap_cm"]),
    "a body may sink less": (transition, {"MOST_OF_BODY": {**transition.MOST_OF_BODY, "sunk_cm": 2}}, ["clean_share"]),
    "the nearest joint for the hull": (support, {"distance_to_hull": lambda point, points: min(
        math.dist(point, p) for p in points)}, ["balance_cm"]),
    "the hips for the mass centre": (support, {"mass_centre": lambda pose: pose["hip_centre"]}, ["balance_cm"]),
    "a third of the clip is too much": (transition, {"MOST_SKIPPED": 0.3333}, ["clean_share"]),
    "half of the clip is not": (transition, {"MOST_SKIPPED": 0.5}, ["clean_share"]),
    "padding by 3": (transition, {"SPARC_PADDING": 3}, ["sparc"]),
    "all asked of every world": (ik, {"asked": lambda given: "both"}, ["solved_practical", "solved_tight"]),
    "the mean of an effector's axes for each of them": (ik, {"axis_angles_deg": ik.effector_angles_deg}, [
        "solved_practical", "solved_tight", "frames_solved", "frames_solved_tight"]),
    "limits to a hundredth of a degree": (ik, {"ROUNDING": 0.01}, ["limit_violations"]),
    "limits to the last bit": (ik, {"ROUNDING": 0}, ["limit_violations"]),
    "PAR-10": (ik, {"PENALTY": 10}, ["iterations_par2", "fk_evaluations_par2"]),
    "answered whenever": (coach, {"next_end": lambda given, i: given["frames"]}, [
        "corrections_missed_per_min", "answered_share"]),
    "answered before the next one begins": (coach, {"next_end": lambda given, i: given["performances"][i]["end_frame"]}, [
        "corrections_missed_per_min", "answered_share"]),
    "grey for right": (coach, {"is_right": lambda truth: truth != "wrong"}, [
        "corrections_unneeded_per_min", "repetitions_until_right"]),
    "grey for wrong": (coach, {"is_wrong": lambda truth: truth != "right"}, [
        "corrections_due_per_min", "answered_share", "decision_delay_s"]),
    "corrections that nothing caused are needed": (coach, {"uncaused": False}, ["corrections_unneeded_per_min"]),
    "what was given up left out": (coach, {"kaplan_meier_median": lambda waits: or_nothing(statistics.median)(
        [time for time, happened in waits if happened])}, [
            "repetitions_until_right"]),
    "the mean beat error": (coach, {"PERCENTILE": 0.5}, ["beat_error_ms", "transition_natural_share"]),
    "action points within half a second": (detection, {"POINT_TOLERANCE_S": 0.5}, ["action_point_f"]),
    "several detections of one point": (detection, {"most_pairs": lambda points, detections: sum(
        any(abs(d - p) <= 0.333 for p in points) for d in detections)}, ["action_point_f"]),
    "ties lost": (detection, {"tie_credit": lambda: 0.0}, ["roc_auc"]),
    "beats within five frames": (evaluation, {"BEAT_SIGMA": 5}, ["beat_alignment@bailando", "beat_alignment@mint"]),
    "speeds as they are": (evaluation, {"SMOOTHING": 1}, ["beat_alignment@bailando"]),
    "beats of two frames": (evaluation, {"MINT_ORDER": 2}, ["beat_alignment@mint"]),
    "quaternions as they are read": (evaluation, {"continuous": lambda quaternions, start: list(quaternions)}, [
        "l2q@lafan1", "npss@lafan1", "npss"]),
    "linear between frames": (evaluation, {"cubic": lambda frames, at: None if not 0 <= at <= len(frames) - 1 else [
        [a + (at - int(at)) * (b - a) for a, b in zip(p, q)]
        for p, q in zip(frames[int(at)], frames[min(int(at) + 1, len(frames) - 1)])]}, ["lag_ms"]),
    "misses left out": (detection, {"kaplan_meier_median": lambda waits: or_nothing(statistics.median)(
        [seconds for seconds, called in waits if called])}, ["latency_s"]),
}


class Metrics(EtudeCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.text = cls().etude("list", "metrics", "--json").stdout
        cls.catalogue = json.loads(cls.text)

    def second_implementation(self, catalogue):
        return subprocess.run([sys.executable, HERE / "second_implementation.py"], input=json.dumps(catalogue),
                              capture_output=True, text=True, timeout=600)

    def vectors(self):
        return [vector for metric in self.catalogue["metrics"] for vector in metric["vectors"]]

    def test_a_second_implementation_agrees_with_every_vector(self):
        result = self.second_implementation(self.catalogue)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn(f"{len(self.vectors())} vectors of {len(self.catalogue['metrics'])} metrics, 0 disagreements",
                      result.stdout)

    @heavy
    def test_a_wrong_expectation_is_reported(self):
        for name, change in {"value": {"expected": 2.1}, "null": {"expected": None}}.items():
            with self.subTest(name):
                catalogue = copy.deepcopy(self.catalogue)
                catalogue["metrics"][0]["vectors"][0].update(change)
                result = self.second_implementation(catalogue)
                self.assertEqual(result.returncode, 1)
                self.assertIn("position_error_cm: ", result.stdout)
                self.assertIn("1 disagreements", result.stdout)

    def test_a_metric_without_vectors_or_of_another_version_is_reported(self):
        catalogue = copy.deepcopy(self.catalogue)
        catalogue["metrics"][0]["vectors"] = []
        catalogue["metrics"][1]["version"] = 2
        del catalogue["metrics"][2]
        result = self.second_implementation(catalogue)
        self.assertEqual(result.returncode, 1)
        self.assertIn("3 disagreements", result.stdout)

    @heavy
    def test_the_vectors_notice_every_mistake_listed(self):
        for name, (module, parts, must_notice) in MUTANTS.items():
            with self.subTest(name), unittest.mock.patch.multiple(module, **parts):
                vectors = [vector for vector in self.vectors() if vector["metric"] in must_notice]
                noticed = {vector["metric"] for vector in vectors if not self.agrees(vector)}
                self.assertEqual(set(must_notice), noticed)

    @staticmethod
    def agrees(vector):
        try:
            return second.agrees(vector)
        except ArithmeticError:  # a mistake may also end in a division by zero
            return False

    def test_the_json_fits_its_schema(self):
        schema = load_schema("metrics.schema.json")
        self.assertEqual(complaints(self.catalogue, schema), [])
        self.assertEqual(own_complaints(self.catalogue, schema), [])

    def test_the_schema_flags_what_does_not_fit(self):
        schema = load_schema("metrics.schema.json")
        changes = {"direction": "up", "version": 0, "practical_threshold": -1, "vectors": [], "unit": None, "extra": 1,
                   "formula": ""}
        for key, value in changes.items():
            with self.subTest(key):
                catalogue = copy.deepcopy(self.catalogue)
                catalogue["metrics"][3][key] = value
                self.assertNotEqual(complaints(catalogue, schema), [])
                self.assertNotEqual(own_complaints(catalogue, schema), [])

    def test_rows_fit_their_schema(self):
        schema = load_schema("row.schema.json")
        rows = self.run_suite(self.write("ik.yaml", IK))
        self.assertTrue(rows)
        for row in rows:
            self.assertEqual(complaints(row, schema), [])
            self.assertEqual(own_complaints(row, schema), [])
        for key, value in {"status": "fine", "position_error_cm": "0.1", "digest_world": "NaN!", "trial": -1}.items():
            with self.subTest(key):
                self.assertNotEqual(complaints({**rows[0], key: value}, schema), [])
                self.assertNotEqual(own_complaints({**rows[0], key: value}, schema), [])
        del rows[0]["reason"]
        self.assertNotEqual(own_complaints(rows[0], schema), [])

    def test_the_row_schema_knows_exactly_the_metrics_of_the_catalogue(self):
        properties = load_schema("row.schema.json")["properties"]
        measured = [key for key, value in properties.items() if value == {"$ref": "#/$defs/measured"}]
        self.assertEqual(measured, [metric["id"] for metric in self.catalogue["metrics"]],
                         "write it anew: scripts/docs")

    def test_the_page_is_the_programs(self):
        page = self.etude("list", "metrics", "--markdown").stdout
        self.assertEqual((ROOT / "docs" / "reference" / "metrics.md").read_text(), page,
                         "write it anew: scripts/docs")

    def test_the_table_names_every_metric(self):
        lines = self.etude("list", "metrics").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], [metric["id"] for metric in self.catalogue["metrics"]])

    def test_json_and_markdown_together_are_refused(self):
        result = self.etude("list", "metrics", "--json", "--markdown")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(len(result.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()

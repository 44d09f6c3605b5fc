#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const MetricInput kMotion = {"motion", "the motion judged"};
const MetricInput kSeams = {"seams", "the frames of its seams: the last frame of each clip that was left"};
const std::vector<MetricInput> kSeamInputs = {kMotion, kSeams};
const std::vector<MetricInput> kMeetings = {
    {"rate_hz", "frames per second"},
    {"meetings",
     "per switch four poses, aligned: `leaving_before` and `leaving`, the old clip's frame before the switch and at "
     "it; `arriving` and `arriving_after`, the new clip's at the switch and after it"}};

const std::vector<MetricInput> kSpeedInputs = {kMotion,
                                               kSeams,
                                               {"speed_mps", "instead of these two: the speed profile itself"},
                                               {"rate_hz", "its samples per second"}};

const char* const kNoWay = "When no way was found (status unsolved).";
const std::string kSpeedProfile =
    "The speed profile: the mean over the twenty joints of ‖p_j(f+1) − p_j(f)‖ · rate for f from one second before the "
    "first seam to one second after the last, as far as the motion goes. ";

}  // namespace

std::vector<MetricInfo> TransitionCatalogue() {
  return {
      {.id = "jump_cm",
       .label = "jump at the seam",
       .unit = "cm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Largest second difference of any joint within 5 frames of the seam, at 30 Hz.",
       .practical_reason = "1 cm · 30² is 9 m/s², about the acceleration of free fall.",
       .formula = "100 · max_f max_j ‖p_j(f+1) − 2 p_j(f) + p_j(f−1)‖, metres at 30 Hz, over f = s−5 … s+5 for every "
                  "seam s (its frame: the last of the old clip), frames beyond the motion's ends left out; the worst "
                  "seam counts. The dancer's hips stand at 0.90 m. 0 for a motion of fewer than 3 frames.",
       .null_rule = kNoWay,
       .source = "Etude.",
       .inputs = kSeamInputs},
      {.id = "mean_joint_jump_cm",
       .label = "mean joint jump",
       .unit = "cm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.5,
       .definition = "As jump_cm, mean over joints instead of the largest.",
       .practical_reason = "Half of jump_cm's: a mean moves less than the worst.",
       .formula = "100 · max_f (1/20) Σ_j ‖p_j(f+1) − 2 p_j(f) + p_j(f−1)‖, frames as in jump_cm.",
       .null_rule = kNoWay,
       .source = "Etude.",
       .inputs = kSeamInputs},
      {.id = "rotation_step_change_deg",
       .label = "rotation step change",
       .unit = "deg",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition =
           "Angle between successive frame-to-frame rotations, largest over joints, within 5 frames of the seam.",
       .practical_reason = "A degree a frame is 30° a second.",
       .formula = "max_f max_b ∠(R_b(f, f+1) · R_b(f−1, f)⁻¹), degrees, frames as in jump_cm, over the nineteen limbs "
                  "b. R_b(f, g) is the smallest rotation that takes the limb's direction (parent to child) in frame f "
                  "to that in g: positions know no twist. It is the identity where the limb has no length, or the two "
                  "directions are parallel or opposite.",
       .null_rule = kNoWay,
       .source = "Etude.",
       .inputs = kSeamInputs},
      {.id = "jerk_peak_mps3",
       .label = "peak jerk",
       .unit = "m/s³",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 50,
       .definition = "Largest third difference of any joint × 30³, within 5 frames of the seam.",
       .practical_reason = "50 m/s³ are a third difference of 2 mm.",
       .formula = "rate³ · max_f max_j ‖p_j(f+2) − 3 p_j(f+1) + 3 p_j(f) − p_j(f−1)‖, metres, over f = s−5 … s+5 where "
                  "all four frames exist. 0 for a motion of fewer than 4 frames.",
       .null_rule = kNoWay,
       .source = "Flash and Hogan 1985 (jerk as the measure of smoothness), by finite differences.",
       .inputs = kSeamInputs},
      {.id = "foot_slide_cmps",
       .label = "foot slide",
       .unit = "cm/s",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Mean horizontal foot speed, weighted by closeness to the floor, for 1 s after the seam.",
       .practical_reason = "A centimetre a second is a third of a millimetre a frame.",
       .formula =
           "Mean over both feet and the frames f = s … s+29 (as far as f+1 exists) of v · clamp(2 − 2^(h / 2.5 "
           "cm), 0, 1): v = 100 · rate · √(Δx² + Δz²) from f to f+1, h the foot joint's height y at f, above the "
           "floor on which every clip was set down before it was switched, not above the foot's own lowest "
           "point: a foot that a join pushes through the floor would lift all others. Every foot and frame is "
           "in the denominator, lifted or not; the worst seam counts.",
       .null_rule = kNoWay,
       .source = "Zhang et al. 2018, Mode-Adaptive Neural Networks (foot skating).",
       .inputs = kSeamInputs},
      {.id = "pose_gap_cm",
       .label = "pose gap",
       .unit = "cm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Distance of the worst joint between the two seam frames after alignment on the floor.",
       .practical_reason = "A joint that moves at 30 cm/s moves so far in a frame.",
       .formula =
           "100 · max_j ‖leaving_j − arriving_j‖ of the two frames that meet: the old clip's last and the new "
           "clip's frame at the switch, the new clip turned about the vertical axis and moved on the floor so "
           "that heading and hip centre agree (heights and limbs stay). The worst switch counts. Unbroken motion meets "
           "itself, and has 0.",
       .null_rule = kNoWay,
       .source = "Kovar et al. 2002, Motion Graphs, section 3.1 (distance after alignment on the floor), worst joint.",
       .inputs = kMeetings},
      {.id = "velocity_gap_cmps",
       .label = "velocity gap",
       .unit = "cm/s",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 5,
       .definition =
           "Difference of the worst joint's velocity between the two seam frames after alignment on the floor.",
       .practical_reason = "5 cm/s are 1.7 mm in a frame.",
       .formula = "100 · rate · max_j ‖(leaving − leaving_before)_j − (arriving_after − arriving)_j‖, aligned as in "
                  "pose_gap_cm: the velocity on arriving at the frame left, against that on leaving the frame entered. "
                  "The worst switch counts. Of unbroken motion it is the second difference at that frame, times rate: "
                  "what velocity naturally changes in a frame.",
       .null_rule = kNoWay,
       .source = "Etude.",
       .inputs = kMeetings},
      {.id = "false_smooth",
       .label = "falsely smooth",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMean,
       .practical = 0.02,
       .definition = "1 when the fuzzy distance allowed the switch although pose_gap_cm exceeds 20, else 0.",
       .practical_reason = "One switch in fifty.",
       .formula = "1 if pose_gap_cm > 20, else 0 (exactly 20 is 0), for switches that a choice by fuzzy distance "
                  "allowed: d below the method's threshold, paper A's 0.4 unless the scenario says otherwise.",
       .null_rule = "When no way was found, or the choice matches no frames (now, wait-for-end); in task "
                    "pose-distance, when the poses were not called alike.",
       .source = "Etude: what paper A's distance cannot see.",
       .inputs = {{"matched", "whether a fuzzy distance chose the frames"}, {"pose_gap_cm", "the pose gap"}}},
      {.id = "natural_share",
       .version = 3,
       .label = "as smooth as nature",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.02,
       .definition = "1 when jump_cm does not exceed the 95th percentile of unbroken windows of the same clips, else "
                     "0, also where no "
                     "way was found.",
       .practical_reason = "One switch in fifty.",
       .formula =
           "1 if jump_cm ≤ q (1 + 10⁻⁹), else 0. q: jump_cm of every window of eleven frames of the two clips asked "
           "for, "
           "played unbroken by the same dancer (all eleven frames have both neighbours: a clip of n frames has "
           "n − 12 windows), both clips' in one sorted list x₀ … xₘ₋₁; its 95th percentile is linear between "
           "neighbours: at rank 0.95 (m − 1). An in-between's own clip sets no standard. The denominator of its "
           "mean is every cell: where no way was found it is 0 (since version 2; version 1 had no value there). "
           "Until version 2 a jump equal to q counted 0: q of few windows, or of a dance that repeats itself, is "
           "their largest, so that unbroken motion failed by itself.",
       .null_rule = "Never: no way, or no answer, is 0.",
       .source = "Etude.",
       .inputs = {{"jump_cm", "the switch's jump, null when no way was found"},
                  {"clips", "the motions of the two clips"}}},
      {.id = "wait_s",
       .label = "wait before the switch",
       .unit = "s",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition = "Time from request to switch.",
       .practical_reason = "A tenth of a second is what feels immediate (Nielsen 1993).",
       .formula = "Σ (until − from) / rate over the clips that play between the request and the wanted clip: the old "
                  "clip from the requested frame to the frame it is left at and, where there is one, the in-between "
                  "from its frame entered to its frame left.",
       .null_rule = kNoWay,
       .source = "Paper A, whose switches wait for a matching frame.",
       .inputs = {{"rate_hz", "frames per second"},
                  {"stays", "per clip that was waited in: `from_frame` and `until_frame`"}}},
      {.id = "fuzzy_distance",
       .label = "fuzzy distance",
       .unit = "",
       .direction = kNeither,
       .aggregate = kMedian,
       .practical = 0.05,
       .definition = "Paper A's distance d of the two seam frames (equation 1).",
       .practical_reason = "An eighth of paper A's threshold of 0.4.",
       .formula = "d = √(Σ_k S_k Σ_terms (μ₁ − μ₂)²) over ten features k with 24 terms; the largest d of the switches "
                  "counts. Grades μ are linear between these corners (input: grade) and constant outside: RH and LH "
                  "down 20: 1, 90: 0; mid 20: 0, 90: 1, 180: 0; up 90: 0, 180: 1. RHE and LHE false 0: 1, 90: 0; true "
                  "20: 0, 90: 1. Posture lie 0: 1, 40: 0; sit 0: 0, 40: 1, 80: 0; stand 40: 0, 80: 1, 120: 0; jump 80: "
                  "0, 120: 1. Trunk false 125: 0, 180: 1; true 110: 1, 180: 0. RF and LF inward 0: 1, 40: 0; outward "
                  "0: 0, 40: 1. RFK and LFK false 100: 0, 180: 1; true 90: 1, 180: 0. It is recorded whatever the "
                  "choice was, and no direction is better: it is the method's own opinion.",
       .null_rule = kNoWay,
       .source = "Paper A, equations 1–16.",
       .inputs = {{"weights", "S of RH, LH, RHE, LHE, Posture, Trunk, RF, LF, RFK, LFK"},
                  {"switches",
                   "per switch: `from_features` and `to_features`, the ten features in that order; degrees, Posture "
                   "with standing = 80"}}},
      {.id = "sparc",
       .label = "smoothness (SPARC)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition = "Spectral arc length of the speed profile: amplitude threshold 0.05, cut-off 10 Hz, padding 4.",
       .practical_reason = "A fourteenth of the arc of one smooth stroke (−1.41).",
       .formula = kSpeedProfile +
                  "Its N samples are padded with zeros to K = 2^(⌈log₂ N⌉ + 4); V_i is the magnitude of its Fourier "
                  "transform at i · rate / K, for all i up to 10 Hz included, divided by the largest. From the first "
                  "to the last i with V_i ≥ 0.05, m steps: −Σ √((1/m)² + (V_{i+1} − V_i)²).",
       .null_rule = "When no way was found; when nothing moves, or there are fewer than two samples; when one V_i "
                    "alone reaches 0.05.",
       .source = "Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet 2015.",
       .inputs = kSpeedInputs},
      {.id = "ldlj",
       .label = "smoothness (LDLJ)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.2,
       .definition = "Log dimensionless jerk of the speed profile around the seam.",
       .practical_reason = "A tenth more jerk: 2 ln 1.1.",
       .formula = kSpeedProfile +
                  "Of its N samples v, dt = 1 / rate apart: −ln((N dt)³ / max|v|² · Σ ((v_{i+1} − 2 v_i + v_{i−1}) / "
                  "dt²)² dt) over i = 1 … N−2; dt cancels. The longer the profile, the lower: a switch through an "
                  "in-between has a longer one.",
       .null_rule = "When no way was found; when nothing moves, the speed changes evenly (no jerk), or there are fewer "
                    "than three samples.",
       .source = "Balasubramanian, Melendez-Calderon and Burdet 2012; Balasubramanian et al. 2015.",
       .inputs = kSpeedInputs},
  };
}

}  // namespace etude

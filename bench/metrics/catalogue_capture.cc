#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const MetricInput kTruth = {"truth", "the true motion, of as many frames"};
const std::vector<MetricInput> kPoses = {{"found", "the recovered motion"}, kTruth};
const MetricInput kLimbs = {"limbs",
                            "per limb and frame: `found`, the direction measured, and `truth`, the true one, each [x, "
                            "y, z] of any length, or null where there is none"};
const MetricInput kEnds = {"ends_m",
                           "per end effector and frame: `found`, the point measured, and `truth`, the true one, each "
                           "[x, y, z] in metres, or null where there is none"};

const char* const kNoFrame = "When no frame was recovered.";
const char* const kMillimetre = "A pixel is 6 mm wide on the stage, and a human's marks are two pixels off.";
const char* const kHundredth = "One joint in a hundred.";
const char* const kCoverageSource = "Etude: an error over what was measured needs its denominator beside it.";
const char* const kPoseSource =
    "Ionescu et al. 2014, Human3.6M (MPJPE), here over the twenty joints of the canonical body, the root not aligned.";

}  // namespace

std::vector<MetricInfo> CaptureCatalogue() {
  return {
      {.id = "mpjpe_mm",
       .label = "joint error (MPJPE)",
       .unit = "mm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Distance of a recovered joint to the true one, mean over 20 joints and all frames.",
       .practical_reason = kMillimetre,
       .formula = "1000 · (1/(F·20)) Σ_f Σ_j ‖p_fj − t_fj‖ with p, t in metres in the world; nothing is aligned, not "
                  "even the root. F is every frame of the window: one that was not recovered holds the last recovered "
                  "pose (before the first, the first), so that failing on hard frames does not improve the mean. In "
                  "task tracking the truth is the pose of the body that is followed.",
       .null_rule = kNoFrame,
       .source = kPoseSource,
       .inputs = kPoses},
      {.id = "mpjpe_before_ik_mm",
       .label = "joint error before IK",
       .unit = "mm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "As mpjpe_mm, after the limb lengths are fixed and before inverse kinematics.",
       .practical_reason = kMillimetre,
       .formula = "The formula of mpjpe_mm for the pose put together from measured end effectors, limb directions and "
                  "known limb lengths, of the same frames.",
       .null_rule = "When no frame was recovered" + kOutside,
       .source = kPoseSource,
       .inputs = {{"before_ik", "the motion before inverse kinematics"}, kTruth}},
      {.id = "pa_mpjpe_mm",
       .label = "aligned joint error (PA-MPJPE)",
       .unit = "mm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "As mpjpe_mm, after the best similarity alignment of every frame, reflections excluded.",
       .practical_reason = kMillimetre,
       .formula =
           "Per frame p ↦ s R p + t with rotation R (det R = +1, never a reflection), scale s and translation t "
           "minimise Σ_j ‖s R p_j + t − t_j‖²; then mpjpe_mm of the aligned frames, so the mean of distances after an "
           "alignment that minimises their squares. A frame whose joints all lie in one place keeps s = 1.",
       .null_rule = kNoFrame,
       .source = "Umeyama 1991 (least squares similarity); Horn 1987 gives the same by quaternions.",
       .inputs = kPoses},
      {.id = "pck_50mm",
       .label = "joints within 5 cm (PCK)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Share of joints and frames whose error is below 50 mm.",
       .practical_reason = kHundredth,
       .formula = "#{(f, j): 1000 ‖p_fj − t_fj‖ < 50} / (F·20), frames as in mpjpe_mm, nothing aligned; exactly 50 mm "
                  "does not count.",
       .null_rule = kNoFrame,
       .source = "Mehta et al. 2017, MPI-INF-3DHP (3D PCK, there at 150 mm).",
       .inputs = kPoses},
      {.id = "auc_200mm",
       .label = "area under PCK, 0–20 cm",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Area under the share of joints within t, for t from 0 to 200 mm, divided by 200 mm.",
       .practical_reason = kHundredth,
       .formula = "(1/(F·20)) Σ max(0, 1 − e_fj / 200 mm) with e the joint error: the exact area under the PCK curve, "
                  "not a mean over sampled thresholds, which differs by up to half a step.",
       .null_rule = kNoFrame,
       .source = "Mehta et al. 2017, MPI-INF-3DHP (AUC, there up to 150 mm and sampled).",
       .inputs = kPoses},
      {.id = "bone_length_error_cm",
       .label = "limb length error",
       .unit = "cm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition = "Absolute difference of recovered and true limb length, mean over limbs and frames.",
       .practical_reason = "A millimetre, as for the joints.",
       .formula = "100 · (1/(F·19)) Σ_f Σ_b |‖p_child − p_parent‖ − ‖t_child − t_parent‖| over the nineteen limbs, "
                  "each from a joint to its parent; frames as in mpjpe_mm.",
       .null_rule = kNoFrame,
       .source = "Etude; paper B fixes the lengths of limbs.",
       .inputs = kPoses},
      {.id = "limb_direction_error_deg",
       .label = "limb direction error",
       .unit = "deg",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.25,
       .definition =
           "Angle between a limb's direction read from two images and the true one, mean over limbs and frames.",
       .practical_reason = "A forearm turned by a quarter of a degree moves the wrist by a millimetre.",
       .formula = "(1/n) Σ ∠(found, truth), degrees in [0°, 180°], over the n limbs·frames that were measured and have "
                  "a truth. What was not measured is not in this mean but in limb_direction_coverage. With `oracle: "
                  "[directions]` a limb's direction is the truth and counts as measured.",
       .null_rule = "When no limb was marked in both pictures of any frame" + kOutside,
       .source = "Paper B's directions from two images, judged against the synthetic truth.",
       .inputs = {kLimbs}},
      {.id = "limb_direction_coverage",
       .label = "limb directions measured",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Share of limbs·frames whose direction was measured: the denominator of limb_direction_error_deg.",
       .practical_reason = "One limb in a hundred.",
       .formula = "measured / all: all are the thirteen limbs that paper B marks with strokes, in every frame, where "
                  "their true length is above 0.",
       .null_rule = "When no limb has a true direction" + kOutside,
       .source = kCoverageSource,
       .inputs = {kLimbs}},
      {.id = "triangulation_error_mm",
       .label = "triangulation error",
       .unit = "mm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Distance of a triangulated end effector to the true one, mean over effectors and frames.",
       .practical_reason = kMillimetre,
       .formula = "1000 · (1/n) Σ ‖found − truth‖ over the n effectors·frames that were measured; what was not is in "
                  "triangulation_coverage. With `oracle: [points]` the point is the truth and counts as measured.",
       .null_rule = "When no end effector was marked in both pictures of any frame" + kOutside,
       .source = "Paper B's points from two images, judged against the synthetic truth.",
       .inputs = {kEnds}},
      {.id = "triangulation_coverage",
       .label = "end effectors measured",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Share of effectors·frames that were triangulated: the denominator of triangulation_error_mm.",
       .practical_reason = "One end effector in a hundred.",
       .formula = "measured / all: all are the five points that paper B marks with discs, in every frame.",
       .null_rule = "When no end effector has a true place" + kOutside,
       .source = kCoverageSource,
       .inputs = {kEnds}},
      {.id = "reprojection_rms_px",
       .label = "calibration reprojection error",
       .unit = "px",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition = "Root mean square distance between measured calibration points and their reprojection.",
       .practical_reason = "A tenth of a pixel is 0.6 mm on the stage.",
       .formula = "Per camera √((1/n) Σᵢ ‖π(Hᵢ) − mᵢ‖²) over its n calibration points, π(x, y, z) = (u/w, v/w) with "
                  "(u, v, w) = H (x, y, z, 1); then the mean over the cameras. The distance is of both coordinates "
                  "together, so it is √2 times a root mean square per coordinate.",
       .null_rule = "When a camera could not be calibrated" + kOutside,
       .source = "Hartley and Zisserman 2004, section 4.2 (geometric error in one image).",
       .inputs = {{"cameras",
                   "per camera: `matrix`, three rows of four; `points_m`, [x, y, z] in metres; `pixels`, the [u, v] "
                   "measured of each"}}},
      {.id = "frames_recovered",
       .label = "frames recovered",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Share of frames for which a skeleton could be computed.",
       .practical_reason = "One frame in a hundred.",
       .formula =
           "recovered / all frames of the window. A frame is recovered when its marks, or neighbours' at most half a "
           "second (or the distance of marked frames) away, gave a body and inverse kinematics an answer.",
       .null_rule = "Never: no answer, or a camera that could not be calibrated, is 0.",
       .source = "Etude.",
       .inputs = {{"recovered", "per frame 1 or 0"}}},
  };
}

}  // namespace etude

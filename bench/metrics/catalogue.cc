#include "bench/metrics/catalogue.h"

#include <vector>

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

/// metrics.md as data. `practical` is the smallest difference a user of the number would act on.
const std::vector<MetricInfo>& Catalogue() {
  static const std::vector<MetricInfo> metrics = {
      // Inverse kinematics.
      {"position_error_cm", 1, "effector position error", "cm", kLowerIsBetter, kMedian, 0.05,
       "Distance of an end effector to its target, mean over the four effectors."},
      {"position_error_max_cm", 1, "worst effector position error", "cm", kLowerIsBetter, kMedian, 0.05,
       "Distance of an end effector to its target, the worst of the four effectors."},
      {"orientation_error_deg", 1, "effector orientation error", "deg", kLowerIsBetter, kMedian, 0.1,
       "Angle between an effector's axis and its target, mean over three axes, then over the four effectors."},
      {"orientation_error_max_deg", 1, "worst effector orientation error", "deg", kLowerIsBetter, kMedian, 0.1,
       "Angle between an effector's axis and its target, mean over three axes, the worst of the four effectors."},
      {"hidden_angle_error_deg", 1, "hidden-angle error", "deg", kLowerIsBetter, kMedian, 0.25,
       "Root mean square, over all degrees of freedom, of the solved minus the true joint angle."},
      {"hidden_angle_change_deg", 1, "hidden-angle change", "deg", kLowerIsBetter, kMedian, 0.25,
       "Root mean square, over all degrees of freedom, of the solved minus the starting joint angle."},
      {"solved_practical", 1, "solved (0.1 cm, 0.1°)", "", kHigherIsBetter, kMean, 0.02,
       "1 when all effectors are within 0.1 cm and 0.1° of their targets, else 0."},
      {"solved_tight", 1, "solved (10⁻³ cm, 10⁻³°)", "", kHigherIsBetter, kMean, 0.02,
       "1 when all effectors are within 0.001 cm and 0.001° of their targets, else 0."},
      {"iterations", 1, "solver steps", "", kLowerIsBetter, kMedian, 5,
       "The solver's own steps until it stopped; the limit when it did not converge."},
      {"fk_evaluations", 1, "forward-kinematics passes", "", kLowerIsBetter, kMedian, 5,
       "Passes of forward kinematics over the whole tree, comparable across solvers."},

      // Camera capture.
      {"mpjpe_mm", 1, "joint error (MPJPE)", "mm", kLowerIsBetter, kMedian, 1,
       "Distance of a recovered joint to the true one, mean over 20 joints and all frames."},
      {"mpjpe_before_ik_mm", 1, "joint error before IK", "mm", kLowerIsBetter, kMedian, 1,
       "As mpjpe_mm, after the limb lengths are fixed and before inverse kinematics."},
      {"pa_mpjpe_mm", 1, "aligned joint error (PA-MPJPE)", "mm", kLowerIsBetter, kMedian, 1,
       "As mpjpe_mm, after the best similarity alignment of every frame, reflections excluded."},
      {"pck_50mm", 1, "joints within 5 cm (PCK)", "", kHigherIsBetter, kMedian, 0.01,
       "Share of joints and frames whose error is below 50 mm."},
      {"auc_200mm", 1, "area under PCK, 0–20 cm", "", kHigherIsBetter, kMedian, 0.01,
       "Area under the share of joints within t, for t from 0 to 200 mm, divided by 200 mm."},
      {"bone_length_error_cm", 1, "limb length error", "cm", kLowerIsBetter, kMedian, 0.1,
       "Absolute difference of recovered and true limb length, mean over limbs and frames."},
      {"limb_direction_error_deg", 1, "limb direction error", "deg", kLowerIsBetter, kMedian, 0.25,
       "Angle between a limb's direction read from two images and the true one, mean over limbs and frames."},
      {"triangulation_error_mm", 1, "triangulation error", "mm", kLowerIsBetter, kMedian, 1,
       "Distance of a triangulated end effector to the true one, mean over effectors and frames."},
      {"reprojection_rms_px", 1, "calibration reprojection error", "px", kLowerIsBetter, kMedian, 0.1,
       "Root mean square distance between measured calibration points and their reprojection."},
      {"frames_recovered", 1, "frames recovered", "", kHigherIsBetter, kMean, 0.01,
       "Share of frames for which a skeleton could be computed."},
      {"iou", 1, "person mask overlap (IoU)", "", kHigherIsBetter, kMedian, 0.01,
       "Pixels in both the found and the true person over pixels in either, mean over images."},
      {"mask_precision", 1, "mask precision", "", kHigherIsBetter, kMedian, 0.01,
       "Share of pixels called person that are person, mean over images."},
      {"mask_recall", 1, "mask recall", "", kHigherIsBetter, kMedian, 0.01,
       "Share of person pixels that are called person, mean over images."},
      {"mask_f1", 1, "mask F1", "", kHigherIsBetter, kMedian, 0.01,
       "Harmonic mean of mask precision and recall, mean over images."},
      {"shadow_error", 1, "shadow taken for person", "", kLowerIsBetter, kMedian, 0.01,
       "Share of true shadow pixels called person, mean over images."},

      // Transitions.
      {"jump_cm", 1, "jump at the seam", "cm", kLowerIsBetter, kMedian, 1,
       "Largest second difference of any joint within 5 frames of the seam, at 30 Hz."},
      {"mean_joint_jump_cm", 1, "mean joint jump", "cm", kLowerIsBetter, kMedian, 0.5,
       "As jump_cm, mean over joints instead of the largest."},
      {"rotation_step_change_deg", 1, "rotation step change", "deg", kLowerIsBetter, kMedian, 1,
       "Angle between successive frame-to-frame rotations, largest over joints, within 5 frames of the seam."},
      {"jerk_peak_mps3", 1, "peak jerk", "m/s³", kLowerIsBetter, kMedian, 50,
       "Largest third difference of any joint × 30³, within 5 frames of the seam."},
      {"foot_slide_cmps", 1, "foot slide", "cm/s", kLowerIsBetter, kMedian, 1,
       "Mean horizontal foot speed, weighted by closeness to the floor, for 1 s after the seam."},
      {"pose_gap_cm", 1, "pose gap", "cm", kLowerIsBetter, kMedian, 1,
       "Distance of the worst joint between the two seam frames after alignment on the floor."},
      {"velocity_gap_cmps", 1, "velocity gap", "cm/s", kLowerIsBetter, kMedian, 5,
       "Difference of the worst joint's velocity between the two seam frames after alignment on the floor."},
      {"false_smooth", 1, "falsely smooth", "", kLowerIsBetter, kMean, 0.02,
       "1 when the fuzzy distance allowed the switch although pose_gap_cm exceeds 20, else 0."},
      {"natural_share", 1, "as smooth as nature", "", kHigherIsBetter, kMean, 0.02,
       "1 when jump_cm is below the 95th percentile of unbroken windows of the same clips, else 0."},
      {"wait_s", 1, "wait before the switch", "s", kLowerIsBetter, kMedian, 0.1, "Time from request to switch."},
      {"fuzzy_distance", 1, "fuzzy distance", "", kNeither, kMedian, 0.05,
       "Paper A's distance d of the two seam frames (equation 1)."},
      {"sparc", 1, "smoothness (SPARC)", "", kHigherIsBetter, kMedian, 0.1,
       "Spectral arc length of the speed profile: amplitude threshold 0.05, cut-off 10 Hz, padding 4."},

      // Move detection.
      {"precision", 1, "precision", "", kHigherIsBetter, kMedian, 0.01,
       "Share of performances called right that are right."},
      {"recall", 1, "recall", "", kHigherIsBetter, kMedian, 0.01, "Share of right performances that are called right."},
      {"f1", 1, "F1", "", kHigherIsBetter, kMedian, 0.01, "Harmonic mean of precision and recall."},
      {"roc_auc", 1, "ROC area", "", kHigherIsBetter, kMedian, 0.01,
       "Probability that a right performance scores above a faulty one; ties count half."},
      {"latency_s", 1, "detection latency", "s", kLowerIsBetter, kMedian, 0.05,
       "Median time from first truly right to first called right; misses are censored (Kaplan–Meier)."},
      {"false_alarms_per_min", 1, "false alarms", "1/min", kLowerIsBetter, kMedian, 0.5,
       "Times per minute that a move is called right outside the window of its performance."},
  };
  return metrics;
}

}  // namespace

std::string_view DirectionWords(Direction direction) {
  switch (direction) {
    case Direction::kLowerIsBetter:
      return "lower is better";
    case Direction::kHigherIsBetter:
      return "higher is better";
    case Direction::kNeither:
      break;
  }
  return "";
}

std::span<const MetricInfo> AllMetrics() { return Catalogue(); }

const MetricInfo* FindMetric(std::string_view id) {
  for (const MetricInfo& metric : Catalogue()) {
    if (metric.id == id) return &metric;
  }
  return nullptr;
}

}  // namespace etude

#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A similarity: p ↦ scale · rotation · p + translation.
struct Similarity {
  double scale = 1;
  glm::dmat3 rotation{1};
  glm::dvec3 translation{0};

  glm::dvec3 Apply(const glm::dvec3& p) const { return scale * (rotation * p) + translation; }
};

/// The similarity that brings `points` closest to `targets` in the sense of least squares (Procrustes;
/// Umeyama 1991). Never a reflection. Points all in one place keep their scale. As many of one as of the other.
Similarity AlignSimilarity(std::span<const glm::dvec3> points, std::span<const glm::dvec3> targets);

/// Mean distance of a joint to the true one, millimetres.
double FrameMpjpeMm(const BodyPose& found, const BodyPose& truth);
/// The mean joint error after `AlignSimilarity` of this frame.
double FramePaMpjpeMm(const BodyPose& found, const BodyPose& truth);

/// The errors of a recovered motion against the true one (docs/reference/metrics.md), over all joints and frames.
struct PoseErrors {
  double mpjpe_mm = 0;
  double pa_mpjpe_mm = 0;
  double pck_50mm = 0;               ///< share of joints nearer than 50 mm
  double auc_200mm = 0;              ///< area under that share for 0…200 mm, divided by 200 mm
  double bone_length_error_cm = 0;   ///< mean absolute difference over the nineteen limbs
  double joint_angle_error_deg = 0;  ///< mean absolute difference of the angles between successive limbs
  std::vector<double> frame_mpjpe_mm;
};

/// Measures a recovered motion; both have the same number of frames, at least one.
PoseErrors ComparePoses(std::span<const BodyPose> found, std::span<const BodyPose> truth);

/// `mpjpe_seen_mm` and `mpjpe_held_mm`: the mean of one value per frame over the frames that have a flag; nothing when
/// none has. As many of one as of the other.
std::optional<double> MeanOfFlagged(std::span<const double> values, const std::vector<bool>& flags);

/// `jerk_error_mps3`: the mean length of the difference of the third differences of found and true joints, times rate³,
/// over all joints and all runs of four successive frames that are judged; nothing when there is no such run.
std::optional<double> JerkErrorMps3(std::span<const BodyPose> found, std::span<const BodyPose> truth,
                                    const std::vector<bool>& judged, double rate_hz);

/// `limb_length_error_mm`: mean absolute difference of lengths in metres, as many of one as of the other, at least one.
double LimbLengthErrorMm(std::span<const double> found_m, std::span<const double> true_m);

}  // namespace etude

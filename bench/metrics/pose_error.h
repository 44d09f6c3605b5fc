#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A similarity transformation: p ↦ scale · rotation · p + translation.
struct Similarity {
  double scale = 1;
  glm::dmat3 rotation{1};
  glm::dvec3 translation{0};

  glm::dvec3 Apply(const glm::dvec3& p) const { return scale * (rotation * p) + translation; }
};

/// Sums over points and their targets, from which the best similarity is computed.
struct PointMoments {
  double count = 0;
  glm::dvec3 mean{0}, target_mean{0};
  glm::dmat3 covariance{0};  ///< Σ (target − target_mean) (point − mean)ᵀ
  double scatter = 0;        ///< Σ ‖point − mean‖²

  /// Adds the sums over other points (Chan et al. 1979).
  void Add(const PointMoments& other);
};
/// Returns the sums over all points. A point is left out if it or its target is NaN. Both spans have the same size.
PointMoments MomentsOf(std::span<const glm::dvec3> points, std::span<const glm::dvec3> targets);

/// Returns the similarity that maps points to their targets with the least squared error (Procrustes; Umeyama 1991). It
/// is never a reflection. If all points coincide, the scale is 1. At least one point is required.
Similarity AlignSimilarity(const PointMoments& moments);
Similarity AlignSimilarity(std::span<const glm::dvec3> points, std::span<const glm::dvec3> targets);

/// Returns the mean joint error (MPJPE) of one frame, millimetres.
double FrameMpjpeMm(const BodyPose& found, const BodyPose& truth);
/// Returns the mean joint error of one frame after `AlignSimilarity` of that frame (PA-MPJPE), millimetres.
double FramePaMpjpeMm(const BodyPose& found, const BodyPose& truth);

/// The errors of a recovered motion with respect to the true one, over all joints and frames
/// (docs/reference/metrics.md).
struct PoseErrors {
  double mpjpe_mm = 0;
  double pa_mpjpe_mm = 0;
  double pck_50mm = 0;  ///< share of joints nearer than 50 mm to their true position
  /// Mean, over thresholds from 0 to 200 mm, of the share of joints whose error is below the threshold.
  double auc_200mm = 0;
  double bone_length_error_cm = 0;   ///< mean absolute difference of the limb lengths, over nineteen limbs
  double joint_angle_error_deg = 0;  ///< mean absolute difference of the angles between successive limbs
  std::vector<double> frame_mpjpe_mm;
};

/// Measures the errors of a recovered motion. Both motions have the same number of frames, at least one.
PoseErrors ComparePoses(std::span<const BodyPose> found, std::span<const BodyPose> truth);

/// Returns the mean of one value per frame over the frames whose flag is set (`mpjpe_seen_mm`, `mpjpe_held_mm`);
/// nullopt if no flag is set. Both arguments have the same size.
std::optional<double> MeanOfFlagged(std::span<const double> values, const std::vector<bool>& flags);

/// Returns `jerk_error_mps3`: the mean length of the difference between the third differences of found and true joints,
/// times rate³. The mean is over all joints and all groups of four successive judged frames; nullopt if there is no
/// such group.
std::optional<double> JerkErrorMps3(std::span<const BodyPose> found, std::span<const BodyPose> truth,
                                    const std::vector<bool>& judged, double rate_hz);

/// Returns `limb_length_error_mm`: the mean absolute difference of the limb lengths, millimetres. The inputs are in
/// metres and have the same size, at least one.
double LimbLengthErrorMm(std::span<const double> found_m, std::span<const double> true_m);

}  // namespace etude

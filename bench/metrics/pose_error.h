#pragma once

#include <glm/glm.hpp>
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
/// The same after `AlignSimilarity` of this frame.
double FramePaMpjpeMm(const BodyPose& found, const BodyPose& truth);

/// How far a recovered motion is from the true one (docs/metrics.md), over all joints and frames.
struct PoseErrors {
  double mpjpe_mm = 0;
  double pa_mpjpe_mm = 0;
  double pck_50mm = 0;              ///< share of joints nearer than 50 mm
  double auc_200mm = 0;             ///< area under that share for 0…200 mm, divided by 200 mm
  double bone_length_error_cm = 0;  ///< mean absolute difference over the nineteen limbs
  std::vector<double> frame_mpjpe_mm;
};

/// Both motions have the same number of frames, at least one.
PoseErrors ComparePoses(std::span<const BodyPose> found, std::span<const BodyPose> truth);

}  // namespace etude

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "engine/fuzzy/features.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

/// Returns true if the frame shows the key pose: every target's feature (engine/fuzzy) lies within its tolerance.
inline bool ShowsKeyPose(const KeyPose& key_pose, const BodyPose& pose, double standing_hip_height) {
  const PoseFeatures features = ComputeFeatures(pose, standing_hip_height);
  return std::ranges::all_of(key_pose.targets, [&](const KeyPose::Target& target) {
    const Feature* feature = FindFeature(target.feature);
    return feature != nullptr && std::abs(features[*feature] - target.degrees) <= target.tolerance_deg;
  });
}

/// Returns the first time (s from the motion's first frame) by which every key pose was shown in frames of [from_s,
/// to_s], in any order; nothing if one is never shown. Tests use it to check that moves contain the key poses that
/// recognisers learn. It is not the truth by which recognisers are judged.
inline std::optional<double> FirstReached(std::span<const KeyPose> key_poses, const BodyMotion& motion, double from_s,
                                          double to_s) {
  if (motion.poses.empty()) return std::nullopt;
  const double standing = StandingHipHeight(motion.poses.front());
  // Frames are counted, because the window's end must not depend on rounding.
  constexpr double kSlack = 1e-9;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(from_s * motion.rate_hz - kSlack)));
  double reached_s = from_s;
  for (const KeyPose& key_pose : key_poses) {
    std::size_t frame = first;
    const auto inside = [&] {
      return frame < motion.poses.size() && static_cast<double>(frame) <= to_s * motion.rate_hz + kSlack;
    };
    while (inside() && !ShowsKeyPose(key_pose, motion.poses[frame], standing)) ++frame;
    if (!inside()) return std::nullopt;
    reached_s = std::max(reached_s, static_cast<double>(frame) / motion.rate_hz);
  }
  return reached_s;
}

}  // namespace etude

#pragma once

#include <cmath>

#include "engine/transitions/library/bridge_frames.h"
#include "tests/engine/fuzzy/posed_body.h"

namespace etude {

/// Returns a clip of `frames` frames in which a body stands still with both arms raised sideways by `degrees`.
inline BodyMotion StandingClip(int frames, double degrees) {
  PosedBody body;
  const glm::dvec3 left(1, 0, 0);
  body.left_arm = {PosedBody::Raised(degrees, left), PosedBody::Raised(degrees, left)};
  body.right_arm = {PosedBody::Raised(degrees, -left), PosedBody::Raised(degrees, -left)};
  return {kJudgedRateHz, std::vector<BodyPose>(static_cast<std::size_t>(frames), body.Pose())};
}

/// Returns a clip in which the arms swing from hanging to overhead and back while the body walks and turns. It is
/// smooth, and no two frames are alike.
inline BodyMotion WavingClip(int frames, double phase = 0) {
  BodyMotion motion;
  for (int f = 0; f < frames; ++f) {
    const double swing = 80 + 70 * std::sin(0.11 * f + phase);
    const FloorMove walk{.yaw = 0.02 * f, .x = 0.013 * f, .z = -0.004 * f};
    motion.poses.push_back(walk.Apply(StandingClip(1, swing).poses[0]));
  }
  return motion;
}

/// Returns a clip with fuzzy grades instead of poses: each frame's RH grade is `levels[f]`, so that the distance of two
/// frames is the difference of their levels.
inline TaggedClip ClipOfLevels(const std::vector<double>& levels, std::vector<int> bridge_frames) {
  TaggedClip clip;
  for (double level : levels) {
    Grades grades{};
    grades[0] = level;
    clip.grades.push_back(grades);
    clip.tags.push_back(Tags{});
  }
  clip.bridge_frames = std::move(bridge_frames);
  return clip;
}

}  // namespace etude

#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/fuzzy/membership.h"
#include "sim/random/stream.h"

namespace etude {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns grades like those of a motion: every feature's input changes smoothly, so that consecutive frames are
/// similar.
inline std::vector<Grades> WanderingFrames(int count, RandomStream& stream) {
  std::vector<Grades> frames;
  PoseFeatures features, speeds;
  for (double& value : features.values) value = stream.Uniform(0, 180);
  for (int f = 0; f < count; ++f) {
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      const double high = k == static_cast<std::size_t>(Feature::kPosture) ? 120 : 180;
      speeds.values[k] = 0.9 * speeds.values[k] + stream.Normal(0, 1.5);
      features.values[k] = std::clamp(features.values[k] + speeds.values[k], 0.0, high);
    }
    frames.push_back(Fuzzify(features));
  }
  return frames;
}

/// Returns grades that no motion has: each is independent and uniform in [low, high).
inline std::vector<Grades> RandomFrames(int count, double low, double high, RandomStream& stream) {
  std::vector<Grades> frames(static_cast<std::size_t>(count));
  for (Grades& grades : frames) {
    for (double& grade : grades) grade = stream.Uniform(low, high);
  }
  return frames;
}

inline RandomStream SearchDice(const char* purpose) {
  return RandomStream({.suite_seed = 11, .scenario = "search", .trial = 0}, purpose);
}

}  // namespace etude

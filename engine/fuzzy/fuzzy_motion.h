#pragma once

#include <string>
#include <vector>

#include "engine/fuzzy/fuzzy_system.h"
#include "engine/motion/body.h"

namespace etude {

/// A motion as the fuzzy system sees it, frame by frame.
struct FuzzyMotion {
  double rate_hz = kJudgedRateHz;
  std::vector<PoseFeatures> features;
  std::vector<Grades> grades;
  std::vector<Tags> tags;
  std::vector<std::string> poses;  ///< what the rules conclude; "" where no rule holds
};

/// Fuzzifies every frame of any motion and lets the rules name its pose. `standing_hip_height` is the one of the body
/// that performs it, metres, > 0 (StandingHipHeight).
FuzzyMotion FuzzifyMotion(const BodyMotion& motion, double standing_hip_height, const FuzzySystem& system = {});

}  // namespace etude

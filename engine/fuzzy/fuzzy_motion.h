#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/fuzzy/membership.h"
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

struct MotionSimilarityOptions {
  FeatureWeights weights = PaperWeights();
  /// The distance by which the warping path may leave the straight one, as a share of the motions' lengths: 0.1 lets a
  /// beat fall a second early or late in ten. 1 = no bound. In [0, 1].
  double band = 0.1;
  /// A mean distance of this much makes a similarity of 0.5. > 0.
  double half_at = kPaperThreshold;
  /// The similarity below which the answer no longer matters: the search gives up early. 0 = it never does.
  double at_least = 0;
};

/// Paper A's future work 3, a fuzzy similarity of two whole motions: s = 1 / (1 + D / half_at), in (0, 1], 1 for a
/// motion and itself, the same both ways, and (but for the band) blind to tempo.
///
/// D is the mean of equation 1's distance along the best warping path (dynamic time warping, Sakoe and Chiba 1978: the
/// symmetric form without slope constraint, divided by the sum of both lengths). The turning of a distance into a
/// similarity is Kóczy's, s = 1 / (1 + d), in units of the threshold.
///
/// Nothing when the similarity is below `at_least`, or a motion has no frame. O(n · m · band) time, O(m) memory.
std::optional<double> ComputeMotionSimilarity(std::span<const Grades> a, std::span<const Grades> b,
                                              const MotionSimilarityOptions& options = {});

}  // namespace etude

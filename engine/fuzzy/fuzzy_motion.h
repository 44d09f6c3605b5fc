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

/// A motion after fuzzification, frame by frame.
struct FuzzyMotion {
  double rate_hz = kJudgedRateHz;
  std::vector<PoseFeatures> features;
  std::vector<Grades> grades;
  std::vector<Tags> tags;
  std::vector<std::string> poses;  ///< the pose that the rules conclude; "" if no rule holds
};

/// Fuzzifies every frame of a motion, and names its pose by the rules. `standing_hip_height` is the hip height of the
/// performing body, in metres, > 0 (StandingHipHeight).
FuzzyMotion FuzzifyMotion(const BodyMotion& motion, double standing_hip_height, const FuzzySystem& system = {});

struct MotionSimilarityOptions {
  FeatureWeights weights = PaperWeights();
  /// The half-width of the Sakoe–Chiba band: the largest deviation of the warping path from the diagonal, as a share of
  /// the motions' lengths, in [0, 1]. At 0.1, a beat may be one second early or late in ten seconds; 1 means no limit.
  double band = 0.1;
  /// The mean distance at which the similarity is 0.5; > 0.
  double half_at = kPaperThreshold;
  /// The search may return nullopt early if the similarity is certainly below this value; 0 turns this off.
  double at_least = 0;
};

/// Computes a fuzzy similarity of two whole motions, which paper A leaves as future work 3: s = 1 / (1 + D / half_at),
/// in (0, 1]. It is symmetric, it is 1 between a motion and itself, and it does not depend on tempo as long as the path
/// stays within the band.
///
/// D is the mean of paper A's distance (equation 1) along the best warping path (dynamic time warping, Sakoe and Chiba
/// 1978: the symmetric form without slope constraint, divided by the sum of the two motions' lengths). The formula for
/// s is Kóczy's, s = 1 / (1 + d), with the distance in units of `half_at`.
///
/// Returns nullopt if the similarity is below `at_least` or a motion has no frame. The computation takes O(n · m ·
/// band) time and O(m) memory for motions of n and m frames.
std::optional<double> ComputeMotionSimilarity(std::span<const Grades> a, std::span<const Grades> b,
                                              const MotionSimilarityOptions& options = {});

}  // namespace etude

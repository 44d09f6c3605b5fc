#pragma once

#include <optional>
#include <span>

#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"

namespace etude {

struct MotionSimilarityOptions {
  FeatureWeights weights = PaperWeights();
  /// How far the warping path may leave the straight one, as a share of the motions' lengths: 0.1 lets a beat fall a
  /// second early or late in ten. 1 = no bound. In [0, 1].
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

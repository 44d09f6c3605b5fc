#pragma once

#include <array>

#include "engine/fuzzy/membership.h"

namespace etude {

/// One number per feature, in the order of `AllFeatures`.
using PerFeature = std::array<double, kFeatureCount>;

/// The weights S of equation 1: how much each feature counts. They sum to 8, so that thresholds keep their meaning.
using FeatureWeights = PerFeature;
constexpr double kWeightSum = 8;

/// Paper A's weights, as scenarios/fuzzy/paper.yaml holds them: hands and body 1, feet 0.5 (A says only hands = body >
/// feet; the values are ours).
FeatureWeights PaperWeights();

/// Two frames closer than this may be a transition point (paper A).
constexpr double kPaperThreshold = 0.4;

/// Returns, per feature k, Δ_k² = Σ over the terms of feature k of (μ₁ − μ₂)².
PerFeature SquaredGradeGaps(const Grades& a, const Grades& b);

/// The distance of two frames and each feature's part in it.
struct FuzzyDistance {
  double value = 0;       ///< d of equation 1
  PerFeature partials{};  ///< S_k Δ_k², which sum to d²
};

/// Computes equation 1, d = sqrt(Σ_k S_k Σ_terms (μ₁ − μ₂)²): a Euclidean distance in 24 dimensions.
FuzzyDistance ComputeDistance(const Grades& a, const Grades& b, const FeatureWeights& weights);

/// Says whether ComputeDistance's d < `threshold`, to the last bit; stops adding up as soon as the answer is known.
bool IsCloser(const Grades& a, const Grades& b, const FeatureWeights& weights, double threshold);

}  // namespace etude

#pragma once

#include <array>

#include "engine/fuzzy/membership.h"

namespace etude {

/// One number per feature, in the order of `AllFeatures`.
using PerFeature = std::array<double, kFeatureCount>;

/// The weights S of paper A's equation 1, one per feature. They sum to 8, so that a threshold means the same for all
/// weights.
using FeatureWeights = PerFeature;
constexpr double kWeightSum = 8;

/// Returns paper A's weights, as in scenarios/fuzzy/paper.yaml: hands and body 1, feet 0.5 (the paper only states hands
/// = body > feet; the values are ours).
FeatureWeights PaperWeights();

/// Two frames with a smaller distance may form a transition point (paper A).
constexpr double kPaperThreshold = 0.4;

/// Returns Δ_k² for each feature k: the sum of (μ₁ − μ₂)² over its terms.
PerFeature SquaredGradeGaps(const Grades& a, const Grades& b);

/// The distance of two frames and the contribution of each feature.
struct FuzzyDistance {
  double value = 0;       ///< d of equation 1
  PerFeature partials{};  ///< S_k Δ_k², which sum to d²
};

/// Computes paper A's equation 1, d = sqrt(Σ_k S_k Σ_terms (μ₁ − μ₂)²): a Euclidean distance in 24 dimensions.
FuzzyDistance ComputeDistance(const Grades& a, const Grades& b, const FeatureWeights& weights);

/// Returns the value of ComputeDistance(…) < `threshold`, but stops summing as soon as the answer is known.
bool IsCloser(const Grades& a, const Grades& b, const FeatureWeights& weights, double threshold);

}  // namespace etude

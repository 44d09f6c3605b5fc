#pragma once

#include <span>

#include "engine/fuzzy/distance.h"

namespace etude {

/// One training example: two frames of different clips, and whether a person could not tell them apart.
struct LabelledPair {
  PerFeature squared_gaps{};  ///< Δ_k² of the two frames
  bool close = false;         ///< the worst joint is less than the chosen pose gap apart
};

struct WeightFitOptions {
  /// Pull towards zero, relative to one pair: keeps the fit finite when the pairs are separable.
  double ridge = 1e-2;
  int max_iterations = 40;
  /// Newton's method has converged when no coefficient moves by more than this.
  double tolerance = 1e-8;
};

enum class WeightFitStatus {
  kFitted,
  kOneClassOnly,   ///< no close pair, or no far one: nothing to learn from
  kNothingCounts,  ///< every weight came out negative
  kNotConverged,
};

/// The result of a fit. Unless `status` is kFitted, `weights` are paper A's.
struct WeightFit {
  WeightFitStatus status = WeightFitStatus::kOneClassOnly;
  FeatureWeights weights = PaperWeights();
  int pairs = 0;
  int close_pairs = 0;
  int iterations = 0;
};

/// The `adaptive` weights (algorithms A5, ours): logistic regression, P(close) = σ(b − Σ w_k Δ_k²), by
/// Newton's method; then w clipped at 0 and rescaled to sum to 8, so that 0.4 keeps its meaning.
WeightFit FitWeights(std::span<const LabelledPair> pairs, const WeightFitOptions& options = {});

}  // namespace etude

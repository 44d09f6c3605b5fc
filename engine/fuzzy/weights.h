#pragma once

#include <span>

#include "engine/fuzzy/distance.h"

namespace etude {

/// One training example: two frames of different clips, and whether their poses are practically the same.
struct LabelledPair {
  PerFeature squared_gaps{};  ///< Δ_k² of the two frames
  bool close = false;         ///< true if the PoseGap of the two frames is below a limit that the caller sets
};

struct WeightFitOptions {
  /// The weight of the L2 penalty (ridge), relative to the loss of one pair. It keeps the coefficients finite if a
  /// threshold separates the two classes perfectly.
  double ridge = 1e-2;
  int max_iterations = 40;
  /// Newton's method has converged if no coefficient changes by more than this share of the largest coefficient.
  double tolerance = 1e-8;
};

enum class WeightFitStatus {
  kFitted,
  kOneClassOnly,   ///< all pairs are close, or all are far, so nothing can be learnt
  kNothingCounts,  ///< no coefficient is positive
  kNotConverged,
};

/// The result of a fit. If `status` is not kFitted, `weights` are paper A's, or the start of a genetic search.
struct WeightFit {
  WeightFitStatus status = WeightFitStatus::kOneClassOnly;
  FeatureWeights weights = PaperWeights();
  int pairs = 0;
  int close_pairs = 0;
  int iterations = 0;
};

/// Fits the `adaptive` weights (ours) by logistic regression, P(close) = σ(b − Σ w_k Δ_k²), with Newton's method. Then
/// w is clipped at 0 and rescaled to sum to 8.
WeightFit FitWeights(std::span<const LabelledPair> pairs, const WeightFitOptions& options = {});

}  // namespace etude

#pragma once

#include <span>
#include <vector>

#include "engine/fuzzy/weights.h"

namespace etude {

/// How well "d < threshold" tells close pairs from others.
struct MatchScore {
  int matched = 0;        ///< pairs with d < threshold
  int close = 0;          ///< pairs that are close
  int close_matched = 0;  ///< both

  /// The harmonic mean of precision (how many that are let through look alike) and recall (how many that look alike are
  /// let through, the choice that is left); 0 when no close pair is. Not accuracy or AUC: close pairs are few, and
  /// both of those are ruled by the mass of far pairs that no threshold near 0.4 ever lets through.
  double F1() const { return close_matched > 0 ? 2.0 * close_matched / (matched + close) : 0; }
};

/// Labelled pairs laid out for scoring many weights quickly: feature by feature, in single precision.
class PairTable {
 public:
  explicit PairTable(std::span<const LabelledPair> pairs);

  MatchScore Score(const FeatureWeights& weights, double threshold = kPaperThreshold) const;
  /// F1 with a threshold that is no cliff: a pair counts as let through by a share that falls evenly from 1 to 0 as d²
  /// goes from (1 − ramp) · threshold² to (1 + ramp) · threshold². `ramp` > 0.
  double SoftF1(const FeatureWeights& weights, double threshold, double ramp) const;

 private:
  /// Pairs of a block stand side by side.
  static constexpr int kBlock = 64;
  struct Block {
    float squared_gaps[kFeatureCount][kBlock];
    int used[kBlock];   // 1; 0 in the rest of the last block
    int close[kBlock];  // 1 or 0
  };
  static void AddUp(const Block& block, const FeatureWeights& weights, float (&squared)[kBlock]);

  std::vector<Block> blocks_;
  int close_count_ = 0;
};

}  // namespace etude

#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/recognition/performance_measures.h"

namespace etude {

/// Three questions "is this measure at most that?", and what the answers add to the log-odds. Node n's children are
/// 2n + 1 (yes) and 2n + 2 (no); the last row's are leaves.
struct DecisionTree {
  static constexpr std::size_t kNodes = 7, kLeaves = 8;
  std::array<int, kNodes> measures{};  ///< indices below kMeasureCount
  std::array<double, kNodes> limits{};
  std::array<double, kLeaves> leaves{};

  double Value(const PerformanceMeasures& of) const;
};

/// Gradient-boosted decision trees (Friedman 2001): how right a performance looks by its measures.
struct BoostedTrees {
  double bias = 0;  ///< log-odds
  std::vector<DecisionTree> trees;

  /// Returns the probability that the performance is right, in (0, 1).
  double Probability(const PerformanceMeasures& of) const;
};

/// Performances of one window: right if one of them is, wrong if none is.
struct LabelledBag {
  bool is_right = false;
  std::vector<PerformanceMeasures> performances;  ///< at least one; the likeliest first
};

struct BoostingOptions {
  int trees = 100;
  double rate = 0.12;       ///< how much of its fit a tree adds
  double ridge = 3;         ///< pulls leaves towards 0, in performances of even odds × 4
  int least_per_leaf = 12;  ///< performances
  /// Trees take turns: each sees three fifths of the performances and a third of the measures, so that many of them
  /// differ (Friedman 2002, by turns in the place of dice).
  bool takes_turns = false;
  /// Each begins with the performance of every bag that the round before thought likeliest, since that one decides; the
  /// first with the first.
  int rounds = 3;
};

/// Fits trees by Newton's boosting of the logistic loss, measures cut at 63 quantiles; right and wrong bags weigh alike
/// in all. No dice. Without a right or without a wrong bag: no trees, even odds.
BoostedTrees FitBoostedTrees(std::span<const LabelledBag> bags, const BoostingOptions& options = {});

}  // namespace etude

#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/embedded_text.h"
#include "engine/base/result.h"
#include "engine/recognition/measuring_recogniser.h"
#include "engine/recognition/performance_measures.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

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

/// A model learnt from right and faulty performances of any move, kept in a file so that nobody need train.
struct LearntModel {
  BoostedTrees asked, spotted;
};

/// Reads the text of a model file (`etude train --recogniser`); `file` is what complaints call it.
Result<LearntModel> ReadLearntModel(std::string_view text, const std::string& file);
/// The text that ReadLearntModel reads back to the same model, to the last bit.
std::string WriteLearntModel(const LearntModel& model);

/// Returns the files scenarios/recognisers/*.yaml (written by the build).
std::span<const EmbeddedText> BuiltinLearntModelFiles();
/// Returns the model of recogniser `learnt`: scenarios/recognisers/learnt.yaml.
const LearntModel& BuiltinLearntModel();
/// Returns the model of recogniser `coached`: scenarios/recognisers/coached.yaml of performances asked for, learnt.yaml
/// of others.
const LearntModel& BuiltinCoachedModel();

/// Makes our learnt recogniser: performances are aligned with the taught examples, measured, and judged by what
/// simulated people taught the model; what is farther from every example than nearly all that taught it is no move at
/// all. The moves are those taught: the model knows none.
std::unique_ptr<Recogniser> MakeLearntRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                 const LearntModel& model);

}  // namespace etude

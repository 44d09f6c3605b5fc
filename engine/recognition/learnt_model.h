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

/// A decision tree of depth three. Each node compares one measure with a limit; the leaf that is reached adds its value
/// to the log-odds. Node n leads to node 2n + 1 if its measure is at most its limit, otherwise to node 2n + 2. The last
/// row of nodes leads to the leaves.
struct DecisionTree {
  static constexpr std::size_t kNodes = 7, kLeaves = 8;
  std::array<int, kNodes> measures{};  ///< index of each node's measure, below kMeasureCount
  std::array<double, kNodes> limits{};
  std::array<double, kLeaves> leaves{};

  /// Returns the value of the leaf that the performance reaches, in log-odds.
  double Value(const PerformanceMeasures& of) const;
};

/// Gradient-boosted decision trees (Friedman 2001). They judge from the measures of a performance whether it is right.
struct BoostedTrees {
  double bias = 0;  ///< log-odds before the first tree
  std::vector<DecisionTree> trees;

  /// Returns the probability that the performance is right, in (0, 1).
  double Probability(const PerformanceMeasures& of) const;
};

/// The candidate performances of one window. The window is right if at least one of them is right.
struct LabelledBag {
  bool is_right = false;
  std::vector<PerformanceMeasures> performances;  ///< at least one; the first training round uses the first one
};

struct BoostingOptions {
  int trees = 100;
  double rate = 0.12;  ///< shrinkage: each tree's values are multiplied by this
  /// L2 penalty that shrinks leaf values towards 0. It is added to the curvature of the loss, to which one performance
  /// at even odds contributes ¼.
  double ridge = 3;
  int min_per_leaf = 12;  ///< minimum number of performances in a leaf
  /// If true, trees take turns: each is fitted to three fifths of the performances and a third of the measures, so that
  /// the trees differ. (This is stochastic boosting, Friedman 2002, with a fixed order instead of random numbers.)
  bool takes_turns = false;
  /// The number of multiple-instance rounds. Each round trains on one performance per bag. The first round takes the
  /// bag's first performance; later rounds take the performance that the previous round's model finds most likely,
  /// because this performance determines the bag's label.
  int rounds = 3;
};

/// Fits trees by Newton boosting of the logistic loss, with measures cut at 63 quantiles. The right and the wrong bags
/// have the same total weight. No random numbers are used. If all bags are right or all are wrong, returns a model
/// without trees, whose probability is always ½.
BoostedTrees FitBoostedTrees(std::span<const LabelledBag> bags, const BoostingOptions& options = {});

/// A model trained on right and faulty performances of any moves. It is stored in a file, so that users need not train
/// one.
struct LearntModel {
  BoostedTrees asked, spotted;
};

/// Reads the text of a model file (`etude train --recogniser`); error messages name it `file`.
Result<LearntModel> ReadLearntModel(std::string_view text, const std::string& file);
/// Returns the text from which ReadLearntModel reads the same model, bit for bit.
std::string WriteLearntModel(const LearntModel& model);

/// Returns the files scenarios/recognisers/*.yaml (embedded by the build).
std::span<const EmbeddedText> BuiltinLearntModelFiles();
/// Returns the model of recogniser `learnt`: scenarios/recognisers/learnt.yaml.
const LearntModel& BuiltinLearntModel();
/// Returns the model of recogniser `coached`. It uses scenarios/recognisers/coached.yaml for performances that were
/// asked for, and learnt.yaml for performances that were spotted without being asked for.
const LearntModel& BuiltinCoachedModel();

/// Makes our learnt recogniser. It aligns performances with the taught examples, measures them, and judges the measures
/// by a model trained on simulated people. A motion is not spotted as a move if it is farther from every example than
/// 19 of 20 right performances in the training data. The model does not depend on which moves are taught.
std::unique_ptr<Recogniser> MakeLearntRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                 const LearntModel& model);

}  // namespace etude

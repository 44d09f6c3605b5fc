#include "engine/recognition/learnt_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "engine/base/named.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

double Sigmoid(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

constexpr std::size_t kBins = 64;
constexpr std::size_t kRows = 3;  // depth of a tree: comparisons from the root to a leaf

/// The performances of one multiple-instance round (BoostingOptions::rounds), with their measures as histogram bins.
struct Sample {
  std::vector<std::array<std::uint8_t, kMeasureCount>> bins;
  std::vector<std::array<double, kBins - 1>> cuts;  // for each measure: values in (cuts[b − 1], cuts[b]] are in bin b
  std::vector<double> labels, weights, log_odds;
};

std::array<double, kBins - 1> Quantiles(std::vector<double> values) {
  std::ranges::sort(values);
  std::array<double, kBins - 1> cuts{};
  for (std::size_t b = 0; b < cuts.size(); ++b) cuts[b] = values[(b + 1) * (values.size() - 1) / kBins];
  return cuts;
}

Sample MakeSample(std::span<const PerformanceMeasures> performances, std::span<const LabelledBag> bags) {
  Sample sample;
  const auto right = static_cast<double>(std::ranges::count_if(bags, &LabelledBag::is_right));
  const double wrong = static_cast<double>(bags.size()) - right;
  // Cut each measure at its quantiles and replace the values by their bins.
  sample.bins.resize(performances.size());
  for (std::size_t m = 0; m < kMeasureCount; ++m) {
    std::vector<double> values;
    for (const PerformanceMeasures& performance : performances) values.push_back(performance[m]);
    sample.cuts.push_back(Quantiles(values));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto cut = std::ranges::lower_bound(sample.cuts[m], values[i]);
      sample.bins[i][m] = static_cast<std::uint8_t>(cut - sample.cuts[m].begin());
    }
  }
  // Weight the bags so that all right bags together have the same weight as all wrong bags together.
  for (const LabelledBag& bag : bags) {
    sample.labels.push_back(bag.is_right ? 1.0 : 0.0);
    sample.weights.push_back(0.5 * static_cast<double>(bags.size()) / (bag.is_right ? right : wrong));
    sample.log_odds.push_back(0.0);
  }
  return sample;
}

/// The sums of the loss's first and second derivatives over some performances, and the number of performances.
struct Slope {
  double gradient = 0, curvature = 0;
  int count = 0;

  void Add(const Slope& other) {
    gradient += other.gradient;
    curvature += other.curvature;
    count += other.count;
  }
  double Gain(double ridge) const { return gradient * gradient / (curvature + ridge); }
};

struct Split {
  std::size_t measure = 0, bin = kBins - 1;  // by default, every performance goes to the left child
  double gain = 0;
};

/// Selects the performances and the measures to which tree number `tree` is fitted: subsets that change from tree to
/// tree, or everything if `is_taken` is false.
struct Turn {
  std::size_t tree;
  bool is_taken;

  bool SeesPerformance(std::size_t i) const { return !is_taken || (i + 2 * tree) % 5 < 3; }
  bool SeesMeasure(std::size_t m) const { return !is_taken || (m + tree) % 3 == 0; }
};

Split BestSplit(const Sample& sample, std::span<const Slope> slopes, std::span<const std::size_t> members,
                const BoostingOptions& options, const Turn& turn) {
  // For each measure, build a histogram of the slopes and try every bin boundary as the split.
  Split best;
  for (std::size_t m = 0; m < kMeasureCount; ++m) {
    if (!turn.SeesMeasure(m)) continue;
    std::array<Slope, kBins> bins{};
    Slope all;
    for (std::size_t i : members) {
      bins[sample.bins[i][m]].Add(slopes[i]);
      all.Add(slopes[i]);
    }
    Slope left;
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
      left.Add(bins[b]);
      const Slope right{all.gradient - left.gradient, all.curvature - left.curvature, all.count - left.count};
      if (left.count < options.min_per_leaf || right.count < options.min_per_leaf) continue;
      const double gain = left.Gain(options.ridge) + right.Gain(options.ridge) - all.Gain(options.ridge);
      if (gain > best.gain) best = {m, b, gain};
    }
  }
  return best;
}

/// Fits one tree to the gradients of the loss, and adds its values to the sample's log-odds.
DecisionTree GrowTree(Sample& sample, std::span<const Slope> slopes, const BoostingOptions& options, const Turn& turn) {
  DecisionTree tree;
  std::array<Split, DecisionTree::kNodes> splits;
  std::vector<std::vector<std::size_t>> row(1);
  // The root node gets all performances to which this tree is fitted.
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (turn.SeesPerformance(i)) row[0].push_back(i);
  }
  // Grow the tree row by row: find the best split of each node and divide its performances.
  for (std::size_t depth = 0, node = 0; depth < kRows; ++depth) {
    std::vector<std::vector<std::size_t>> next;
    for (const auto& members : row) {
      const Split split = splits[node] = BestSplit(sample, slopes, members, options, turn);
      tree.measures[node] = static_cast<int>(split.measure);
      constexpr double kAll = 1e9;  // a limit above every value: without a useful split, all performances go left
      tree.limits[node] = split.gain > 0 ? sample.cuts[split.measure][split.bin] : kAll;
      ++node;
      next.resize(next.size() + 2);
      for (std::size_t i : members) {
        const bool is_left = sample.bins[i][split.measure] <= split.bin;
        next[next.size() - (is_left ? 2 : 1)].push_back(i);
      }
    }
    row = std::move(next);
  }
  // A leaf's value is a Newton step on its performances, shrunk by the rate.
  for (std::size_t leaf = 0; leaf < row.size(); ++leaf) {
    Slope all;
    for (std::size_t i : row[leaf]) all.Add(slopes[i]);
    tree.leaves[leaf] = -options.rate * all.gradient / (all.curvature + options.ridge);
  }
  // Add the tree's values to the log-odds of all performances, also of the performances that the tree was not fitted
  // to.
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    std::size_t node = 0;
    while (node < DecisionTree::kNodes)
      node = 2 * node + (sample.bins[i][splits[node].measure] <= splits[node].bin ? 1 : 2);
    sample.log_odds[i] += tree.leaves[node - DecisionTree::kNodes];
  }
  return tree;
}

BoostedTrees FitRound(std::span<const PerformanceMeasures> performances, std::span<const LabelledBag> bags,
                      const BoostingOptions& options) {
  Sample sample = MakeSample(performances, bags);
  BoostedTrees model;
  for (int t = 0; t < options.trees; ++t) {
    std::vector<Slope> slopes;
    for (std::size_t i = 0; i < performances.size(); ++i) {
      const double probability = Sigmoid(sample.log_odds[i]);
      slopes.push_back({sample.weights[i] * (probability - sample.labels[i]),
                        sample.weights[i] * probability * (1 - probability), 1});
    }
    const Turn turn{.tree = static_cast<std::size_t>(t), .is_taken = options.takes_turns};
    model.trees.push_back(GrowTree(sample, slopes, options, turn));
  }
  return model;
}

constexpr std::size_t kNumbersPerTree = 2 * DecisionTree::kNodes + DecisionTree::kLeaves;
constexpr double kMaxNumber = 1e12;

/// The largest distance to the example at which a move is spotted, as RMS over the limbs (1 is 60 degrees). The trees
/// cannot judge motions that are unlike all their training data; 19 of 20 right performances in that data were nearer
/// than this limit.
constexpr double kMaxSpottedDistance = 0.52;

/// Writes a tree as one line: measure and limit of each node, then the leaves.
std::string WriteTree(const DecisionTree& tree) {
  std::string line = "    - [";
  for (std::size_t n = 0; n < DecisionTree::kNodes; ++n) {
    line += fmt::format("{}, {}, ", tree.measures[n], tree.limits[n]);
  }
  for (std::size_t l = 0; l < DecisionTree::kLeaves; ++l)
    line += fmt::format("{}{}", l == 0 ? "" : ", ", tree.leaves[l]);
  return line + "]\n";
}

std::string WriteTrees(const std::string& key, const BoostedTrees& model) {
  std::string text = fmt::format("{}:\n  bias: {}\n  trees:{}\n", key, model.bias, model.trees.empty() ? " []" : "");
  for (const DecisionTree& tree : model.trees) text += WriteTree(tree);
  return text;
}

Result<DecisionTree> ReadTree(const Node& node) {
  if (node.kind != Node::Kind::kSequence || node.items.size() != kNumbersPerTree) {
    return Fail(node.place, "a tree must be a list of {} numbers, found {} with {} items", kNumbersPerTree,
                Describe(node), node.items.size());
  }
  // A tree is stored as a flat list of numbers.
  std::array<double, kNumbersPerTree> numbers{};
  for (std::size_t i = 0; i < kNumbersPerTree; ++i) {
    ASSIGN_OR_RETURN(numbers[i], AsNumber(node.items[i]));
    if (!(std::abs(numbers[i]) <= kMaxNumber))
      return Fail(node.items[i].place, "a tree contains {}; allowed: numbers within ±{:g}", numbers[i], kMaxNumber);
  }
  // The list contains a measure and a limit per node, then the values of the leaves.
  DecisionTree tree;
  for (std::size_t n = 0; n < DecisionTree::kNodes; ++n) {
    const double measure = numbers[2 * n];
    if (!(measure >= 0 && measure < kMeasureCount)) {
      return Fail(node.items[2 * n].place, "measure {}; allowed: 0 to {}", measure, kMeasureCount - 1);
    }
    tree.measures[n] = static_cast<int>(measure);
    tree.limits[n] = numbers[2 * n + 1];
  }
  for (std::size_t l = 0; l < DecisionTree::kLeaves; ++l) tree.leaves[l] = numbers[2 * DecisionTree::kNodes + l];
  return tree;
}

Result<BoostedTrees> ReadTrees(Fields& file, const std::string& key) {
  const Node* node = file.Raw(key);
  if (node == nullptr) return Fail(file.node().place, "a model needs '{}'", key);
  Fields fields(*node, "'" + key + "'");
  BoostedTrees model;
  model.bias = fields.Number("bias", 0, {-kMaxNumber, kMaxNumber});
  if (const Node* trees = fields.Raw("trees")) {
    if (trees->kind != Node::Kind::kSequence)
      return Fail(trees->place, "'trees' must be a list, found {}", Describe(*trees));
    for (const Node& item : trees->items) {
      ASSIGN_OR_RETURN(const DecisionTree tree, ReadTree(item));
      model.trees.push_back(tree);
    }
  }
  RETURN_IF_ERROR(fields.Finish());
  return model;
}

LearntModel ReadBuiltin(std::string_view name) {
  const EmbeddedText* file = FindByName(BuiltinLearntModelFiles(), name, StemOf);
  assert(file != nullptr);
  auto read = ReadLearntModel(file->text, std::string(file->name));
  assert(read);  // a test proves that the built-in files can be read
  return *std::move(read);
}

}  // namespace

double DecisionTree::Value(const PerformanceMeasures& of) const {
  std::size_t node = 0;
  while (node < kNodes) {
    node = 2 * node + (of[static_cast<std::size_t>(measures[node])] <= limits[node] ? 1 : 2);
  }
  return leaves[node - kNodes];
}

double BoostedTrees::Probability(const PerformanceMeasures& of) const {
  double log_odds = bias;
  for (const DecisionTree& tree : trees) log_odds += tree.Value(of);
  return Sigmoid(log_odds);
}

BoostedTrees FitBoostedTrees(std::span<const LabelledBag> bags, const BoostingOptions& options) {
  const auto right = std::ranges::count_if(bags, &LabelledBag::is_right);
  if (right == 0 || right == static_cast<std::ptrdiff_t>(bags.size())) return {};
  std::vector<PerformanceMeasures> chosen;
  for (const LabelledBag& bag : bags) chosen.push_back(bag.performances.front());
  BoostedTrees model;
  for (int round = 0; round < options.rounds; ++round) {
    model = FitRound(chosen, bags, options);
    for (std::size_t i = 0; i < bags.size(); ++i) {
      chosen[i] = *std::ranges::max_element(bags[i].performances, {},
                                            [&](const PerformanceMeasures& each) { return model.Probability(each); });
    }
  }
  return model;
}

Result<LearntModel> ReadLearntModel(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node node, ParseYaml(text, file));
  Fields fields(node, "a recogniser's model");
  constexpr int kUnsaid = 1;  // the version of a file that states no version
  const auto version = static_cast<int>(fields.OptionalWhole("measures", {1, 1e6}).value_or(kUnsaid));
  if (version != kMeasuresVersion) {
    return Fail(
        fields.Raw("measures")->place,
        "the model was trained with version {} of the measures, but this program has version {}; train the model again",
        version, kMeasuresVersion);
  }
  LearntModel model;
  ASSIGN_OR_RETURN(model.asked, ReadTrees(fields, "asked"));
  ASSIGN_OR_RETURN(model.spotted, ReadTrees(fields, "spotted"));
  RETURN_IF_ERROR(fields.Finish());
  return model;
}

std::string WriteLearntModel(const LearntModel& model) {
  return fmt::format("measures: {}\n", kMeasuresVersion) + WriteTrees("asked", model.asked) +
         WriteTrees("spotted", model.spotted);
}

const LearntModel& BuiltinLearntModel() {
  static const LearntModel model = ReadBuiltin("learnt");
  return model;
}

const LearntModel& BuiltinCoachedModel() {
  static const LearntModel model = [] {
    LearntModel coached = ReadBuiltin("coached");
    coached.spotted = BuiltinLearntModel().spotted;
    return coached;
  }();
  return model;
}

std::unique_ptr<Recogniser> MakeLearntRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                 const LearntModel& model) {
  return MakeMeasuringRecogniser(
      taught, weights, [&model](PerformanceOrigin origin, std::size_t, const PerformanceMeasures& measures) {
        if (origin == PerformanceOrigin::kAsked) return model.asked.Probability(measures);
        return measures[kDistanceMeasure] > kMaxSpottedDistance ? 0.0 : model.spotted.Probability(measures);
      });
}

}  // namespace etude

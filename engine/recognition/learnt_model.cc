#include "engine/recognition/learnt_model.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "engine/base/named.h"
#include "engine/document/fields.h"
#include "engine/recognition/measuring_recogniser.h"

namespace etude {
namespace {

constexpr std::size_t kNumbersPerTree = 2 * DecisionTree::kNodes + DecisionTree::kLeaves;
constexpr double kLargest = 1e12;

/// Trees know nothing of what is unlike all that they were taught. Of the right performances that taught them nineteen
/// in twenty were nearer to the example than this (1 is 60 degrees, RMS of the limbs); beyond it no move is spotted.
constexpr double kUnlike = 0.52;

/// A tree's line: measure and limit of each node, then the leaves.
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
    return Fail(node.place, "a tree is a list of {} numbers, found {} of {}", kNumbersPerTree, Describe(node),
                node.items.size());
  }
  std::array<double, kNumbersPerTree> numbers{};
  for (std::size_t i = 0; i < kNumbersPerTree; ++i) {
    ASSIGN_OR_RETURN(numbers[i], AsNumber(node.items[i]));
    if (!(std::abs(numbers[i]) <= kLargest)) return Fail(node.items[i].place, "a number of a tree is {}", numbers[i]);
  }
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
  model.bias = fields.Number("bias", 0, {-kLargest, kLargest});
  if (const Node* trees = fields.Raw("trees")) {
    if (trees->kind != Node::Kind::kSequence)
      return Fail(trees->place, "'trees' is a list, found {}", Describe(*trees));
    for (const Node& item : trees->items) {
      ASSIGN_OR_RETURN(const DecisionTree tree, ReadTree(item));
      model.trees.push_back(tree);
    }
  }
  RETURN_IF_ERROR(fields.Finish());
  return model;
}

}  // namespace

Result<LearntModel> ReadLearntModel(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node node, ParseYaml(text, file));
  Fields fields(node, "a recogniser's model");
  LearntModel model;
  ASSIGN_OR_RETURN(model.asked, ReadTrees(fields, "asked"));
  ASSIGN_OR_RETURN(model.spotted, ReadTrees(fields, "spotted"));
  RETURN_IF_ERROR(fields.Finish());
  return model;
}

std::string WriteLearntModel(const LearntModel& model) {
  return WriteTrees("asked", model.asked) + WriteTrees("spotted", model.spotted);
}

namespace {

LearntModel ReadBuiltin(std::string_view name) {
  const EmbeddedText* file = FindByName(BuiltinLearntModelFiles(), name, StemOf);
  assert(file != nullptr);
  auto read = ReadLearntModel(file->text, std::string(file->name));
  assert(read);  // a test reads it
  return *std::move(read);
}

}  // namespace

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

std::unique_ptr<Recogniser> MakeLearntRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                 const LearntModel& model) {
  return MakeMeasuringRecogniser(
      taught, weights, [&model](Occasion occasion, std::size_t, const PerformanceMeasures& measures) {
        if (occasion == Occasion::kAsked) return model.asked.Probability(measures);
        return measures[kDistanceMeasure] > kUnlike ? 0.0 : model.spotted.Probability(measures);
      });
}

}  // namespace etude

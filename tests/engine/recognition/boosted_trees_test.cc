
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/recognition/learnt_model.h"
#include "engine/recognition/recognise.h"
#include "tests/engine/recognition/waving_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns bags of one performance each with random measures; a third are right, depending on two measures and chance.
std::vector<LabelledBag> SomeBags(int count) {
  std::vector<LabelledBag> bags;
  for (int i = 0; i < count; ++i) {
    PerformanceMeasures measures{};
    for (std::size_t m = 0; m < kMeasureCount; ++m) {
      measures[m] = std::sin(1.3 * i * static_cast<double>(m + 2) + 0.7 * static_cast<double>(m * m));
    }
    bags.push_back({measures[4] + 0.6 * measures[11] + 0.4 * measures[2] > 0.5, {measures}});
  }
  return bags;
}

/// A second implementation of Newton boosting. It computes the gain of every candidate split of every measure by
/// summing over all members, and checks that a tree's splits have the largest gain. If several splits have this gain,
/// any of them is accepted.
class PlainBoosting {
 public:
  PlainBoosting(const std::vector<LabelledBag>& bags, const BoostingOptions& options)
      : bags_(bags), options_(options), log_odds_(bags.size()) {
    right_ = static_cast<double>(std::ranges::count_if(bags, &LabelledBag::is_right));
  }

  void ExpectNext(const DecisionTree& tree) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < bags_.size(); ++i) all.push_back(i);
    Expect(tree, 0, all, std::vector(log_odds_));
  }

 private:
  using Members = std::vector<std::size_t>;

  double Measure(std::size_t i, std::size_t m) const { return bags_[i].performances[0][m]; }

  /// Returns two sums over the members: the negative gradient of the loss, and its curvature plus the ridge. All right
  /// bags together weigh as much as all wrong bags.
  std::pair<double, double> Pull(const Members& members, const std::vector<double>& log_odds) const {
    double pull = 0, stiffness = options_.ridge;
    const auto count = static_cast<double>(bags_.size());
    for (const std::size_t i : members) {
      const double p = 1 / (1 + std::exp(-log_odds[i]));
      const double weight = bags_[i].is_right ? 0.5 * count / right_ : 0.5 * count / (count - right_);
      pull += weight * ((bags_[i].is_right ? 1 : 0) - p);
      stiffness += weight * p * (1 - p);
    }
    return {pull, stiffness};
  }

  std::pair<Members, Members> Halves(const Members& members, std::size_t m, double limit) const {
    std::pair<Members, Members> halves;
    for (const std::size_t i : members) (Measure(i, m) <= limit ? halves.first : halves.second).push_back(i);
    return halves;
  }

  /// Returns the gain of a split; 0 if a side has too few members.
  double Gain(const Members& members, std::size_t m, double limit, const std::vector<double>& log_odds) const {
    const auto [yes, no] = Halves(members, m, limit);
    if (static_cast<int>(std::min(yes.size(), no.size())) < options_.min_per_leaf) return 0;
    double gain = 0;
    for (const auto& [part, sign] : {std::pair(&yes, 1.0), {&no, 1.0}, {&members, -1.0}}) {
      const auto [pull, stiffness] = Pull(*part, log_odds);
      gain += sign * pull * pull / stiffness;
    }
    return gain;
  }

  double MostGained(const Members& members, const std::vector<double>& log_odds) const {
    double most = 0;
    for (std::size_t m = 0; m < kMeasureCount; ++m) {
      std::vector<double> sorted;
      for (std::size_t i = 0; i < bags_.size(); ++i) sorted.push_back(Measure(i, m));
      std::ranges::sort(sorted);
      for (std::size_t quantile = 1; quantile < 64; ++quantile) {
        most = std::max(most, Gain(members, m, sorted[quantile * (sorted.size() - 1) / 64], log_odds));
      }
    }
    return most;
  }

  void Expect(const DecisionTree& tree, std::size_t node, const Members& members, const std::vector<double>& before) {
    if (node >= DecisionTree::kNodes) {
      const auto [pull, stiffness] = Pull(members, before);
      const double value = options_.rate * pull / stiffness;
      EXPECT_NEAR(tree.leaves[node - DecisionTree::kNodes], value, 1e-9) << "leaf " << node - DecisionTree::kNodes;
      for (const std::size_t i : members) log_odds_[i] += value;
      return;
    }
    const auto measure = static_cast<std::size_t>(tree.measures[node]);
    EXPECT_NEAR(Gain(members, measure, tree.limits[node], before), MostGained(members, before), 1e-9) << node;
    const auto [yes, no] = Halves(members, measure, tree.limits[node]);
    Expect(tree, 2 * node + 1, yes, before);
    Expect(tree, 2 * node + 2, no, before);
  }

  const std::vector<LabelledBag>& bags_;
  const BoostingOptions& options_;
  double right_ = 0;
  std::vector<double> log_odds_;
};

TEST(FitBoostedTrees, GrowsTreesThatGainTheMostAndLeavesOfNewtonsStep) {
  const std::vector<LabelledBag> bags = SomeBags(100);
  const BoostingOptions options{.trees = 2, .rounds = 1};
  const BoostedTrees model = FitBoostedTrees(bags, options);
  PlainBoosting plain(bags, options);
  for (const DecisionTree& tree : model.trees) plain.ExpectNext(tree);
  EXPECT_LT(*std::ranges::min_element(model.trees[0].limits), 1) << "the control: there was something to ask";
}

TEST(BoostedTrees, AddUpToLogOdds) {
  BoostedTrees model{.bias = 0.4, .trees = std::vector<DecisionTree>(2)};
  for (DecisionTree& tree : model.trees) tree.leaves.fill(0.3);
  EXPECT_NEAR(model.Probability({}), 1 / (1 + std::exp(-1.0)), 1e-12);
}

TEST(LearntRecogniser, JudgesWhatIsAskedForAndWhatIsSpottedEachByItsModel) {
  const SkeletonStream shown = Then({Rest(1), Swing(1.5, 1.5, 2), Rest(1)});
  const std::vector<TaughtMove> taught = {{.name = "swing", .examples = {Then({Swing(1.5, 1.5, 2)})}}};
  for (const double bias : {2.0, -2.0}) {
    const LearntModel model{.asked = {.bias = bias, .trees = {}}, .spotted = {.bias = -bias, .trees = {}}};
    const auto recogniser = MakeLearntRecogniser(taught, {}, model);
    const std::vector<AskedMove> asked = {{0, {0, static_cast<int>(shown.frames.size())}}};
    ASSERT_OK(trace, FollowStream(*recogniser, 1, SeeStream(shown, {}), asked));
    double most_spotted = 0;
    for (std::size_t frame = 0; frame < shown.frames.size(); ++frame) {
      most_spotted = std::max(most_spotted, trace->SpottedAt(frame)[0]);
    }
    EXPECT_NEAR(*std::ranges::max_element(trace->asked), 1 / (1 + std::exp(-bias)), 1e-9);
    EXPECT_NEAR(most_spotted, 1 / (1 + std::exp(bias)), 1e-9);
  }
}

}  // namespace
}  // namespace etude

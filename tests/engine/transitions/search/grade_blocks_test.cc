#include "engine/transitions/search/grade_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "tests/engine/transitions/search/search_data.h"

namespace etude {
namespace {

FrameBlock BlockOf(std::span<const Grades> frames) {
  FrameBlock block;
  for (int i = 0; i < kBlockLanes; ++i) block.Set(i, frames[static_cast<std::size_t>(i)]);
  return block;
}

/// Runs each test with every vector instruction set of this CPU.
class GradeBlocks : public ::testing::Test {
 protected:
  ~GradeBlocks() override { SetBatchTarget(""); }

  template <class Check>
  void OnEveryTarget(const Check& check) {
    const std::vector<std::string> targets = BatchTargets();
    EXPECT_FALSE(targets.empty());
    for (const std::string& target : targets) {
      SCOPED_TRACE(target);
      SetBatchTarget(target);
      check();
    }
  }
};

TEST_F(GradeBlocks, HaveTheDistancesOfComputeDistanceToTheLastBit) {
  RandomStream dice = SearchDice("blocks");
  const std::vector<Grades> frames = RandomFrames(kBlockLanes, -2, 3, dice);
  const std::vector<Grades> queries = RandomFrames(20, -2, 3, dice);
  const GradeMetric metric(PaperWeights());
  OnEveryTarget([&] {
    for (const Grades& query : queries) {
      const BlockResult result = SquaredDistances(metric, query, BlockOf(frames), kInfinity);
      ASSERT_EQ(result.kept, 0xffffu);
      for (int i = 0; i < kBlockLanes; ++i) {
        EXPECT_EQ(std::sqrt(result.squared[i]), ComputeDistance(query, frames[i], metric.weights).value);
      }
    }
  });
}

TEST_F(GradeBlocks, KeepTheLanesUpToTheLimitAndNoOthers) {
  RandomStream dice = SearchDice("limits");
  const std::vector<Grades> frames = RandomFrames(kBlockLanes, 0, 1, dice);
  const GradeMetric metric(PaperWeights());
  const BlockResult all = SquaredDistances(metric, Grades{}, BlockOf(frames), kInfinity);
  EXPECT_EQ(all.least, *std::ranges::min_element(all.squared));
  EXPECT_EQ(SquaredDistances(metric, Grades{}, BlockOf(frames), 1e-3).least, 1e-3) << "nothing is that near";
  OnEveryTarget([&] {
    for (double limit : all.squared) {
      const BlockResult result = SquaredDistances(metric, Grades{}, BlockOf(frames), limit);
      for (int i = 0; i < kBlockLanes; ++i) EXPECT_EQ((result.kept >> i) & 1, all.squared[i] <= limit);
      EXPECT_EQ(result.least, all.least);
    }
  });
}

TEST_F(GradeBlocks, BoundNoPairOfTwoBoxesTooHigh) {
  RandomStream dice = SearchDice("bounds");
  const GradeMetric metric(PaperWeights());
  BoxBlock boxes;
  std::vector<std::vector<Grades>> members;
  for (int i = 0; i < kBlockLanes; ++i) {
    members.push_back(WanderingFrames(5, dice));
    boxes.Set(i, BoxOf(members.back()));
  }
  OnEveryTarget([&] {
    for (int q = 0; q < 20; ++q) {
      const std::vector<Grades> asking = WanderingFrames(3, dice);
      const BlockResult bounds = SquaredBounds(metric, BoxOf(asking), boxes, kInfinity);
      for (int i = 0; i < kBlockLanes; ++i) {
        for (const Grades& a : asking) {
          for (const Grades& b : members[i]) {
            EXPECT_LE(std::sqrt(bounds.squared[i]), ComputeDistance(a, b, metric.weights).value);
          }
        }
      }
    }
  });
}

// Boxes are stored in single precision: in each of the 24 terms, a box is at most 2⁻²⁴ too wide. With ΣS the sum of
// the terms' weights, the bound is at most √ΣS · 2⁻²⁴ too low, and never too high.
TEST_F(GradeBlocks, BoundAFrameThatIsABoxByItsDistanceRoundedOutwards) {
  RandomStream dice = SearchDice("single");
  const GradeMetric metric(PaperWeights());
  const std::vector<Grades> frames = RandomFrames(kBlockLanes + 1, 0, 1, dice);
  BoxBlock boxes;
  for (int i = 0; i < kBlockLanes; ++i) boxes.Set(i, {frames[i], frames[i]});
  const Grades& asking = frames.back();
  double weights = 0;
  for (const Term& term : AllTerms()) weights += metric.weights[static_cast<std::size_t>(term.feature)];
  const double too_wide = std::sqrt(weights) * 0x1p-24;
  OnEveryTarget([&] {
    const BlockResult exact = SquaredBounds(metric, {asking, asking}, boxes, kInfinity);
    for (int i = 0; i < kBlockLanes; ++i) {
      const double bound = std::sqrt(exact.squared[i]);
      const double distance = ComputeDistance(asking, frames[i], metric.weights).value;
      EXPECT_LE(bound, distance);
      EXPECT_NEAR(bound, distance, too_wide);
    }
  });
}

TEST(SquaredLimit, IsReachedByEveryDistanceUpToIt) {
  RandomStream dice = SearchDice("roots");
  for (int i = 0; i < 20000; ++i) {
    const double squared = std::pow(10.0, dice.Uniform(-322, 300)) * dice.Uniform();
    const double distance = std::sqrt(squared);
    EXPECT_LE(squared, SquaredLimit(distance)) << squared;
    EXPECT_LT(SquaredLimit(distance), squared * 1.0001 + 1e-322) << "and by little else";
  }
}

}  // namespace
}  // namespace etude

#include "engine/recognition/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/engine/recognition/waving_body.h"

namespace etude {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Returns a pose with every part at `x`; the gap of two such poses is (a − b)².
PoseVector At(double x) {
  PoseVector pose;
  pose.parts.fill({x, 0, 0});
  pose.weights.fill(1);
  return pose;
}

std::vector<PoseVector> Steps(const std::vector<double>& values) {
  std::vector<PoseVector> steps;
  for (double value : values) steps.push_back(At(value));
  return steps;
}

/// A second implementation of the definition: tries every path backwards from (t, j).
double BestCost(const std::vector<double>& seen, const std::vector<double>& pattern, int t, int j, int end,
                int longest) {
  if (t < 0 || end - t >= longest) return kFar;
  const auto gap = [&](int at) {
    return std::pow(seen[static_cast<std::size_t>(t)] - pattern[static_cast<std::size_t>(at)], 2);
  };
  const auto before = [&](int at) { return BestCost(seen, pattern, t - 1, at, end, longest); };
  double best = j == 0 ? 0 : before(j);
  if (j >= 1) best = std::min(best, before(j - 1));
  if (j >= 2) best = std::min(best, before(j - 2) + gap(j - 1));
  return gap(j) + best;
}

TEST(SubsequenceAligner, EqualsTheSearchOverAllPaths) {
  const std::vector<double> pattern = {0, 1, 3, 2}, seen = {0.2, 5, 0, 0.4, 1.1, 2.6, 2.9, 1.8, 0.3, 1, 2.2};
  const auto taught = Steps(pattern);
  SubsequenceAligner aligner(taught, 20);
  for (int t = 0; t < static_cast<int>(seen.size()); ++t) {
    aligner.Update(At(seen[static_cast<std::size_t>(t)]));
    EXPECT_DOUBLE_EQ(aligner.Cost(), BestCost(seen, pattern, t, 3, t, 20) / 4) << "step " << t;
  }
}

TEST(SubsequenceAligner, TellsThePathItsCostIsOf) {
  const std::vector<double> pattern = {0, 1, 3, 2}, seen = {5, 0, 0.4, 2.6, 2.9, 1.8};
  const auto taught = Steps(pattern);
  SubsequenceAligner aligner(taught, 20);
  for (double value : seen) aligner.Update(At(value));
  const auto path = aligner.Path();
  ASSERT_FALSE(path.empty());
  EXPECT_EQ(path.back().seen, 5);
  EXPECT_EQ(path.back().taught, 3);
  EXPECT_EQ(path.front().taught, 0);
  double cost = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double at = seen[static_cast<std::size_t>(path[i].seen)];
    cost += std::pow(at - pattern[static_cast<std::size_t>(path[i].taught)], 2);
    if (i == 0) continue;
    EXPECT_EQ(path[i].seen, path[i - 1].seen + 1);
    const int advance = path[i].taught - path[i - 1].taught;
    EXPECT_TRUE(advance >= 0 && advance <= 2);
    if (advance == 2) cost += std::pow(at - pattern[static_cast<std::size_t>(path[i].taught - 1)], 2);
  }
  EXPECT_DOUBLE_EQ(aligner.Cost(), cost / 4);
}

TEST(SubsequenceAligner, ReachesTheEndAfterHalfThePatternAtTheSoonestAndForgetsOnReset) {
  const auto taught = Steps({0, 1, 2, 3, 4});
  SubsequenceAligner aligner(taught, 20);
  std::vector<double> costs;
  for (double value : {0, 2, 4}) {
    aligner.Update(At(value));
    costs.push_back(aligner.Cost());
  }
  EXPECT_EQ(costs[1], kFar);
  EXPECT_LT(costs[2], kFar);
  aligner.Reset();
  aligner.Update(At(4));
  EXPECT_EQ(aligner.Cost(), kFar);
  EXPECT_TRUE(aligner.Path().empty());
}

TEST(SubsequenceAligner, TakesNoPathThatIsTooLong) {
  const std::vector<double> pattern = {0, 1, 2}, seen = {0, 1, 1, 1, 1, 1, 2};
  const auto taught = Steps(pattern);
  SubsequenceAligner patient(taught, 7), hasty(taught, 6);
  for (double value : seen) {
    patient.Update(At(value));
    hasty.Update(At(value));
  }
  EXPECT_EQ(patient.Cost(), 0);
  EXPECT_GE(hasty.Cost(), BestCost(seen, pattern, 6, 2, 6, 6) / 3);
  EXPECT_GT(hasty.Cost(), 0);
}

double Apart(const PoseVector& a, const PoseVector& b) {
  double worst = 0;
  for (std::size_t i = 0; i < kPosePartCount; ++i) worst = std::max(worst, glm::distance(a.parts[i], b.parts[i]));
  return worst;
}

TEST(DescribeStream, SeesTheSameWhereverABodyStandsHoweverItIsTurnedAndHoweverTallItIs) {
  const BodyMotion here = Swing(1.5, 0.7, 2), there = Swing(1.5, 0.7, 2, 0.6, {.yaw = 2.5, .x = 3, .z = -1});
  for (PoseParts parts : {PoseParts::kJoints, PoseParts::kLimbs}) {
    const auto a = DescribeStream(StreamOf(here), parts), b = DescribeStream(StreamOf(there), parts);
    ASSERT_EQ(a.size(), 30u) << "fifteen a second";
    ASSERT_EQ(b.size(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(Apart(a[i], b[i]), 1e-9);
    EXPECT_GT(Apart(a[0], a[15]), 0.5) << "control: the arms move";
  }
}

TEST(DescribeStream, MirrorsAsTheBodyDoes) {
  for (PoseParts parts : {PoseParts::kJoints, PoseParts::kLimbs}) {
    const auto a = DescribeStream(StreamOf(Swing(1.5, 0.7, 1)), parts);
    const auto b = DescribeStream(StreamOf(Swing(0.7, 1.5, 1)), parts);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(Apart(Mirrored(a[i], parts), b[i]), 1e-9);
    EXPECT_GT(Apart(a[7], b[7]), 0.1) << "control";
  }
}

TEST(StepDescriber, KeepsItsStepsWhateverTheRate) {
  for (double rate_hz : {10.0, 15.0, 25.0, 30.0, 60.0}) {
    SkeletonStream stream = StreamOf(Rest(4));
    stream.rate_hz = rate_hz;
    EXPECT_NEAR(static_cast<double>(DescribeStream(stream, PoseParts::kLimbs).size()), 120 / rate_hz * 15, 1)
        << rate_hz;
  }
}

TEST(StepDescriber, LeavesOutStepsWithoutABody) {
  SkeletonStream stream = StreamOf(Rest(1));
  for (std::size_t i = 10; i < 20; ++i) stream.frames[i].body_seen = false;
  EXPECT_EQ(DescribeStream(stream, PoseParts::kLimbs).size(), 10u);
}

TEST(SquaredDistance, WeighsPartsByHowTheyWereSeen) {
  PoseVector seen = At(0);
  PoseVector taught = At(0);
  taught.parts[3] = {0, 2, 0};
  EXPECT_DOUBLE_EQ(SquaredDistance(seen, taught), 4.0 / kPosePartCount);
  seen.weights[3] = 0;
  EXPECT_EQ(SquaredDistance(seen, taught), 0);
  seen.weights.fill(0);
  EXPECT_EQ(SquaredDistance(seen, taught), 0);
}

}  // namespace
}  // namespace etude

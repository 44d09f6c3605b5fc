#include "engine/recognition/recognisers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "engine/recognition/key_pose.h"
#include "engine/recognition/recognise.h"
#include "tests/engine/recognition/waving_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr double kRight = std::numbers::pi / 2, kHigh = 2.6;

/// Two moves that every recogniser can learn: both arms out to the sides, and the left arm up.
std::vector<TaughtMove> Taught() {
  return {{.name = "both",
           .poses = {{{{Feature::kRH, 90, 20}, {Feature::kLH, 90, 20}}}},
           .span_s = 3,
           .examples = {StreamOf(Swing(kRight, kRight, 2))}},
          {.name = "left",
           .poses = {{{{Feature::kLH, 149, 20}, {Feature::kRH, 0, 20}}}},
           .span_s = 3,
           .examples = {StreamOf(Swing(kHigh, 0, 2))}}};
}

bool IsTrained(const RecogniserKind& kind) {
  return kind.name == "learnt" || kind.name == "coached" || kind.name == "whole-body";
}

class AnyRecogniser : public ::testing::TestWithParam<const RecogniserKind*> {
 protected:
  /// Returns the evidence at the end of a window in which "left" was requested.
  double Asked(const BodyMotion& danced, const TrackingWeights& weights = {}) const {
    const SkeletonStream stream = Then({Rest(1), danced, Rest(1)});
    return Trace(stream, weights).asked[static_cast<std::size_t>(End(stream)) - 1];
  }
  EvidenceTrace Trace(const SkeletonStream& stream, const TrackingWeights& weights = {}) const {
    const auto recogniser = *MakeRecogniser({.kind = GetParam(), .weights = weights}, Taught());
    return *FollowStream(*recogniser, 2, SeeStream(stream, {}), {{AskedMove{1, {30, End(stream)}}}});
  }
  /// Returns true if the recogniser was trained on other dances. Then the scale of its evidence does not fit these
  /// moves: a wrong performance ranks below a right one, but may exceed the threshold.
  static bool IsLearnt() { return IsTrained(*GetParam()); }
  static int End(const SkeletonStream& stream) { return static_cast<int>(stream.frames.size()) - 15; }
};

class UntrainedRecogniser : public AnyRecogniser {};

TEST_P(AnyRecogniser, RanksTheMoveAskedForAboveWhatItIsNot) {
  const double right = Asked(Swing(kHigh, 0, 2));
  EXPECT_GE(right, GetParam()->threshold);
  EXPECT_LE(right, 1);
  for (const BodyMotion& wrong : {Swing(0, kHigh, 2), Swing(kRight, kRight, 2), Swing(0.2 * kHigh, 0, 2), Rest(2)}) {
    EXPECT_LT(Asked(wrong), right);
    EXPECT_TRUE(IsLearnt() || Asked(wrong) < GetParam()->threshold);
  }
}

TEST_P(AnyRecogniser, KnowsTheMoveOfASmallerPersonWhoStandsElsewhere) {
  const FloorMove elsewhere{.yaw = 0.8, .x = 1, .z = 2};
  const SkeletonStream stream =
      Then({Rest(1, 0.6, elsewhere), Swing(kHigh, 0, 2, 0.6, elsewhere), Rest(1, 0.6, elsewhere)});
  EXPECT_GE(Trace(stream).asked[static_cast<std::size_t>(End(stream)) - 1], GetParam()->threshold);
}

TEST_P(UntrainedRecogniser, SpotsEachMoveAtItsEndAndNothingInRest) {
  const SkeletonStream stream = Then({Rest(2), Swing(kRight, kRight, 2), Rest(2), Swing(kHigh, 0, 2), Rest(2)});
  const auto found = FindMoves(Trace(stream), 30, {.threshold = GetParam()->threshold, .refractory_s = 2});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].move, 0u);
  EXPECT_TRUE(found[0].frame > 80 && found[0].frame < 150) << found[0].frame;
  EXPECT_EQ(found[1].move, 1u);
  EXPECT_TRUE(found[1].frame > 200 && found[1].frame < 270) << found[1].frame;
}

TEST_P(UntrainedRecogniser, SpotsNoMoveAgainBecauseTheBodyIsLost) {
  const SkeletonStream stream = Then({Rest(2), Swing(kHigh, 0, 2), Rest(3)});
  const auto recogniser = *MakeRecogniser({.kind = GetParam()}, Taught());
  const auto spotted = [&](std::size_t lost_at, std::size_t lost) {
    SkeletonStream part = stream;
    for (std::size_t t = lost_at; t < lost_at + lost; ++t) part.frames[t] = {};
    LiveSight sight({}, 30);
    const auto follower = recogniser->Follow(30);
    MoveSpotter spotter(2, {.threshold = GetParam()->threshold, .refractory_s = 0.1}, 30);
    std::size_t count = 0;
    for (const SensedFrame& frame : part.frames) {
      count += spotter.Update(follower->Update(sight.Update(frame)).spotted, frame.body_seen).size();
    }
    return count;
  };
  const std::size_t whole = spotted(0, 0);
  for (const std::size_t at : {130, 135, 150}) {
    for (const std::size_t lost : {2, 3, 15}) EXPECT_LE(spotted(at, lost), whole) << at << ' ' << lost;
  }
}

TEST_P(AnyRecogniser, NeverTakesBackWhatItSaidOfThePerformanceAskedFor) {
  const SkeletonStream stream = Then({Rest(1), Swing(kHigh, 0, 2), Swing(0, kHigh, 2), Rest(1)});
  const EvidenceTrace trace = Trace(stream);
  for (int t = 31; t < End(stream); ++t) {
    EXPECT_GE(trace.asked[static_cast<std::size_t>(t)], trace.asked[static_cast<std::size_t>(t) - 1]);
  }
  EXPECT_EQ(trace.asked.front(), 0) << "nothing is asked for yet";
  EXPECT_EQ(trace.asked.back(), 0) << "nothing is asked for any more";
}

TEST_P(AnyRecogniser, IsCausal) {
  const SkeletonStream whole = Then({Rest(1), Swing(kHigh, 0, 2), Swing(0, kHigh, 2), Rest(1)});
  SkeletonStream changed = whole;
  for (std::size_t t = 100; t < changed.frames.size(); ++t) changed.frames[t] = changed.frames[0];
  const EvidenceTrace a = Trace(whole), b = Trace(changed);
  for (std::size_t i = 0; i < 100 * 2; ++i) EXPECT_EQ(a.spotted[i], b.spotted[i]);
  for (std::size_t t = 0; t < 100; ++t) EXPECT_EQ(a.asked[t], b.asked[t]);
}

TEST_P(AnyRecogniser, LivesThroughWhatSensorsLoseAndThroughAnyRate) {
  SkeletonStream stream = Then({Rest(1), Swing(kHigh, 0, 2), Rest(1)});
  for (double rate_hz : {10.0, 15.0, 30.0, 60.0}) {
    stream.rate_hz = rate_hz;
    for (std::size_t t = 0; t < stream.frames.size(); t += 7) stream.frames[t] = {};
    for (const Weighting weighting : {Weighting::kFixed, Weighting::kAdaptive}) {
      for (double evidence : Trace(stream, {.weighting = weighting}).spotted) {
        EXPECT_TRUE(evidence >= 0 && evidence <= 1) << evidence;
      }
    }
  }
}

std::vector<const RecogniserKind*> Kinds(bool with_learnt) {
  std::vector<const RecogniserKind*> kinds;
  for (const RecogniserKind& kind : AllRecognisers()) {
    const bool is_learnt = IsTrained(kind);
    if (with_learnt || !is_learnt) kinds.push_back(&kind);
  }
  return kinds;
}

std::string NameOf(const ::testing::TestParamInfo<const RecogniserKind*>& test) {
  std::string name = test.param->name;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, AnyRecogniser, ::testing::ValuesIn(Kinds(true)), NameOf);
INSTANTIATE_TEST_SUITE_P(All, UntrainedRecogniser, ::testing::ValuesIn(Kinds(false)), NameOf);

TEST(RuleStrength, IsOneWhereTaughtAndTheLeastOverlapElsewhere) {
  const TaughtPose pose{{{Feature::kRH, 90, 20}, {Feature::kLH, 20, 20}}};
  FeatureFrame frame{.body_seen = true};
  frame.features[Feature::kRH] = 90;
  frame.features[Feature::kLH] = 20;
  EXPECT_DOUBLE_EQ(RuleStrength(frame, pose, {}, PaperMemberships()), 1.0);
  // Grades at 55°: down (90 − 55) / 70 = ½, mid (55 − 20) / 70 = ½; at 90°: mid 1. The smaller grades sum to ½, the
  // larger ones to 1 + ½.
  frame.features[Feature::kRH] = 55;
  EXPECT_NEAR(RuleStrength(frame, pose, {}, PaperMemberships()), 0.5 / 1.5, 1e-12);
  frame.features[Feature::kLH] = 90;
  EXPECT_EQ(RuleStrength(frame, pose, {}, PaperMemberships()), 0.0) << "the least counts";
}

TEST(RecommendedRecogniser, FollowsTheNumberOfExamples) {
  const auto taught = [](std::size_t first, std::size_t second) {
    std::vector<TaughtMove> moves = Taught();
    const SkeletonStream example = moves[0].examples[0];
    moves[0].examples.assign(first, example);
    moves[1].examples.assign(second, example);
    return moves;
  };
  EXPECT_EQ(RecommendedRecogniser(taught(3, 3)).name, "whole-body");
  EXPECT_EQ(RecommendedRecogniser(taught(3, 2)).name, "learnt");
  EXPECT_EQ(RecommendedRecogniser(taught(3, 0)).name, "key-pose");
  EXPECT_EQ(RecommendedRecogniser(taught(3, 3), /*by_a_coach=*/true).name, "coached");
}

TEST(MakeRecogniser, AsksForExamplesWhereItNeedsThem) {
  std::vector<TaughtMove> taught = Taught();
  taught[1].examples.clear();
  const auto complaint = [&](const char* name) {
    return testing::Message(MakeRecogniser({.kind = FindRecogniser(name)}, taught));
  };
  EXPECT_EQ(complaint("dtw"), "recogniser dtw: move 'left' has no example that shows a body");
  taught[1].examples.push_back({.rate_hz = 30, .frames = std::vector<SensedFrame>(9)});
  EXPECT_EQ(complaint("nearest"), "recogniser nearest: move 'left' has no example that shows a body");
  EXPECT_EQ(complaint("key-pose"), "accepted");
}

}  // namespace
}  // namespace etude

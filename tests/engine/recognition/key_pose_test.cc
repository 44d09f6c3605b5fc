#include "engine/recognition/key_pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

FeatureFrame ArmAt(double degrees, TrackingState state = TrackingState::kTracked) {
  FeatureFrame frame{.body_seen = true};
  frame.features[Feature::kRH] = degrees;
  frame.states[static_cast<std::size_t>(Feature::kRH)] = state;
  return frame;
}

const TaughtPose kArmUp{{{Feature::kRH, 180, 20}}};

TEST(MatchOf, IsOneForPerfectAndOneHalfAtTheTolerance) {
  EXPECT_DOUBLE_EQ(MatchOf(ArmAt(180), kArmUp, {}, {}), 1.0);
  EXPECT_DOUBLE_EQ(MatchOf(ArmAt(160), kArmUp, {}, {}), 0.5);
  EXPECT_LT(MatchOf(ArmAt(159.9), kArmUp, {}, {}), 0.5);
  EXPECT_DOUBLE_EQ(MatchOf(ArmAt(140), kArmUp, {}, {}), 0.2);
}

TEST(MatchOf, ScalesTolerances) {
  EXPECT_DOUBLE_EQ(MatchOf(ArmAt(156), kArmUp, {}, {.tolerance_scale = 1.2}), 0.5);
  EXPECT_DOUBLE_EQ(MatchOf(ArmAt(170), kArmUp, {}, {.tolerance_scale = 0.5}), 0.5);
}

TEST(MatchOf, GoesByTheWorstOfTheAnglesWanted) {
  TaughtPose four = kArmUp;
  for (Feature feature : {Feature::kLH, Feature::kRHE, Feature::kLHE}) four.targets.push_back({feature, 0, 20});
  FeatureFrame frame = ArmAt(180);
  frame.features[Feature::kLHE] = 40;
  EXPECT_DOUBLE_EQ(MatchOf(frame, four, {}, {.pose_share = 0.8}), 0.2);
  EXPECT_DOUBLE_EQ(MatchOf(frame, four, {}, {.pose_share = 0.75}), 1.0) << "three of four will do";
}

/// Both arms should be up. The left one is at 0°, which is wrong, and has the tracking state `state`.
double MatchWithWrongLeftArm(TrackingState state, const TrackingWeights& weights) {
  const TaughtPose both{{{Feature::kRH, 180, 20}, {Feature::kLH, 180, 20}}};
  FeatureFrame frame = ArmAt(180);
  frame.states[static_cast<std::size_t>(Feature::kLH)] = state;
  return MatchOf(frame, both, weights, {.pose_share = 0.76});
}

TEST(Weights, CountFixedAnglesAlikeAndAdaptiveOnesByTheirTracking) {
  using enum TrackingState;
  const TrackingWeights adaptive{.weighting = Weighting::kAdaptive};
  for (TrackingState state : {kTracked, kInferred, kNotTracked}) EXPECT_LT(MatchWithWrongLeftArm(state, {}), 0.02);
  EXPECT_LT(MatchWithWrongLeftArm(kTracked, adaptive), 0.02);
  EXPECT_EQ(MatchWithWrongLeftArm(kInferred, adaptive), 1.0) << "1 of 1.3 is more than .76";
  EXPECT_EQ(MatchWithWrongLeftArm(kNotTracked, adaptive), 1.0);
}

TEST(Weights, NeverMakeAPoseOfNothingSeen) {
  const FeatureFrame unseen = ArmAt(180, TrackingState::kNotTracked);
  EXPECT_EQ(MatchOf(unseen, kArmUp, {.weighting = Weighting::kAdaptive}, {}), 0.0);
  EXPECT_EQ(MatchOf(unseen, kArmUp, {.weighting = Weighting::kFixed}, {}), 1.0);
}

/// The match of each frame with two poses.
using Matches = std::vector<std::array<double, 2>>;

struct Passage {
  std::vector<double> asked, spotted;
};

Passage Pass(const Matches& matches, int hold_frames, int span_frames) {
  PoseSequence sequence(2, hold_frames, span_frames);
  Passage passage;
  for (const auto& frame : matches) {
    sequence.Update(frame);
    passage.asked.push_back(sequence.Asked());
    passage.spotted.push_back(sequence.Spotted());
  }
  return passage;
}

/// Tries all pairs of intervals of `hold` frames, one with pose 0 and a later one with pose 1. A pair is as good as its
/// worst frame; returns the value of the best pair. The first interval ends at or after `from`, the second at or before
/// `to`, or exactly at `to` if `ends`.
double BestPair(const Matches& matches, int hold, int from, int to, bool ends) {
  const auto held = [&](int end, std::size_t pose) {
    double worst = 1;
    for (int i = end - hold + 1; i <= end; ++i) worst = std::min(worst, matches[static_cast<std::size_t>(i)][pose]);
    return worst;
  };
  double best = 0;
  for (int first = std::max(from, hold - 1); first < to; ++first) {
    for (int second = ends ? to : first + 1; second <= to; ++second) {
      best = std::max(best, std::min(held(first, 0), held(second, 1)));
    }
  }
  return best;
}

TEST(PoseSequence, EqualsTheBruteForceSearchOverAllPassages) {
  Matches matches;
  for (int i = 0; i < 40; ++i)
    matches.push_back({0.5 + 0.5 * std::sin(0.37 * i * i), 0.5 + 0.5 * std::cos(0.5 * i * i)});
  constexpr int kSpan = 9;
  for (int hold : {1, 2, 3}) {
    const Passage passage = Pass(matches, hold, kSpan);
    for (int t = 0; t < 40; ++t) {
      EXPECT_DOUBLE_EQ(passage.asked[static_cast<std::size_t>(t)], BestPair(matches, hold, 0, t, false)) << t;
      EXPECT_DOUBLE_EQ(passage.spotted[static_cast<std::size_t>(t)], BestPair(matches, hold, t - kSpan, t, true)) << t;
    }
  }
}

TEST(PoseSequence, ForgetsWhatWasSeenBeforeItsWindowOpened) {
  PoseSequence sequence(2, 2, 100);
  for (const auto& frame : Matches{{1, 0}, {1, 0}, {1, 0}}) sequence.Update(frame);
  sequence.Open();
  for (const auto& frame : Matches{{0, 1}, {0, 1}}) sequence.Update(frame);
  EXPECT_EQ(sequence.Asked(), 0);
  EXPECT_EQ(sequence.Spotted(), 1) << "which does not matter where nothing is asked for";
}

TEST(PoseSequence, NeitherHoldsNorBreaksAPoseWhereNoBodyIsSeen) {
  PoseSequence sequence(1, 3, 100);
  const double met = 1;
  for (bool seen : {true, false, true}) sequence.Update(seen ? std::span(&met, 1) : std::span<const double>());
  EXPECT_EQ(sequence.Asked(), 0);
  sequence.Update(std::span(&met, 1));
  EXPECT_EQ(sequence.Asked(), 1);
}

}  // namespace
}  // namespace etude

#include "engine/transitions/choices/matching.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/transitions/choices/choice.h"
#include "tests/engine/transitions/random_clips.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

MotionLibrary LibraryOf(const std::vector<BodyMotion>& clips) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < clips.size(); ++i) names.push_back("clip" + std::to_string(i));
  return MakeLibrary(names, clips, MakeBodyProportions(PosedBody().Pose(), PosedBody::kStandingHipHeight));
}

/// Clip 1 is clip 0 from frame 40 on, in another place.
MotionLibrary OneDanceTwice() {
  RandomStream dice({.suite_seed = 6, .scenario = "matching", .trial = 0}, "dance");
  const BodyMotion whole = RandomClip(dice, 200, 0.8);
  BodyMotion rest{.rate_hz = whole.rate_hz, .poses = {whole.poses.begin() + 40, whole.poses.end()}};
  for (BodyPose& pose : rest.poses) pose = FloorMove{.yaw = 1, .x = 7}.Apply(pose);
  return LibraryOf({whole, rest});
}

constexpr TransitionRequest kRequest{.from = 0, .request_frame = 70, .to = 1};

TEST(MatchingChoices, GoOnWithTheSameDanceWhereTheOtherClipHasIt) {
  for (const char* name : {"fuzzy-kovar", "point-cloud", "motion-matching", "fuzzy-window"}) {
    const TransitionRecord record = FindChoice(name)->plan(OneDanceTwice(), kRequest, {}, {});
    ASSERT_EQ(record.segments.size(), 2u);
    EXPECT_EQ(record.segments[1].first, record.segments[0].last - 40) << record.why;
    EXPECT_NEAR(record.distances[0].value, 0, 1e-4) << "set down on the floor by its own lowest frames";
    const auto taken = std::ranges::find(record.candidates, CandidateOutcome::kTaken, &Candidate::outcome);
    ASSERT_NE(taken, record.candidates.end());
    for (const Candidate& other : record.candidates) {
      EXPECT_LE(*taken->cost, other.cost.value_or(*taken->cost));
    }
    EXPECT_EQ(record.candidates.size(), kMaxCandidates) << "one for each frame that could be left, the best of them";
    EXPECT_FALSE(record.cost_unit.empty());
  }
}

TEST(MatchingChoices, LookAtEveryPairOfBudgetAndLeastPlay) {
  const AllowedFrames allowed = AllowedAnyFrames(OneDanceTwice(), kRequest, 2);
  EXPECT_EQ(allowed.leave.front(), 70);
  EXPECT_EQ(allowed.leave.back(), 100);
  EXPECT_EQ(allowed.enter.back(), 160 - 60 - 1);
  EXPECT_EQ(allowed.Pairs(), 31 * 100);
  EXPECT_EQ(PlanPointCloud(OneDanceTwice(), kRequest, {}, {.least_play_s = 2}).pairs_seen, 31 * 100);
  EXPECT_EQ(AllowedAnyFrames(OneDanceTwice(), kRequest, 60).enter.size(), 80u)
      << "the front half may always be entered";
}

TEST(FuzzyGate, LetsOnlyMatchingPairsThrough) {
  // Only frame 150 of the wanted clip has hanging arms, as clip 0 has.
  BodyMotion raised = StandingClip(300, 170);
  raised.poses[150] = StandingClip(1, 0).poses[0];
  const MotionLibrary library = LibraryOf({StandingClip(100, 0), raised});
  for (const char* name : {"fuzzy-kovar", "fuzzy-window"}) {
    const TransitionRecord record = FindChoice(name)->plan(library, {.from = 0, .request_frame = 10, .to = 1}, {}, {});
    ASSERT_EQ(record.segments.size(), 2u) << record.why;
    EXPECT_EQ(record.segments[1].first, 150);
    EXPECT_EQ(record.pairs_matched, 31);
    EXPECT_EQ(record.pairs_seen, 31 * 270);
  }
  const TransitionRecord ungated = PlanPointCloud(library, {.from = 0, .request_frame = 10, .to = 1}, {});
  EXPECT_EQ(ungated.pairs_matched, ungated.pairs_seen);
}

TEST(FuzzyGate, GoesThroughAnInBetweenWhenNothingPasses) {
  const MotionLibrary library = LibraryOf({StandingClip(100, 0), StandingClip(100, 170)});
  for (const char* name : {"fuzzy-kovar", "fuzzy-window"}) {
    const TransitionRecord record = FindChoice(name)->plan(library, {.from = 0, .request_frame = 10, .to = 1}, {}, {});
    EXPECT_EQ(record.segments.size(), 3u);
    EXPECT_NE(record.why.find("no match among 2170 pairs of frames: the smallest distance is d = "), std::string::npos)
        << record.why;
  }
}

TEST(FuzzyGate, ComparesInsideTheClassOnlyWhenAsked) {
  const MotionLibrary library = LibraryOf({StandingClip(100, 0), StandingClip(100, 170)});
  MatchRules rules;
  rules.threshold = 6;
  const TransitionRequest request{.from = 0, .request_frame = 10, .to = 1};
  EXPECT_EQ(PlanFuzzyKovar(library, request, rules).segments.size(), 2u);
  rules.within_class = true;
  const TransitionRecord record = PlanFuzzyKovar(library, request, rules);
  EXPECT_EQ(record.segments.size(), 3u);
  EXPECT_NE(record.why.find("none of the 2170 pairs of frames has the same tags in both frames"), std::string::npos)
      << record.why;
}

TEST(MotionMatching, TellsArmsThatRiseFromArmsThatSink) {
  // The same pose occurs twice: falling at frame 100, rising at frame 200.
  BodyMotion rising, both;
  for (int f = 0; f < 60; ++f) rising.poses.push_back(StandingClip(1, 2.0 * f).poses[0]);
  for (int f = 0; f < 300; ++f) {
    const double degrees = 2.0 * std::abs(f - 150);  // down until 150, then up
    both.poses.push_back(StandingClip(1, std::min(degrees, 178.0)).poses[0]);
  }
  const MotionLibrary library = LibraryOf({rising, both});
  const TransitionRequest request{.from = 0, .request_frame = 30, .to = 1, .budget_s = 0};
  EXPECT_EQ(PlanMotionMatching(library, request, {}).segments[1].first, 150 + 30);
}

}  // namespace
}  // namespace etude

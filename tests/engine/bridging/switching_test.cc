#include "engine/bridging/switching.h"

#include <gtest/gtest.h>

#include "engine/bridging/in_between.h"
#include "engine/bridging/transition.h"
#include "tests/engine/bridging/test_clips.h"

namespace etude {
namespace {

constexpr FrameWindow kAll{0, 100};

void ExpectLink(const LinkSearch& search, int from, int to) {
  ASSERT_TRUE(search.link);
  EXPECT_EQ(search.link->from, from);
  EXPECT_EQ(search.link->to, to);
}

TEST(FindLink, TakesTheFirstMatchInPlayingOrderThenTargetOrder) {
  const TaggedClip playing = ClipOfLevels({9, 0, 0, 0}, {0, 1, 2});
  const TaggedClip next = ClipOfLevels({9.5, 5, 0.3, 0, 9.5, 9.5}, {1, 2, 3});
  const LinkSearch search = FindLink(playing, kAll, next, {});
  ExpectLink(search, 1, 2);
  EXPECT_NEAR(search.link->distance.value, 0.3, 1e-12);
  EXPECT_NEAR(search.link->distance.partials[0], 0.09, 1e-12);
  EXPECT_EQ(search.pairs_seen, 3 + 2) << "frame 0 saw three targets, frame 1 the first two";
}

TEST(FindLink, LooksAtTheFrontHalfBeforeTheRearHalf) {
  const TaggedClip playing = ClipOfLevels({0, 0}, {0, 1});
  // Smallest: the rear half holds an exact match, the front half only a fair one.
  const TaggedClip next = ClipOfLevels({5, 0.3, 0.2, 5, 0, 5}, {1, 2, 4});
  SwitchRules smallest;
  smallest.pick = Pick::kSmallest;
  ExpectLink(FindLink(playing, kAll, next, smallest), 0, 2);
  const TaggedClip rear_only = ClipOfLevels({5, 5, 5, 0.3, 0, 5}, {0, 3, 4});
  ExpectLink(FindLink(playing, kAll, rear_only, {}), 0, 3);
  ExpectLink(FindLink(playing, kAll, rear_only, smallest), 0, 4);
}

TEST(FindLink, NeedsADistanceBelowTheThreshold) {
  const TaggedClip playing = ClipOfLevels({0, 0}, {0});
  const TaggedClip next = ClipOfLevels({0.5, 0.5}, {0});
  SwitchRules rules;
  rules.threshold = 0.5;
  EXPECT_FALSE(FindLink(playing, kAll, next, rules).link) << "equal is not below";
  rules.threshold = 0.51;
  EXPECT_TRUE(FindLink(playing, kAll, next, rules).link);
}

TEST(FindLink, NeverTargetsTheLastFrame) {
  EXPECT_FALSE(FindLink(ClipOfLevels({0}, {0}), kAll, ClipOfLevels({9, 9, 0}, {0, 1, 2}), {}).link);
}

TEST(FindLink, ComparesInsideTheClassOnlyWhenAsked) {
  const TaggedClip playing = ClipOfLevels({0, 0}, {0});
  TaggedClip next = ClipOfLevels({0, 0, 0}, {0, 1});
  next.tags[0][3] = 1;
  ExpectLink(FindLink(playing, kAll, next, {}), 0, 0);
  SwitchRules rules;
  rules.within_class = true;
  ExpectLink(FindLink(playing, kAll, next, rules), 0, 1);
}

TEST(WaitWindow, EndsWithTheClip) {
  const TaggedClip clip = ClipOfLevels(std::vector<double>(50, 0.0), {});
  EXPECT_EQ(WaitWindow(clip, 10, {}).last, 40) << "1 s at 30 Hz";
  EXPECT_EQ(WaitWindow(clip, 40, {}).last, 49);
  const TaggedClip playing = ClipOfLevels({0, 9, 0, 0}, {0, 1, 3});
  ExpectLink(FindLink(playing, {1, 3}, ClipOfLevels({0, 0}, {0}), {}), 3, 0);
}

/// Clip 0 plays; clip 1 is wanted and unlike it; clip 2 goes from the one to the other in 20 frames.
std::vector<TaggedClip> LibraryWithAWayThrough() {
  std::vector<double> levels(21);
  std::vector<int> frames(21);
  for (int f = 0; f <= 20; ++f) levels[f] = 0.05 + 0.1 * (frames[f] = f);
  return {ClipOfLevels({0, 0, 0, 0}, {1, 2}), ClipOfLevels({2, 2, 2, 2}, {1, 2}), ClipOfLevels(levels, frames)};
}

TEST(FindInBetween, GoesThroughAThirdClip) {
  const auto library = LibraryWithAWayThrough();
  const InBetweenSearch search = FindInBetween(library, 0, kAll, 1, {});
  ASSERT_TRUE(search.found);
  EXPECT_EQ(search.found->through, 2);
  EXPECT_EQ(search.found->enter.from, 1);
  EXPECT_EQ(search.found->enter.to, 0);
  EXPECT_EQ(search.found->leave.from, 16) << "the first level closer than 0.4 to 2";
  EXPECT_EQ(search.found->leave.to, 1);
  EXPECT_FALSE(FindInBetween(library, 0, kAll, 1, {}, {.min_frames = 10, .max_frames = 12}).found)
      << "the way takes longer than allowed";
}

TEST(PlanTransition, RecordsTheBranchItTook) {
  auto library = LibraryWithAWayThrough();
  const Transition through = PlanTransition(library, 0, 0, 1, Choice::kFuzzyBridge, {});
  EXPECT_EQ(through.branch, Branch::kInBetween);
  ASSERT_EQ(through.switches.size(), 2u);
  EXPECT_NEAR(through.wait_s, (1 + 16) / 30.0, 1e-12) << "until the wanted clip plays";
  EXPECT_GT(through.pairs_seen, 0);

  const Transition direct = PlanTransition(library, 0, 0, 2, Choice::kFuzzyBridge, {});
  EXPECT_EQ(direct.branch, Branch::kFrontHalf);
  EXPECT_NEAR(direct.wait_s, 1 / 30.0, 1e-12);

  const Transition to_rear = PlanTransition(library, 1, 0, 2, Choice::kFuzzyBridge, {});
  EXPECT_EQ(to_rear.branch, Branch::kRearHalf);

  library.pop_back();
  const Transition none = PlanTransition(library, 0, 0, 1, Choice::kFuzzyBridge, {});
  EXPECT_EQ(none.branch, Branch::kNone);
  EXPECT_TRUE(none.switches.empty());
}

TEST(PlanTransition, GoesToTheFirstFrameNowOrAtTheEnd) {
  const auto library = LibraryWithAWayThrough();
  const Transition now = PlanTransition(library, 2, 8, 1, Choice::kNow, {});
  ASSERT_EQ(now.switches.size(), 1u);
  EXPECT_EQ(now.switches[0].from_frame, 8);
  EXPECT_EQ(now.switches[0].to_frame, 0);
  EXPECT_EQ(now.wait_s, 0);
  EXPECT_NEAR(now.switches[0].distance.value, 2 - 0.85, 1e-12);

  const Transition end = PlanTransition(library, 2, 8, 1, Choice::kWaitForEnd, {});
  EXPECT_EQ(end.switches.at(0).from_frame, 20);
  EXPECT_NEAR(end.wait_s, 12 / 30.0, 1e-12);
}

}  // namespace
}  // namespace etude

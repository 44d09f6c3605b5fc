#include "engine/transitions/library/transition_points.h"

#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

constexpr FrameWindow kAll{0, 100};

void ExpectPoint(const std::optional<TransitionPoint>& point, int from, int to) {
  ASSERT_TRUE(point);
  EXPECT_EQ(point->from, from);
  EXPECT_EQ(point->to, to);
}

TEST(FindTransitionPoint, TakesTheFirstMatchInPlayingOrderThenTargetOrder) {
  const TaggedClip playing = ClipOfLevels({9, 0, 0, 0}, {0, 1, 2});
  const TaggedClip next = ClipOfLevels({9.5, 5, 0.3, 0, 9.5, 9.5}, {1, 2, 3});
  const std::optional<TransitionPoint> point = FindTransitionPoint(playing, kAll, next, {});
  ExpectPoint(point, 1, 2);
  EXPECT_NEAR(point->distance.value, 0.3, 1e-12);
  EXPECT_NEAR(point->distance.partials[0], 0.09, 1e-12);
}

TEST(FindTransitionPoint, LooksAtTheFrontHalfBeforeTheRearHalf) {
  const TaggedClip playing = ClipOfLevels({0, 0}, {0, 1});
  // By the smallest distance: the front half is preferred, although only the rear half has an exact match.
  const TaggedClip next = ClipOfLevels({5, 0.3, 0.2, 5, 0, 5}, {1, 2, 4});
  MatchRules smallest;
  smallest.pick = Pick::kSmallest;
  ExpectPoint(FindTransitionPoint(playing, kAll, next, smallest), 0, 2);
  const TaggedClip rear_only = ClipOfLevels({5, 5, 5, 0.3, 0, 5}, {0, 3, 4});
  ExpectPoint(FindTransitionPoint(playing, kAll, rear_only, {}), 0, 3);
  ExpectPoint(FindTransitionPoint(playing, kAll, rear_only, smallest), 0, 4);
  // A later frame that matches in the front half precedes an earlier one with a nearer match in the rear half.
  const TaggedClip later = ClipOfLevels({0, 0.5}, {0, 1});
  ExpectPoint(FindTransitionPoint(later, kAll, ClipOfLevels({5, 0.8, 5, 0, 5}, {1, 3}), smallest), 1, 1);
  ExpectPoint(FindTransitionPoint(later, kAll, ClipOfLevels({5, 0.8, 5, 0, 5}, {1, 3}), {}), 0, 3);
}

TEST(FindTransitionPoint, NeedsADistanceBelowTheThreshold) {
  const TaggedClip playing = ClipOfLevels({0, 0}, {0});
  const TaggedClip next = ClipOfLevels({0.5, 0.5}, {0});
  MatchRules rules;
  rules.threshold = 0.5;
  EXPECT_FALSE(FindTransitionPoint(playing, kAll, next, rules)) << "equal is not below";
  rules.threshold = 0.51;
  EXPECT_TRUE(FindTransitionPoint(playing, kAll, next, rules));
}

TEST(FindTransitionPoint, NeverTargetsTheLastFrame) {
  EXPECT_FALSE(FindTransitionPoint(ClipOfLevels({0}, {0}), kAll, ClipOfLevels({9, 9, 0}, {0, 1, 2}), {}));
}

TEST(FindTransitionPoint, ComparesInsideTheClassOnlyWhenAsked) {
  const TaggedClip playing = ClipOfLevels({0, 0}, {0});
  TaggedClip next = ClipOfLevels({0, 0, 0}, {0, 1});
  next.tags[0][3] = 1;
  ExpectPoint(FindTransitionPoint(playing, kAll, next, {}), 0, 0);
  MatchRules rules;
  rules.within_class = true;
  ExpectPoint(FindTransitionPoint(playing, kAll, next, rules), 0, 1);
}

TEST(WaitWindow, EndsWithTheClip) {
  const TaggedClip clip = ClipOfLevels(std::vector<double>(50, 0.0), {});
  EXPECT_EQ(WaitWindow(clip, 10, 1).last, 40) << "1 s at 30 Hz";
  EXPECT_EQ(WaitWindow(clip, 40, 1).last, 49);
  EXPECT_EQ(WaitWindow(ClipOfLevels(std::vector<double>(200, 0.0), {}), 0, 4.1).last, 123) << "not a frame less";
  EXPECT_EQ(WaitWindow(clip, 40, 0).last, 40) << "no budget: the frame shown now is the only one";
  EXPECT_EQ(WaitWindow(clip, 49, 1).last, 49);
  const TaggedClip playing = ClipOfLevels({0, 9, 0, 0}, {0, 1, 3});
  ExpectPoint(FindTransitionPoint(playing, {1, 3}, ClipOfLevels({0, 0}, {0}), {}), 3, 0);
}

}  // namespace
}  // namespace etude

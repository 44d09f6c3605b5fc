#include "engine/switching/choices/choice.h"

#include <gtest/gtest.h>

#include "tests/engine/bridging/test_clips.h"

namespace etude {
namespace {

/// Clip 0 plays; clip 1 is unlike it; clip 2 goes from the one to the other in 20 frames.
MotionLibrary ThreeClips() {
  std::vector<double> levels(21);
  std::vector<int> frames(21);
  for (int f = 0; f <= 20; ++f) levels[f] = 0.05 + 0.1 * (frames[f] = f);
  MotionLibrary library;
  library.tagged = {ClipOfLevels({0, 0, 0, 0}, {1, 2}), ClipOfLevels({2, 2, 2, 2}, {1, 2}),
                    ClipOfLevels(levels, frames)};
  return library;
}

SwitchRecord Plan(std::string_view choice, const SwitchRequest& request) {
  return FindChoice(choice)->plan(ThreeClips(), request, {});
}

TEST(FuzzyBridge, RecordsTheBranchItTook) {
  const SwitchRecord direct = Plan("fuzzy-bridge", {.from = 0, .request_frame = 0, .to = 2});
  EXPECT_EQ(direct.branch, Branch::kFrontHalf);
  EXPECT_NEAR(direct.wait_s, 1 / 30.0, 1e-12);
  EXPECT_EQ(Plan("fuzzy-bridge", {.from = 1, .request_frame = 0, .to = 2}).branch, Branch::kRearHalf);
}

TEST(AbruptChoices, GoToTheFirstFrameNowOrAtTheEnd) {
  const SwitchRecord now = Plan("now", {.from = 2, .request_frame = 8, .to = 1});
  ASSERT_EQ(now.legs.size(), 2u);
  EXPECT_EQ(now.legs[0].last, 8);
  EXPECT_EQ(now.legs[1].first, 0);
  EXPECT_EQ(now.wait_s, 0);
  EXPECT_NEAR(now.meetings[0].value, 2 - 0.85, 1e-12);

  const SwitchRecord end = Plan("wait-for-end", {.from = 2, .request_frame = 8, .to = 1});
  EXPECT_EQ(end.legs[0].last, 20);
  EXPECT_NEAR(end.wait_s, 12 / 30.0, 1e-12);
}

}  // namespace
}  // namespace etude

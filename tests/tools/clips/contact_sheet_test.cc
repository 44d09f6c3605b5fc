#include "tools/clips/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/results.h"
#include "tests/tools/clips/clip_scene.h"
#include "tools/clips/clip_facts.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

TEST(ContactSheetTest, SheetsThatNobodyCouldOpenAreRefused) {
  ASSERT_OK(renderer, SharedRenderer());
  const SheetOptions huge{.width = 2000, .height = 2000, .frames = 40, .columns = 40};
  EXPECT_THAT(testing::Message(DrawContactSheet({ActorOf("builtin:clap", ActorKind::kBody)}, huge, **renderer)),
              HasSubstr("allowed: at most 16000 pixels per side"));
}

TEST(ContactSheetTest, TheSameClipsGiveTheSameBytes) {
  ASSERT_OK(renderer, SharedRenderer());
  const SheetOptions small{.width = 60, .height = 80, .frames = 2, .columns = 2};
  const auto draw = [&] { return DrawContactSheet({ActorOf("builtin:clap", ActorKind::kBear)}, small, **renderer); };
  const auto first = draw(), second = draw();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

TEST(ClipFactsTest, WhatIsUnderstoodIsToldInFull) {
  const ClipFacts facts = FactsOf(Opened(kRealClip));
  EXPECT_THAT(FactsAsText(facts), HasSubstr("left_elbow = 'LeftForeArm'"));
  EXPECT_THAT(FactsAsText(facts, &facts), HasSubstr("roles    as above"));
  EXPECT_THAT(FactsAsLine(facts), HasSubstr("BVH · "));
  EXPECT_THAT(FactsAsLine(facts), HasSubstr(" m tall · feet slide "));
}

TEST(ClipFactsTest, AFileThatIsNoneIsToldByItsComplaintAlone) {
  const std::vector<ClipFacts> facts = FactsOf("nowhere.bvh", {});
  ASSERT_EQ(facts.size(), 1u);
  ASSERT_TRUE(facts[0].complaint);
  EXPECT_THAT(FactsAsText(facts[0]), HasSubstr("no such file"));
  EXPECT_THAT(FactsAsJson(facts).dump(), HasSubstr(R"("format":null)"));
}

}  // namespace
}  // namespace etude

#include "tools/clips/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/images/image_files.h"
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
              HasSubstr("allowed: 16000 a side"));
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

constexpr Rgb8 kRed{200, 30, 20}, kBlue{20, 60, 210}, kGreen{0, 255, 0};

/// The sheet as pixels.
ColourImage Drawn(const SensorSheet& sheet) {
  const auto png = DrawSensorSheet(sheet);
  EXPECT_TRUE(png) << ToString(png.error());
  // Of the test's own: others run beside it.
  const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::path(::testing::TempDir()) / ("etude-sensor-sheet-" + test + ".png");
  std::ofstream(path, std::ios::binary) << *png;
  auto picture = LoadColourPng(path.string());
  EXPECT_TRUE(picture);
  std::filesystem::remove(path);
  return *picture;
}

int Count(const ColourImage& picture, Rgb8 colour) {
  return static_cast<int>(std::ranges::count(picture.pixels, colour));
}

TEST(SensorSheet, ShowsEveryPictureAtOneSize) {
  SensorSheet sheet{"a scenario",
                    {{"first", {{"red", ColourImage(640, 480, kRed), {}}}},
                     {"second", {{"blue", ColourImage(240, 180, kBlue), {}}, {"red", ColourImage(80, 60, kRed), {}}}}}};
  const ColourImage drawn = Drawn(sheet);
  EXPECT_NEAR(Count(drawn, kBlue), 260 * 195, 0.03 * 260 * 195);
  EXPECT_NEAR(Count(drawn, kRed), 2 * 260 * 195, 0.03 * 2 * 260 * 195);
}

TEST(SensorSheet, DrawsMarksOverTheirPictureAndNowhereElse) {
  SensorSheet sheet{
      "a scenario",
      {{"row",
        {{"marked", ColourImage(640, 480, kRed), {{{100, 100}, {500, 100}, kGreen}, {{300, 300}, {300, 300}, kGreen}}},
         {"beside", ColourImage(640, 480, kBlue), {}}}}}};
  const ColourImage drawn = Drawn(sheet);
  EXPECT_GT(Count(drawn, kGreen), 100);
  EXPECT_NEAR(Count(drawn, kBlue), 260 * 195, 0.03 * 260 * 195);
  sheet.rows[0].pictures[0].marks = {{{100, 100}, {900, 100}, kGreen}};
  EXPECT_EQ(Count(Drawn(sheet), kGreen), 0) << "a mark that leaves its picture would lie on the next";
}

TEST(SensorSheet, RefusesWhatCannotBeDrawn) {
  EXPECT_FALSE(DrawSensorSheet({"nothing", {}}));
  EXPECT_FALSE(DrawSensorSheet({"empty rows", {{"row", {}}}}));
  SensorSheet endless{"long", std::vector<SheetRow>(80, {"row", {{"x", ColourImage(4, 3, kRed), {}}}})};
  EXPECT_FALSE(DrawSensorSheet(endless));
}

}  // namespace
}  // namespace etude

#include "io/real_takes/real_take.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

RealTake SomeTake() {
  return {.name = "a man: \"on\" a beam",
          .recovery = "silhouettes",
          .reference = "markers.trc",
          .films = {"cam1.mp4", "cam # 2.mp4"},
          .frames = 100,
          .rate_hz = 59.94,
          .distances = {{"all", 60.25, 143.1}, {"1+2", std::nullopt, std::nullopt}}};
}

std::string Complaint(std::string text) {
  const auto read = ReadRealTake(text, "take.json");
  return read ? "taken" : ToString(read.error());
}

std::string Spoilt(const std::string& what, const std::string& with) {
  return testing::Replaced(WriteRealTake(SomeTake()), what, with);
}

TEST(RealTake, IsReadAsItWasWritten) {
  ASSERT_OK(read, ReadRealTake(WriteRealTake(SomeTake()), "take.json"));
  EXPECT_EQ(*read, SomeTake());
}

TEST(RealTake, WhatIsWrongIsRefusedWithItsPlace) {
  EXPECT_THAT(Complaint(Spoilt("silhouettes", "guesses")),
              HasSubstr("take.json:3:15: unknown recovery 'guesses'. Allowed: keypoints, marks, silhouettes"));
  EXPECT_THAT(Complaint(Spoilt("60.25", "-1")), HasSubstr("take.json:14:20: "));
  EXPECT_THAT(Complaint(Spoilt("60.25", ".nan")), HasSubstr("take.json:14:20: "));
  EXPECT_THAT(Complaint(Spoilt("\"median_mm\"", "\"mean_mm\"")), HasSubstr("mean_mm"));
  EXPECT_THAT(Complaint(Spoilt("100", "0")), HasSubstr("take.json:9:13: "));
  EXPECT_THAT(Complaint("{name: a, recovery: marks, reference: b, frames: 1, rate_hz: 30, distances: []}"),
              HasSubstr("'distances' needs one for some cameras"));
  EXPECT_THAT(Complaint("{name: a, reference: b, frames: 1, rate_hz: 30, distances: [{cameras: all}]}"),
              HasSubstr("'recovery' is missing"));
  EXPECT_THAT(Complaint("[]"), HasSubstr("take.json:1:1"));
}

}  // namespace
}  // namespace etude

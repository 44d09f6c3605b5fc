#include "io/real_takes/real_take.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/kept_answers.h"
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

TEST(RealTake, IsReadAsItWasWritten) {
  ASSERT_OK(read, ReadRealTake(WriteRealTake(SomeTake()), "take.json"));
  EXPECT_EQ(*read, SomeTake());
}

TEST(RealTake, WhatIsWrongIsRefusedWithItsPlace) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/io/real_takes/complaints.txt", [](const std::string& edit) {
    return testing::Refusal(ReadRealTake(testing::Edited(WriteRealTake(SomeTake()), edit), "take.json"));
  }));
}

}  // namespace
}  // namespace etude

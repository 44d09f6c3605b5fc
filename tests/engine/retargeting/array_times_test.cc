// Rates and times in arrays of positions, as public data sets name them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/retargeting/joint_arrays.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::size_t kJoints = 20;

/// Returns the height of joint `j` at a time; the joints move at different speeds.
double HeightAt(double time_s, std::size_t j) {
  return 0.08 * static_cast<double>(kJoints - j) + 0.1 * std::sin(time_s * (2 + static_cast<double>(j)));
}

/// Returns arrays with a frame at each of these times.
Npz ArraysAt(const std::vector<double>& times) {
  Npz npz;
  NumberArray& positions = npz.arrays["positions"];
  positions.shape = {times.size(), kJoints, 3};
  for (const double time : times) {
    for (std::size_t j = 0; j < kJoints; ++j) {
      for (const double value : {0.1 * static_cast<double>(j % 2), HeightAt(time, j), 0.01})
        positions.values.push_back(value);
    }
  }
  return npz;
}

/// Returns the times of a 30 Hz motion of 120 frames, of which frames 40 to 59 are missing if there is a hole.
std::vector<double> Times(bool has_hole) {
  std::vector<double> times;
  for (int k = 0; k < 120; ++k) {
    if (!has_hole || k < 40 || k >= 60) times.push_back(k / 30.0);
  }
  return times;
}

NumberArray List(const std::vector<double>& values) { return {.shape = {values.size()}, .values = values}; }

/// Returns the largest error of a height, m, over the joints that are seen.
double FarthestFromCurve(const RawMotion& motion) {
  double worst = 0;
  for (std::size_t f = 0; f < motion.FrameCount(); ++f) {
    for (std::size_t j = 0; j < kJoints; ++j) {
      const double height = motion.At(f, j).y;
      if (!std::isnan(height))
        worst = std::max(worst, std::abs(height - HeightAt(static_cast<double>(f) / motion.rate_hz, j)));
    }
  }
  return worst;
}

TEST(ArrayTimes, PlaceTheFramesWithOrWithoutARate) {
  for (const char* name : {"times", "times_s", "time_s", "timestamps", "t"}) {
    for (const double stated_hz : {0.0, 30.0}) {
      Npz npz = ArraysAt(Times(true));
      npz.arrays[name] = List(Times(true));
      if (stated_hz > 0) npz.arrays["rate_hz"] = {.shape = {}, .values = {stated_hz}};
      ASSERT_OK(motion, ReadRawNpz(npz, "a.npz"));
      EXPECT_NEAR(motion->rate_hz, 30, 1e-9);
      EXPECT_EQ(motion->FrameCount(), 120u) << name;
      EXPECT_LT(FarthestFromCurve(*motion), 1e-9);
      for (std::size_t f = 0; f < 120; ++f) EXPECT_EQ(std::isnan(motion->At(f, 3).y), f >= 40 && f < 60) << f;
      EXPECT_THAT(motion->notes,
                  ElementsAre("by their times, 20 of 120 frames are missing, in 1 gap of at most 0.7 s"));
    }
  }
  // Times in milliseconds that begin late.
  Npz late = ArraysAt(Times(false));
  std::vector<double> milliseconds = Times(false);
  for (double& time : milliseconds) time = std::round(1000 * (time + 7));
  late.arrays["timestamps"] = List(milliseconds);
  late.arrays["fps"] = {.shape = {}, .values = {30}};
  ASSERT_OK(motion, ReadRawNpz(late, "a.npz"));
  EXPECT_EQ(motion->rate_hz, 30);
  EXPECT_NEAR(motion->start_s.value_or(0), 7, 1e-9);
  EXPECT_THAT(motion->notes,
              ElementsAre("the array timestamps is taken as milliseconds, because the rows then have the "
                          "fps of 30 Hz"));
}

TEST(ArrayTimes, PlaceASingleFrameWithOrWithoutARate) {
  for (const bool has_rate : {true, false}) {
    Npz npz = ArraysAt({3.25});
    npz.arrays["times"] = List({3.25});
    if (has_rate) npz.arrays["rate_hz"] = {.shape = {}, .values = {30}};
    ASSERT_OK(motion, ReadRawNpz(npz, "a.npz"));
    EXPECT_EQ(motion->start_s, 3.25);
    EXPECT_EQ(motion->FrameCount(), 1u);
  }
}

TEST(ArrayTimes, ThatContradictTheRateAreUsedAndSaid) {
  Npz npz = ArraysAt(Times(false));
  npz.arrays["times"] = List(Times(false));
  npz.arrays["rate_hz"] = {.shape = {}, .values = {60}};
  ASSERT_OK(motion, ReadRawNpz(npz, "a.npz"));
  EXPECT_EQ(motion->rate_hz, 30);
  EXPECT_THAT(motion->notes, ElementsAre("rate_hz states 60 Hz, but the times in the array times give 30 Hz, which is "
                                         "used"));
  EXPECT_EQ(ReadRawNpz(npz, "a.npz", {.rate_hz = 25})->rate_hz, 25) << "the user's rate overrules both";
}

TEST(ArrayTimes, RatesHaveTheNamesOfPublicDataSets) {
  for (const char* name : {"rate_hz", "fps", "framerate", "frame_rate", "mocap_framerate", "mocap_frame_rate"}) {
    Npz npz = ArraysAt(Times(false));
    npz.arrays[name] = {.shape = {1}, .values = {50}};
    ASSERT_OK(motion, ReadRawNpz(npz, "a.npz"));
    EXPECT_EQ(motion->rate_hz, 50) << name;
    EXPECT_THAT(motion->notes, IsEmpty());
  }
  Npz both = ArraysAt(Times(false));
  both.arrays["rate_hz"] = {.shape = {}, .values = {30}};
  both.arrays["fps"] = {.shape = {}, .values = {60}};
  EXPECT_THAT(testing::Refusal(ReadRawNpz(both, "a.npz")), HasSubstr("rate_hz is 30 and fps is 60; allowed: one rate"));
  both.arrays.erase("rate_hz");
  both.arrays["fps"].values = {0};
  EXPECT_THAT(testing::Refusal(ReadRawNpz(both, "a.npz")), HasSubstr("fps is 0; allowed: 0.1 to 10000 Hz"));
}

TEST(ArrayTimes, ThatAreNoClockAreRefused) {
  const auto refusal = [](const char* name, const std::vector<double>& times) {
    Npz npz = ArraysAt(Times(false));
    npz.arrays[name] = List(times);
    return testing::Refusal(ReadRawNpz(npz, "a.npz"));
  };
  EXPECT_THAT(refusal("times", std::vector<double>(119, 0)),
              HasSubstr("the array times has 119 values, but the positions have 120 frames; allowed: one time for each "
                        "frame"));
  EXPECT_THAT(refusal("times", std::vector<double>(120, 3)), HasSubstr("all times in the array times are equal"));
  std::vector<double> backwards = Times(false);
  backwards[9] = 0;
  EXPECT_THAT(refusal("times", backwards), HasSubstr("allowed: times that do not decrease"));
  // Arrays of other shapes are no times.
  Npz npz = ArraysAt(Times(false));
  npz.arrays["t"] = {.shape = {120, 3}, .values = std::vector<double>(360, 1)};
  npz.arrays["time"] = {.shape = {}, .values = {12.5}};
  EXPECT_THAT(testing::Refusal(ReadRawNpz(npz, "a.npz")),
              ::testing::AllOf(HasSubstr("found no rate_hz"), HasSubstr("(the file's arrays: positions, t, time")));
}

}  // namespace
}  // namespace etude

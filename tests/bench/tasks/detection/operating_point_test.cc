#include "bench/tasks/detection/operating_point.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

/// A minute at 10 Hz in which one move's evidence peaks to these heights, ten seconds apart.
AlarmTrial Peaks(const std::vector<double>& heights) {
  EvidenceTrace trace{.moves = 1, .asked = std::vector<double>(600, 0.0), .spotted = std::vector<double>(600, 0.0)};
  for (std::size_t i = 0; i < heights.size(); ++i) trace.spotted[50 + 100 * i] = heights[i];
  return {.trace = std::make_shared<const EvidenceTrace>(std::move(trace)),
          .rate_hz = 10,
          .is_performance = [](const Detection&) { return false; }};
}

TEST(ThresholdAt, LetsAsManyAlarmsThroughAsAreBorne) {
  const std::vector<AlarmTrial> trials = {Peaks({0.9, 0.3, 0.5}), Peaks({0.7, 0.2})};
  // Two minutes: at 1 a minute two alarms may pass, those of 0.9 and 0.7, and 0.5 may not.
  const double threshold = ThresholdAt(trials, 1, 1);
  EXPECT_GT(threshold, 0.5);
  EXPECT_LT(threshold, 0.5001);
  EXPECT_GT(ThresholdAt(trials, 0.4, 1), 0.9);
  EXPECT_NEAR(ThresholdAt(trials, 2, 1), 0.2, 1e-4);
  EXPECT_LT(ThresholdAt(trials, 2.5, 1), 1e-4) << "all may pass";
}

TEST(ThresholdAt, CountsNoPerformanceAsAnAlarm) {
  std::vector<AlarmTrial> trials = {Peaks({0.9, 0.3, 0.5})};
  trials[0].is_performance = [](const Detection& detection) { return detection.frame == 50; };
  EXPECT_NEAR(ThresholdAt(trials, 1, 1), 0.3, 1e-4);
}

TEST(ThresholdAt, IsOneWhereEvenCertaintyIsTooOften) {
  EXPECT_EQ(ThresholdAt(std::vector<AlarmTrial>{Peaks({1, 1, 1})}, 1, 1), 1);
}

}  // namespace
}  // namespace etude

#include "bench/tasks/detection/operating_point.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

/// Returns a minute at 10 Hz in which one move's evidence has peaks of these heights, ten seconds apart.
AlarmTrial Peaks(const std::vector<double>& heights) {
  EvidenceTrace trace{.moves = 1, .asked = std::vector<double>(600, 0.0), .spotted = std::vector<double>(600, 0.0)};
  for (std::size_t i = 0; i < heights.size(); ++i) trace.spotted[50 + 100 * i] = heights[i];
  return {.trace = std::make_shared<const EvidenceTrace>(std::move(trace)),
          .rate_hz = 10,
          .is_performance = [](const Detection&) { return false; }};
}

TEST(ThresholdAt, LetsAsManyAlarmsThroughAsAreBorne) {
  const std::vector<AlarmTrial> trials = {Peaks({0.9, 0.3, 0.5}), Peaks({0.7, 0.2})};
  // Two minutes at 1 alarm a minute allow two alarms, those of 0.9 and 0.7, but not that of 0.5.
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

JudgedEvent Scored(bool is_right, double score) { return {is_right, false, score}; }

TEST(ThresholdAtRecall, PraisesSoManyOfTheRightAndNoMore) {
  std::vector<JudgedEvent> events = {Scored(false, 0.95), Scored(false, 0.05)};  // wrong performances do not count
  for (int i = 1; i <= 10; ++i) events.push_back(Scored(true, 0.09 * i));
  EXPECT_DOUBLE_EQ(*ThresholdAtRecall(events, 0.9), 0.18);
  EXPECT_DOUBLE_EQ(*ThresholdAtRecall(events, 0.89), 0.18);
  EXPECT_DOUBLE_EQ(*ThresholdAtRecall(events, 0.91), 0.09);
  EXPECT_DOUBLE_EQ(*ThresholdAtRecall(events, 0.01), 0.9);
  EXPECT_FALSE(ThresholdAtRecall(std::vector{Scored(false, 1)}, 0.9).has_value());
}

TEST(DecideBy, SetsTwoThresholds) {
  const std::vector<AlarmTrial> alarms = {Peaks({0.9, 0.3, 0.5})};
  const TrialsOfMethods trials = {{alarms, {Scored(true, 0.4), Scored(true, 0), Scored(false, 0.6)}}};
  std::vector<ReadyMethod> methods(1);
  const auto set = DecideBy(methods, trials, OperatingPoint{.false_alarms_per_min = 1, .recall = 0.5});
  EXPECT_NEAR(set[0].spotting.threshold, 0.5, 1e-4);
  EXPECT_DOUBLE_EQ(set[0].judging, 0.4);
  EXPECT_GT(DecideBy(methods, trials, OperatingPoint{.recall = 1})[0].judging, 0) << "no evidence is no praise";
  const auto unset = DecideBy(methods, trials, std::nullopt);
  EXPECT_EQ(unset[0].spotting.threshold, 0.5);
  EXPECT_EQ(unset[0].judging, 0.5);
  methods[0].method.threshold = 0.7;  // this method sets its own threshold for both questions
  const auto own = DecideBy(methods, trials, OperatingPoint{});
  EXPECT_EQ(own[0].spotting.threshold, 0.7);
  EXPECT_EQ(own[0].judging, 0.7);
}

TEST(DecideBy, SpottingsThresholdJudgesWhereNobodyWasRight) {
  const TrialsOfMethods trials = {{{Peaks({0.9, 0.3, 0.5})}, {Scored(false, 0.2)}}};
  const std::vector<ReadyMethod> methods(1);
  const auto set = DecideBy(methods, trials, OperatingPoint{.false_alarms_per_min = 1});
  EXPECT_EQ(set[0].judging, set[0].spotting.threshold);
}

}  // namespace
}  // namespace etude

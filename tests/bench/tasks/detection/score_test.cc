#include "bench/tasks/detection/score.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

SessionEvent Event(Truth truth, double start_s, std::optional<double> first_right_s) {
  SessionEvent event;
  event.move = "clap";
  event.danced = "clap";
  event.truth = truth;
  event.start_s = start_s;
  event.end_s = start_s + 1.5;  // the window is 2 s long
  event.first_right_s = first_right_s;
  return event;
}

Judgement Called(std::optional<int> right_at, double score) {
  return {.recognised_at = right_at, .score = score, .running_score = std::vector<double>(60, score)};
}

double Value(const CellResult& cell, std::string_view id) {
  for (const MetricValue& metric : cell.metrics) {
    if (metric.id == id && metric.value) return *metric.value;
  }
  ADD_FAILURE() << "no value of " << id;
  return -1;
}

TEST(ScoreSession, MatchesAVectorWorkedByHand) {
  DetectionWorld world;
  world.session.motion.poses.resize(900);  // half a minute
  world.stream.frames.resize(900);
  world.session.events = {Event(Truth::kRight, 1, 2.0), Event(Truth::kRight, 5, 6.0), Event(Truth::kRight, 9, 10.0),
                          Event(Truth::kWrong, 13, std::nullopt), Event(Truth::kWrong, 17, std::nullopt)};
  SessionVerdict verdict;
  // Called right 0.1 s after the truth; 0.3 s after; missed; wrongly called right; rightly called wrong.
  verdict.events = {Called(33, 0.9), Called(39, 0.8), Called(std::nullopt, 0.4), Called(20, 0.6),
                    Called(std::nullopt, 0)};
  verdict.alarms = {{1, 120}, {0, 400}, {0, 800}};

  CellResult cell;
  ScoreSession(world, verdict, cell);
  EXPECT_DOUBLE_EQ(Value(cell, "precision"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "recall"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "f1"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "roc_auc"), 5.0 / 6);  // 0.4 loses to 0.6
  // Waits 0.1, 0.3 and one given up after 1 s: the median of all three is 0.3; of those that came it were 0.2.
  EXPECT_NEAR(Value(cell, "latency_s"), 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(Value(cell, "false_alarms_per_min"), 6.0);
}

TEST(ScoreSession, SaysWhyAValueIsMissing) {
  DetectionWorld world;
  world.session.motion.poses.resize(300);
  world.stream.frames.resize(300);
  world.session.events = {Event(Truth::kRight, 1, 2.0)};
  SessionVerdict verdict;
  verdict.events = {Called(std::nullopt, 0.2)};
  CellResult cell;
  ScoreSession(world, verdict, cell);
  int missing = 0;
  for (const MetricValue& metric : cell.metrics) {
    if (metric.value) continue;
    ++missing;
    EXPECT_FALSE(metric.null_reason.empty()) << metric.id;
  }
  EXPECT_EQ(missing, 3);  // precision, roc_auc, latency_s
  EXPECT_EQ(Value(cell, "recall"), 0.0);
}

}  // namespace
}  // namespace etude

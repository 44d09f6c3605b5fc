#include "bench/tasks/detection/score.h"

#include <gtest/gtest.h>

#include <map>

namespace etude {
namespace {

DetectionEvent Event(Truth truth, double start_s, std::optional<double> first_right_s) {
  DetectionEvent event{.move = "clap", .danced = "clap", .truth = truth};
  event.start_s = start_s;
  event.end_s = start_s + 1.5;
  const auto begin = static_cast<int>(30 * start_s);
  event.performed = {begin, begin + 45};
  event.window = {begin, begin + 60};
  event.first_right_s = first_right_s;
  return event;
}

const Repertoire kMoves{.moves = {},
                        .taught = {{.name = "boxing"}, {.name = "clap"}, {.name = "sway"}},
                        .names = {"boxing", "clap", "sway"}};

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
  world.motion.poses.resize(900);  // 30 s
  world.stream.frames.resize(900);
  world.events = {Event(Truth::kRight, 1, 2.0),           Event(Truth::kRight, 5, 6.0),
                  Event(Truth::kRight, 9, 10.0),          Event(Truth::kWrong, 13, std::nullopt),
                  Event(Truth::kWrong, 17, std::nullopt), Event(Truth::kGrey, 21, std::nullopt)};
  world.events[4].danced = "";
  for (std::size_t faulty : {1, 3, 4}) world.events[faulty].faults = {{Fault::kAmplitude, 0.5}};
  world.events[0].faults = {{Fault::kLate, 0}};  // a fault of size 0 is not a fault
  SessionVerdict verdict;
  // Called right 0.1 s after the truth; called right 0.3 s after it; missed; a wrong one called right; a wrong one
  // called wrong; grey.
  verdict.events = {Called(33, 0.9), Called(39, 0.8),         Called(std::nullopt, 0.4),
                    Called(20, 0.6), Called(std::nullopt, 0), Called(50, 0.7)};
  verdict.named = {1, 1, 2, 1, 0, std::nullopt};
  verdict.alarms = {{1, 120}, {0, 400}, {0, 800}};
  // The first alarm is inside its window, the second after it, the third names another move, and two are wrong.
  verdict.spotted = {{1, 89}, {1, 210}, {2, 290}, {1, 400}, {1, 520}};

  CellResult cell;
  ScoreSession(world, verdict, kMoves, cell);
  EXPECT_DOUBLE_EQ(Value(cell, "precision"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "recall"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "f1"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "fault_found"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "grey_called_right"), 1);
  EXPECT_DOUBLE_EQ(Value(cell, "right_spotted"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(Value(cell, "move_named"), 3.0 / 5);  // of six events, one has no performance
  EXPECT_DOUBLE_EQ(Value(cell, "roc_auc"), 5.0 / 6);     // 0.4 loses against 0.6
  // The waits are 0.1 s, 0.3 s, and more than 1 s: the median is 0.3 s. The median of those that ended would be 0.2 s.
  EXPECT_NEAR(Value(cell, "latency_s"), 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(Value(cell, "false_alarms_per_min"), 6.0);
}

TEST(ScoreSession, SaysWhyAValueIsMissing) {
  DetectionWorld world;
  world.motion.poses.resize(300);
  world.stream.frames.resize(300);
  world.events = {Event(Truth::kRight, 1, 2.0)};
  CellResult cell;
  ScoreSession(world, {.events = {Called(std::nullopt, 0.2)}}, kMoves, cell);
  int missing = 0;
  for (const MetricValue& metric : cell.metrics) {
    if (metric.value) continue;
    ++missing;
    EXPECT_FALSE(metric.null_reason.empty()) << metric.id;
  }
  EXPECT_EQ(missing, 7);  // precision, fault_found, grey_called_right, move_named, action_point_f, roc_auc, latency_s
  EXPECT_EQ(Value(cell, "recall"), 0.0);
}

TEST(ScoreSession, PointsAreMetWithinAThirdOfASecond) {
  DetectionWorld world;
  world.motion.poses.resize(300);
  world.stream.frames.resize(300);
  world.points = {{"clap", 60}, {"sway", 150}};
  SessionVerdict verdict;
  verdict.spotted = {{1, 69}, {1, 240}, {2, 161}};  // 0.3 s late; without a performance; 0.37 s late
  CellResult cell;
  ScoreSession(world, verdict, kMoves, cell);
  EXPECT_DOUBLE_EQ(Value(cell, "action_point_f"), (2.0 / 3 + 0) / 2);
}

TEST(PerformanceSeries, TellsWhatWasDoneAndSaid) {
  DetectionWorld world;
  DetectionEvent late = Event(Truth::kWrong, 1, std::nullopt);
  late.faults = {{Fault::kAmplitude, 0.2}, {Fault::kLate, 0.7}};
  world.events = {late, Event(Truth::kGrey, 5, std::nullopt)};
  SessionVerdict verdict{.events = {Called(9, 0.6), Called(std::nullopt, 0.1)}, .named = {2, std::nullopt}};
  std::map<std::string, std::vector<double>> told;
  for (const Series& series : PerformanceSeries(world, verdict, kMoves)) told[series.name] = series.values;
  using Values = std::vector<double>;
  EXPECT_EQ(told["performance_score"], (Values{0.6, 0.1}));
  EXPECT_EQ(told["performance_truth"], (Values{0, 0.5}));
  EXPECT_EQ(told["performance_called"], (Values{1, 0}));
  EXPECT_EQ(told["performance_fault"], (Values{4, -1})) << "the worst one";
  EXPECT_EQ(told["performance_severity"], (Values{0.7, 0}));
  EXPECT_EQ(told["performance_asked"], (Values{1, 1}));
  EXPECT_EQ(told["performance_danced"], (Values{1, 1}));
  EXPECT_EQ(told["performance_named"], (Values{2, -1}));
  EXPECT_TRUE(told["right_wait_s"].empty()) << "none was right";
}

}  // namespace
}  // namespace etude

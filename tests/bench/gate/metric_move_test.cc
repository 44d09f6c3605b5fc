#include "bench/gate/metric_move.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/gate/gate.h"
#include "tests/bench/gate/example.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The metric's practical threshold is 0.05 cm.
constexpr TailRule kRule{.times = 20, .worlds = 3, .share = 0, .lost = 1};
constexpr double kFar = 20 * 0.05;

MoveColumns Columns(const std::vector<std::optional<double>>& after) {
  MoveColumns columns;
  columns.after = after;
  columns.before.assign(after.size(), 10.0);
  columns.compared.assign(after.size(), true);
  columns.ended_before = columns.ended_after = std::string(after.size(), 'o');
  return columns;
}

std::vector<int> TrialsOf(const std::vector<TailWorld>& tail) {
  std::vector<int> trials;
  for (const TailWorld& world : tail) trials.push_back(world.trial);
  return trials;
}

std::vector<int> TailOf(const std::vector<std::optional<double>>& after,
                        const std::string& metric = "position_error_cm") {
  return TrialsOf(FindTail(Columns(after), *FindGateMetric(metric), kRule));
}

TEST(Tail, HoldsWorldsThatAreWorseByMoreThanTheRuleLetsPassTheWorstFirst) {
  EXPECT_THAT(TailOf({10.0, 10 + 1.01 * kFar, 10 + 0.99 * kFar, 10 + 5 * kFar, 10 - 5 * kFar}), ElementsAre(3, 1));
  EXPECT_THAT(TailOf({10 + kFar, 10 - kFar}), IsEmpty());  // exactly at the limit does not count
}

TEST(Tail, KnowsWhichWayIsWorse) {
  // Higher recall is better, and its threshold is 0.01. A metric without a direction has no tail.
  EXPECT_THAT(TailOf({10.5, 9.5}, "recall"), ElementsAre(1));
  EXPECT_THAT(TailOf({100.0, -100.0}, "fuzzy_distance"), IsEmpty());
}

TEST(Tail, HoldsLostValuesBeforeAllOthersAndNoGainedOnes) {
  MoveColumns columns = Columns({10 + 9 * kFar, std::nullopt, 10.0});
  columns.before[2] = std::nullopt;
  const auto tail = FindTail(columns, *FindGateMetric("position_error_cm"), kRule);
  EXPECT_THAT(TrialsOf(tail), ElementsAre(1, 0));
  EXPECT_TRUE(tail[0].lost);
  EXPECT_FALSE(tail[1].lost);
  EXPECT_THAT(TailOf({std::nullopt}, "fuzzy_distance"), ElementsAre(0));  // lost even without a direction
}

TEST(Tail, LeavesOutWorldsThatAreNotCompared) {
  MoveColumns columns = Columns({10 + 9 * kFar, std::nullopt});
  columns.compared = {false, false};
  EXPECT_THAT(FindTail(columns, *FindGateMetric("position_error_cm"), kRule), IsEmpty());
}

TEST(Tail, TellsACellThatHasNoAnswerAnyMoreFromOneThatIsUnsolved) {
  MoveColumns columns = Columns({0.0, 0.0, 0.0, 0.0, 1.0});
  columns.before.assign(5, 1.0);
  columns.before[3] = 0.0;
  columns.ended_before = "oooufo";
  columns.ended_after = "ufbfo";
  const auto tail = FindTail(columns, *FindGateMetric(kOkShare), kRule);
  EXPECT_THAT(TrialsOf(tail), ElementsAre(1, 2, 0));
  EXPECT_TRUE(tail[0].lost && tail[1].lost);
  EXPECT_FALSE(tail[2].lost);  // kUnsolved is an answer, so its value is not lost
}

TEST(Tail, IsARegressionFromSoManyWorldsOn) {
  const auto fails = [](int far, int lost, const TailRule& rule = kRule) {
    std::vector<TailWorld> tail(static_cast<std::size_t>(far + lost));
    for (int i = 0; i < lost; ++i) tail[static_cast<std::size_t>(i)].lost = true;
    return IsTailRegression(tail, 1000, rule);
  };
  EXPECT_FALSE(fails(0, 0));
  EXPECT_FALSE(fails(2, 0));
  EXPECT_TRUE(fails(3, 0));
  EXPECT_TRUE(fails(0, 1));
  EXPECT_FALSE(fails(1, 1, {20, 3, 0, 2}));
  EXPECT_TRUE(fails(2, 1, {20, 3, 0, 2}));  // a lost world also counts as far worse
  EXPECT_FALSE(fails(24, 0, {20, 0, 0, 1}));
  EXPECT_FALSE(fails(24, 24, {20, 0, 0, 0}));
}

TEST(Tail, IsNotJudgedByARuleThatIsOff) {
  const auto is_judged = [](bool lost, const TailRule& rule) {
    MetricMove move;
    move.worlds = 1000;
    move.tail = {{.trial = 0, .lost = false}, {.trial = 1, .lost = lost}};
    JudgeTail(move, rule);
    EXPECT_EQ(move.movement, Movement::kSame);
    return move.is_tail_judged;
  };
  EXPECT_TRUE(is_judged(false, {20, 3, 0, 0}));
  EXPECT_FALSE(is_judged(false, {20, 0, 0, 0}));
  EXPECT_FALSE(is_judged(true, {20, 0, 0, 0}));
  EXPECT_FALSE(is_judged(false, {20, 0, 0, 2})) << "nothing was lost, and only lost values are judged";
  EXPECT_TRUE(is_judged(true, {20, 0, 0, 2}));
}

TEST(Tail, MustBeAShareOfManyWorldsToo) {
  const TailRule rule{.times = 20, .worlds = 3, .share = 0.02, .lost = 0};
  for (const auto& [compared, needed] :
       {std::pair{1, 1}, {2, 2}, {3, 3}, {5, 3}, {30, 3}, {150, 3}, {151, 4}, {1000, 20}}) {
    EXPECT_EQ(WorldsThatFail(compared, rule), needed);
    const auto few = static_cast<std::size_t>(needed) - 1;
    EXPECT_FALSE(IsTailRegression(std::vector<TailWorld>(few), compared, rule));
    EXPECT_TRUE(IsTailRegression(std::vector<TailWorld>(few + 1), compared, rule));
  }
  EXPECT_EQ(WorldsThatFail(1000, {.worlds = 0}), 0);
}

/// Returns the gate's report on thirty worlds, of which `far` are 60° worse. The population test alone lets this pass.
GateReport ThirtyWorlds(int far, const std::string& rules = "") {
  const std::string more = "metrics: [orientation_error_deg]\n" + rules;
  const auto run = [&](int worse) {
    return ExampleRun(
        [=](int trial, const std::string& method) {
          CellResult result = CellResult::Ended(Status::kOk, "");
          result.Measure("orientation_error_deg", 1 + 0.01 * trial + (method == "a" && trial < worse ? 60 : 0));
          return result;
        },
        {.trials = 30, .extra = more});
  };
  const Snapshot baseline = TakeSnapshot(run(0));
  const auto report = JudgeRun(run(far), &baseline, "b.json");
  EXPECT_TRUE(report) << ToString(report.error());
  return *report;
}

const MetricMove& FirstOf(const GateReport& report, std::string_view metric) {
  return *std::ranges::find_if(report.comparison.moves,
                               [&](const MetricMove& move) { return move.identity.metric == metric; });
}

TEST(GateOfThirtyWorlds, FailsWhereFiveAreWorseBySixtyDegrees) {
  const GateReport report = ThirtyWorlds(5);
  EXPECT_EQ(GateVerdictOf(report), GateVerdict::kRegressed);
  const MetricMove& move = FirstOf(report, "orientation_error_deg");
  EXPECT_EQ(move.movement, Movement::kWorse);
  EXPECT_TRUE(move.by_tail);
  EXPECT_THAT(move.tail, SizeIs(5));
  // The control: without the tail rule the gate passes.
  const GateReport without = ThirtyWorlds(5, "gate: {tail: {worlds: 0}}\n");
  EXPECT_EQ(GateVerdictOf(without), GateVerdict::kPassed);
  EXPECT_EQ(FirstOf(without, "orientation_error_deg").movement, Movement::kUndecided);
}

TEST(GateOfThirtyWorlds, FollowsTheKeysOfItsScenario) {
  EXPECT_EQ(GateVerdictOf(ThirtyWorlds(1)), GateVerdict::kPassed);
  EXPECT_THAT(FirstOf(ThirtyWorlds(1), "orientation_error_deg").tail, SizeIs(1));  // the tail is still reported
  EXPECT_EQ(GateVerdictOf(ThirtyWorlds(1, "gate: {tail: {worlds: 1, share: 0}}\n")), GateVerdict::kRegressed);
  EXPECT_EQ(GateVerdictOf(ThirtyWorlds(5, "gate: {tail: {worlds: 6}}\n")), GateVerdict::kPassed);
  EXPECT_EQ(GateVerdictOf(ThirtyWorlds(5, "gate: {tail: {times: 599}}\n")), GateVerdict::kRegressed);  // 0.1° matters
  EXPECT_EQ(GateVerdictOf(ThirtyWorlds(5, "gate: {tail: {times: 601}}\n")), GateVerdict::kPassed);
}

TEST(MeasureMove, IsTheSameForAMethodOfAnotherName) {
  std::vector<std::optional<double>> after;
  for (int i = 0; i < 40; ++i) after.emplace_back(10 + 0.01 * ((i * i * 7) % 31) - 0.12);
  const auto measure = [&](const std::string& method) {
    return MeasureMove({"s", "", method, "position_error_cm"}, Columns(after), 1).comparison;
  };
  const Comparison a = measure("a"), b = measure("another-name");
  ASSERT_EQ(a.sign_flip.how, "9,999 draws") << "the test must draw random numbers";
  EXPECT_EQ(a.sign_flip.p, b.sign_flip.p);
  EXPECT_EQ(a.ci_low, b.ci_low);
  EXPECT_EQ(a.ci_high, b.ci_high);
}

}  // namespace
}  // namespace etude

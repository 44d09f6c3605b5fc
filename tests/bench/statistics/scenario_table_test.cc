#include "bench/scenario/study_of.h"
#include "bench/statistics/scenario_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/scenario/scenario.h"
#include "bench/statistics/summary.h"
#include "tests/bench/scenario/parse.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr const char* kRivalYaml = R"(
scenario: s
question: which?
task: ik
trials: 12
methods: [{name: a}, {name: b}, {name: c}, {name: seen, against: seen}]
metrics: [position_error_cm, iterations]
)";

using Errors = std::function<double(const std::string& method, int trial)>;

ScenarioTable TableOf(const Study& study, const Errors& errors) {
  ScenarioTable table(study);
  for (int trial = 0; trial < study.trials; ++trial) {
    for (const ComparedMethod& method : study.methods) {
      Row row{"s", "ik", {}, trial, "", {}, method.name, {}};
      row.result = CellResult::Ended(Status::kOk, "");
      row.result.Measure("position_error_cm", errors(method.name, trial));
      row.result.Measure("iterations", method.name == "c" ? 2 : 20);
      table.Add(row);
    }
  }
  return table;
}

std::string RivalOf(const Study& study, const ScenarioTable& table, const std::string& method) {
  const auto entry = std::ranges::find(study.methods, method, &ComparedMethod::name);
  const auto rival = FindRival(study, table.conditions()[0], *entry);
  return rival ? rival->Name() : "";
}

TEST(FindRival, TakesTheBestOtherMethodThatCompetes) {
  const Study study = StudyOf(ParseOne(kRivalYaml));
  const ScenarioTable table = TableOf(study, [](const std::string& method, int) {
    return method == "seen" ? 0.0 : method == "a" ? 9.0 : method == "b" ? 3.0 : 6.0;
  });
  EXPECT_EQ(RivalOf(study, table, "a"), "b");
  EXPECT_EQ(RivalOf(study, table, "b"), "c");
  EXPECT_FALSE(Competes(study, study.methods[3])) << "a yardstick";
  EXPECT_EQ(RivalOf(study, table, "seen"), "");
}

TEST(FindRival, IsNeverTheBaseline) {
  // a is the baseline and is best in half of the worlds. If it could also be a rival, b would be compared with a twice.
  const Study study = StudyOf(ParseOne(kRivalYaml));
  const ScenarioTable table = TableOf(study, [](const std::string& method, int trial) {
    if (method == "c") return 5.0;
    return method == "b" ? 3.0 : trial % 2 == 0 ? 1.0 : 9.0;
  });
  EXPECT_EQ(RivalOf(study, table, "b"), "c");
  EXPECT_EQ(RivalOf(study, table, "c"), "b");
  EXPECT_EQ(RivalOf(study, table, "a"), "b");
  const ScenarioSummary summary = Summarise(study, table, 1);
  for (const Comparison& comparison : summary.conditions[0].comparisons) EXPECT_EQ(comparison.baseline, "a");
  for (const Comparison& comparison : summary.conditions[0].rivals) {
    EXPECT_EQ(comparison.baseline, comparison.method == "b" ? "c" : "b");
    EXPECT_TRUE(comparison.notes.empty()) << "no halves";
  }
}

TEST(FindRival, OfAMethodThatHasNoOtherThanItsBaselineIsNone) {
  const Study study = StudyOf(ParseOne(R"(
scenario: s
question: which?
task: ik
trials: 12
methods: [{name: a}, {name: b}]
metrics: [position_error_cm]
)"));
  const ScenarioTable table = TableOf(study, [](const std::string& method, int) { return method == "a" ? 9.0 : 3.0; });
  EXPECT_EQ(RivalOf(study, table, "b"), "");
  EXPECT_EQ(RivalOf(study, table, "a"), "b") << "the first has no baseline";
  const ScenarioSummary summary = Summarise(study, table, 1);
  EXPECT_EQ(summary.conditions[0].rivals.size(), 1u);
}

TEST(FindRival, IsNoneWhereAHalfHasNoWorldToChooseOn) {
  std::string yaml = kRivalYaml;
  yaml.replace(yaml.find("trials: "), std::string("trials: ").size() + 1, "trials: 1 #");
  const Study study = StudyOf(ParseOne(yaml));
  const ScenarioTable table = TableOf(study, [](const std::string& method, int) { return method == "a" ? 9.0 : 3.0; });
  EXPECT_EQ(RivalOf(study, table, "b"), "");
  EXPECT_TRUE(Summarise(study, table, 1).conditions[0].rivals.empty());
}

TEST(FindRival, AsksTheNextMetricOfWhatTheFirstDoesNotTellApart) {
  const Study study = StudyOf(ParseOne(kRivalYaml));
  const ScenarioTable table = TableOf(study, [](const std::string& method, int) {
    return method == "a" ? 9.0 : method == "b" ? 3.0 : 3.001;
  });
  EXPECT_EQ(RivalOf(study, table, "a"), "c") << "a tenth of b's steps";
}

TEST(FindRival, ChoosesOnOtherWorldsThanThoseItIsJudgedOn) {
  // Choosing the rival on the judged worlds would reward luck. b is best in even trials and c in odd trials, so the
  // rival of even trials, which is chosen on odd trials, is c, and the rival of odd trials is b.
  const Study study = StudyOf(ParseOne(kRivalYaml));
  const ScenarioTable table = TableOf(study, [](const std::string& method, int trial) {
    if (method == "a") return 5.0;
    return (method == "b") == (trial % 2 == 0) ? 1.0 : 9.0;
  });
  const ConditionTable& condition = table.conditions()[0];
  ASSERT_OK(rival, FindRival(study, condition, study.methods[0]));
  EXPECT_EQ(rival->Name(), "c or b");
  EXPECT_THAT(rival->Note(), ::testing::HasSubstr("was chosen on the other half"));
  const PairedWorlds worlds = WorldsAgainst(*rival, condition, "a", "position_error_cm");
  ASSERT_EQ(worlds.pairs.size(), 12u);
  for (const Pair& pair : worlds.pairs) EXPECT_EQ(pair.baseline, 9);
}

TEST(FindRival, IsTheScenariosOwnWhereItNamesOne) {
  const Study study = StudyOf(ParseOne(std::string(kRivalYaml) + "rival: a\n"));
  const ScenarioTable table = TableOf(study, [](const std::string&, int) { return 1.0; });
  EXPECT_EQ(RivalOf(study, table, "c"), "a");
  EXPECT_EQ(RivalOf(study, table, "a"), "");
  const ScenarioSummary summary = Summarise(study, table, 1);
  ASSERT_EQ(summary.conditions[0].rivals.size(), 4u) << "b and c, by two metrics";
  EXPECT_EQ(summary.conditions[0].rivals[0].baseline, "a");
}

TEST(FindRival, LetsNoMethodWinByFailing) {
  const Study study = StudyOf(ParseOne(kRivalYaml));
  ScenarioTable table(study);
  for (int trial = 0; trial < study.trials; ++trial) {
    for (const char* method : {"a", "b", "c"}) {
      Row row{"s", "ik", {}, trial, "", {}, method, {}};
      const bool fails = *method == 'c' && trial % 4 != 0;  // c answers easy worlds only
      row.result = CellResult::Ended(fails ? Status::kFailed : Status::kOk, "");
      if (!fails) row.result.Measure("position_error_cm", *method == 'a' ? 9 : *method == 'b' ? 3 : 1);
      table.Add(row);
    }
  }
  EXPECT_EQ(RivalOf(study, table, "a"), "b");
}

}  // namespace
}  // namespace etude

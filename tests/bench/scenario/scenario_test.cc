#include <nlohmann/json.hpp>

#include "bench/metrics/catalogue.h"
#include "bench/results/row_json.h"
#include "bench/scenario/study_of.h"
#include "bench/tasks/registry.h"
#include "tests/bench/scenario/parse.h"
#include "tests/support/kept_answers.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Scenario, ComparesEachMethodWithTheFirstOrTheOneItNames) {
  const Scenario scenario =
      ParseOne(kHead + "methods: [{name: a, against: c}, {name: b}, {name: c, against: b, solver: ccd}]\n");
  ASSERT_EQ(MethodNames(scenario), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(scenario.methods[0].against, "c");
  EXPECT_EQ(scenario.methods[1].against, "a");
  EXPECT_EQ(scenario.methods[2].against, "b");
  EXPECT_EQ(scenario.methods[2].node.Find("against"), nullptr);
  EXPECT_EQ(scenario.methods[2].node.Find("solver")->scalar, "ccd");
}

TEST(Scenario, TakesTheTasksMetricsWhenItsOwnListIsEmpty) {
  const Scenario scenario = ParseOne(kHead + kMethods + "metrics: []\ngate: {metrics: []}\n");
  EXPECT_GT(scenario.metrics.size(), 2u);
  EXPECT_EQ(scenario.gate.metrics, scenario.metrics);
}

TEST(Scenario, TakesAnotherProgramForAMethod) {
  const Scenario scenario =
      ParseOne(kHead +
               "methods:\n"
               "  - {name: a}\n"
               "  - {name: b, exec: [python3, my solver.py], time_s: 2.5, against: b,\n"
               "     options: {rate: 0.5, steps: 5, loud: true, name: x, list: [1, '2', ~], deep: {a: 1e3}}}\n");
  ASSERT_EQ(scenario.methods.size(), 2u);
  EXPECT_TRUE(scenario.methods[0].exec.empty());
  EXPECT_EQ(scenario.methods[0].time_s, std::nullopt);
  EXPECT_THAT(scenario.methods[1].exec, ElementsAre("python3", "my solver.py"));
  EXPECT_EQ(scenario.methods[1].time_s, 2.5);
  // A document stores texts only: a text that reads as a number is a number, with or without quotes.
  EXPECT_EQ(scenario.methods[1].options_json,
            R"({"rate":0.5,"steps":5,"loud":true,"name":"x","list":[1,2,null],"deep":{"a":1000.0}})");
}

TEST(Scenario, ReadsLimitsAndWhatTheGateHoldsAgainstABaseline) {
  const Scenario plain = ParseOne(kHead + kMethods + "metrics: [iterations]\n");
  EXPECT_EQ(plain.limits.time_s, 300);
  EXPECT_EQ(plain.limits.memory_mb, 4096);
  EXPECT_THAT(plain.gate.metrics, ElementsAre("solved_practical", "iterations")) << "success first";
  EXPECT_FALSE(plain.gate.exact);
  EXPECT_EQ(plain.gate.tail.worlds, TailRule{}.worlds);
  const Scenario scenario = ParseOne(kHead + kMethods +
                                     "limits: {time_s: 1.5, memory_mb: 100}\n"
                                     "gate: {metrics: [position_error_cm], rule: threshold,\n"
                                     "       time_ratios: [{of: b, over: a, at_most: 1.2}, {of: a, over: b}],\n"
                                     "       tail: {times: 7.5, worlds: 2, share: 0.1, lost: 0}}\n");
  EXPECT_EQ(scenario.gate.tail.times, 7.5);
  EXPECT_EQ(scenario.gate.tail.worlds, 2);
  EXPECT_EQ(scenario.gate.tail.share, 0.1);
  EXPECT_EQ(scenario.gate.tail.lost, 0);
  EXPECT_EQ(scenario.limits.time_s, 1.5);
  EXPECT_EQ(scenario.limits.memory_mb, 100);
  EXPECT_THAT(scenario.gate.metrics, ElementsAre("position_error_cm"));
  EXPECT_FALSE(scenario.gate.exact);
  EXPECT_TRUE(ParseOne(kHead + kMethods + "gate: {rule: exact}\n").gate.exact);
  ASSERT_EQ(scenario.gate.time_ratios.size(), 2u);
  EXPECT_EQ(scenario.gate.time_ratios[0].of, "b");
  EXPECT_EQ(scenario.gate.time_ratios[0].over, "a");
  EXPECT_EQ(scenario.gate.time_ratios[0].at_most, 1.2);
  EXPECT_EQ(scenario.gate.time_ratios[1].at_most, 1);
  EXPECT_EQ(ToString(scenario.gate.time_ratios[0].place), "s.yaml:7:22");
}

TEST(Scenario, RefusesBoundsThatAShareCannotReach) {
  const auto bounded = [](const std::string& metric, const std::string& bound) {
    return Complaint(kHead + kMethods + "expect: [{metric: " + metric + ", of: b, statistic: mean, " + bound + "}]\n");
  };
  for (const char* bound : {"at_least: 90", "at_most: 90", "at_most: -1", "at_least: -1"}) {
    EXPECT_THAT(bounded("solved_practical", bound), HasSubstr("allowed for the metric 'solved_practical': 0 to 1"));
    EXPECT_EQ(bounded("iterations", bound), "");
  }
  EXPECT_EQ(bounded("solved_practical", "at_most: 0"), "");
  EXPECT_EQ(bounded("solved_practical", "at_least: 1"), "");
}

TEST(Scenario, RefusesAssumptionsThatAreNotSwept) {
  EXPECT_THAT(Complaint(kHead + kMethods + "across: [joint_noise_deg]\n"), HasSubstr("this scenario has no sweep"));
}

TEST(Scenario, RefusesAUnitBesideAShare) {
  const auto own = [](const std::string& keys) {
    return Complaint(kHead + kMethods + "metrics: [{name: with_a_unit, exec: [./m], " + keys + "}]\n");
  };
  EXPECT_THAT(own("reads: share, unit: pp"), HasSubstr("'unit'; this key is allowed with reads: amount"));
  EXPECT_EQ(own("reads: amount, unit: mm"), "");
}

TEST(Scenario, RefusesASeedThatADoubleDoesNotHold) {
  const auto seeded = [](const std::string& seed) { return Complaint(kHead + kMethods + "seed: " + seed + "\n"); };
  EXPECT_EQ(seeded("9007199254740992"), "");
  EXPECT_EQ(seeded("0010"), "");
  for (const char* seed : {"9007199254740993", "9007199254740994"}) {
    EXPECT_THAT(seeded(seed), HasSubstr(std::string(seed) + " is out of range; allowed: 0 to 9007199254740992"));
  }
}

TEST(Scenario, NamesWhatSuccessIsOrTakesTheTasks) {
  const Scenario plain = ParseOne(kHead + kMethods);
  EXPECT_EQ(plain.success, "solved_practical");
  EXPECT_EQ(plain.success_matters, 0.05);
  const Study study = StudyOf(ParseOne(kHead + kMethods + "success: {metric: solved_tight, matters: 0.1}\n"));
  EXPECT_EQ(study.success, "solved_tight");
  EXPECT_EQ(study.success_matters, 0.1);
  EXPECT_EQ(ParseOne(kHead + kMethods + "success: {matters: 0.02}\n").success, "solved_practical");
}

TEST(Scenario, RefusesAMetricWithTheNameOfAKeyOfRows) {
  Row row{"s", "ik", {}, 0, "", {"a unit"}, "a", CellResult::Ended(Status::kOk, "")};
  row.result.Missing("position_error_cm", "none");
  row.result.judged.parts = {"head"};
  const Json json = EncodeRow(row);
  EXPECT_TRUE(json.contains("judged") && json.contains("units") && json.contains("null_reasons"));
  for (const auto& [key, value] : json.items()) {
    if (key == "position_error_cm") continue;
    EXPECT_THAT(Complaint(kHead + kMethods + "metrics: [{name: " + key + ", exec: [x]}]\n"),
                HasSubstr("'" + key + "' is a key of every row of results; choose another name for the metric"));
  }
}

TEST(Scenario, OfEveryTaskHasASuccessThatItsCellsReport) {
  for (const TaskKind& kind : AllTaskKinds()) {
    const MetricInfo* success = FindMetric(kind.success);
    ASSERT_NE(success, nullptr) << kind.name;
    EXPECT_TRUE(success->is_success) << kind.name;
    EXPECT_EQ(success->direction, Direction::kHigherIsBetter) << kind.name;
    EXPECT_EQ(success->aggregate, Aggregate::kMean) << kind.name;
    const bool reported = kind.metrics.empty() || std::ranges::find(kind.metrics, kind.success) != kind.metrics.end();
    EXPECT_TRUE(reported) << kind.name;
  }
}

TEST(Scenario, SurvivesEveryTruncationAndManyMutations) {
  const std::string good =
      kHead +
      "trials: 3\n"
      "sweep: {noise: [gaussian, uniform], max_sweeps: {from: 1, to: 9, count: 3},\n"
      "        together: {poses: [0.5, 1], joint_noise_deg: [5, 15]}}\n"
      "methods:\n"
      "  - {name: a, solver: ccd}\n"
      "  - {name: b, exec: [python3, x.py], options: {n: 1, t: ['2', no]}, time_s: 2, against: a}\n"
      "expect: [{metric: iterations, of: a, below: b, where: {noise: uniform}}]\n"
      "gate: {metrics: [iterations], rule: exact, time_ratios: [{of: a, over: b, at_most: 2}]}\n"
      "limits: {time_s: 5, memory_mb: 64}\n"
      "video: {compare: [a], trials: [0]}\n";
  EXPECT_EQ(Complaint(good), "");
  int refused = 0;
  const auto check = [&](const std::string& text) {
    const std::string complaint = Complaint(text);
    if (complaint.empty()) return;
    EXPECT_THAT(complaint, ::testing::StartsWith("s.yaml:"));
    ++refused;
  };
  for (std::size_t length = 0; length < good.size(); ++length) check(good.substr(0, length));
  const std::string spoilers = "*{]:\n-9\xff";
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = spoilers[at % spoilers.size()];
    check(bad);
  }
  EXPECT_GT(refused, 700);
}

// Each error message gives file, line and column, the value found, and the allowed values.
TEST(Scenario, TellsWhatIsWrongAndWhere) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/scenario/complaints.txt", [](std::string text) {
    // " | NAME: TEXT" adds a further file. A text that includes other files is otherwise a complete scenario.
    SourceTexts more;
    for (std::size_t bar; (bar = text.rfind(" | ")) != std::string::npos; text.erase(bar)) {
      const std::size_t colon = text.find(": ", bar);
      more[text.substr(bar + 3, colon - bar - 3)] = text.substr(colon + 2);
    }
    const std::string complaint = Complaint(more.empty() ? text : text + "\n" + kHead + kMethods, more);
    return complaint.empty() ? "accepted" : complaint;
  }));
}

}  // namespace
}  // namespace etude

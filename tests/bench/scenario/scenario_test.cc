#include "bench/metrics/catalogue.h"
#include "bench/tasks/registry.h"
#include "tests/bench/scenario/parse.h"

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
  EXPECT_THAT(Complaint(kHead + "methods: [{name: a}, {name: b, against: d}]\n"),
              HasSubstr("s.yaml:4:41: unknown against 'd'"));
}

TEST(Scenario, TellsWhatIsWrongAndWhere) {
  EXPECT_THAT(Complaint("question: q?\ntask: ik\n" + kMethods), HasSubstr("a scenario needs 'scenario'"));
  EXPECT_THAT(Complaint("scenario: ../x\n" + kMethods), HasSubstr("s.yaml:1:11: '../x' is not a valid scenario"));
  EXPECT_THAT(
      Complaint("scenario: s\nquestion: q?\ntask: ikk\n" + kMethods),
      HasSubstr(
          "s.yaml:3:7: unknown task 'ikk'; did you mean 'ik'? Allowed: transition, detection, ik, tracking, capture, "
          "pose-distance"));
  EXPECT_THAT(Complaint(kHead), HasSubstr("a scenario needs 'methods'"));
  EXPECT_THAT(Complaint(kHead + "methods: [{solver: ccd}]\n"),
              HasSubstr("s.yaml:4:11: a method of task ik needs 'name'"));
  EXPECT_THAT(Complaint(kHead + "methods: [{name: a}, {name: a}]\n"), HasSubstr("two methods are named 'a'"));
  EXPECT_THAT(Complaint(kHead + kMethods + "trials: 0\n"), HasSubstr("s.yaml:5:9: 'trials': 0 is out of range"));
  EXPECT_THAT(
      Complaint(kHead + kMethods + "metrics: [position_eror_cm]\n"),
      HasSubstr("s.yaml:5:11: unknown metric of task ik 'position_eror_cm'; did you mean 'position_error_cm'?"));
  EXPECT_THAT(Complaint(kHead + kMethods + "metrics: [iterations, iterations]\n"),
              HasSubstr("s.yaml:5:23: the metric 'iterations' is listed twice"));
  EXPECT_THAT(Complaint(kHead + kMethods + "max_swaps: 5\n"),
              HasSubstr("s.yaml:5:1: unknown key of a scenario 'max_swaps'; did you mean 'max_sweeps'?"));
}

TEST(Scenario, TakesTheTasksMetricsWhenItsOwnListIsEmpty) {
  const Scenario scenario = ParseOne(kHead + kMethods + "metrics: []\ngate: {metrics: []}\n");
  EXPECT_GT(scenario.metrics.size(), 2u);
  EXPECT_EQ(scenario.gate.metrics, scenario.metrics);
}

TEST(Scenario, KnowsTheKeysOfItsMethods) {
  const auto complaint = [](const std::string& method) {
    return Complaint(kHead + "methods: [{name: a, " + method + "}]\n");
  };
  EXPECT_THAT(complaint("solvr: ccd"),
              HasSubstr("s.yaml:4:21: unknown key of a method of task ik 'solvr'; did you mean 'solver'?"));
  EXPECT_THAT(complaint("agianst: a"), HasSubstr("did you mean 'against'?"));
  EXPECT_THAT(complaint("exce: [x]"), HasSubstr("did you mean 'exec'?"));
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
  // A document keeps texts only: what reads as a number is one, quotes or not.
  EXPECT_EQ(scenario.methods[1].options_json,
            R"({"rate":0.5,"steps":5,"loud":true,"name":"x","list":[1,2,null],"deep":{"a":1000.0}})");
}

TEST(Scenario, TellsWhatIsWrongWithAnotherProgram) {
  const auto complaint = [](const std::string& keys) {
    return Complaint(kHead + "methods: [{name: a, " + keys + "}]\n");
  };
  EXPECT_THAT(complaint("exec: []"), HasSubstr("s.yaml:4:27: 'exec' needs a program and its arguments"));
  EXPECT_THAT(complaint("exec: ['']"), HasSubstr("'exec' needs a program"));
  EXPECT_THAT(complaint("exec: python3"), HasSubstr("'exec': expected a list, found 'python3'"));
  EXPECT_THAT(complaint("exec: [x], solver: ccd"), HasSubstr("unknown key of a method with 'exec' 'solver'"));
  EXPECT_THAT(complaint("exec: [x], options: [1]"), HasSubstr("'options' must be a mapping"));
  EXPECT_THAT(complaint("exec: [x], options: {a: \"\\xff\"}"), ::testing::Eq(""));  // an escape gives a character
  EXPECT_THAT(complaint("exec: [x], time_s: 0"), HasSubstr("'time_s': 0 is out of range"));
  EXPECT_THAT(complaint("options: {a: 1}"), HasSubstr("s.yaml:4:30: 'options' is only for methods with 'exec'"));
  EXPECT_THAT(complaint("time_s: 1"), HasSubstr("'time_s' is only for methods with 'exec'"));
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
                                     "gate: {metrics: [position_error_cm], rule: exact,\n"
                                     "       time_ratios: [{of: b, over: a, at_most: 1.2}, {of: a, over: b}],\n"
                                     "       tail: {times: 7.5, worlds: 2, share: 0.1, lost: 0}}\n");
  EXPECT_EQ(scenario.gate.tail.times, 7.5);
  EXPECT_EQ(scenario.gate.tail.worlds, 2);
  EXPECT_EQ(scenario.gate.tail.share, 0.1);
  EXPECT_EQ(scenario.gate.tail.lost, 0);
  EXPECT_EQ(scenario.limits.time_s, 1.5);
  EXPECT_EQ(scenario.limits.memory_mb, 100);
  EXPECT_THAT(scenario.gate.metrics, ElementsAre("position_error_cm"));
  EXPECT_TRUE(scenario.gate.exact);
  ASSERT_EQ(scenario.gate.time_ratios.size(), 2u);
  EXPECT_EQ(scenario.gate.time_ratios[0].of, "b");
  EXPECT_EQ(scenario.gate.time_ratios[0].over, "a");
  EXPECT_EQ(scenario.gate.time_ratios[0].at_most, 1.2);
  EXPECT_EQ(scenario.gate.time_ratios[1].at_most, 1);
  EXPECT_EQ(ToString(scenario.gate.time_ratios[0].place), "s.yaml:7:22");
}

TEST(Scenario, TellsWhatIsWrongWithLimitsAndTheGate) {
  const auto complaint = [](const std::string& line) { return Complaint(kHead + kMethods + line + "\n"); };
  EXPECT_THAT(complaint("limits: {time: 5}"), HasSubstr("unknown key of 'limits' 'time'; did you mean 'time_s'?"));
  EXPECT_THAT(complaint("limits: {time_s: 0}"), HasSubstr("s.yaml:5:18: 'time_s': 0 is out of range"));
  EXPECT_THAT(complaint("limits: {memory_mb: 1}"), HasSubstr("allowed: 16 to 1048576"));
  EXPECT_THAT(complaint("limits: 5"), HasSubstr("'limits' must be a mapping"));
  EXPECT_THAT(complaint("gate: {rules: exact}"), HasSubstr("unknown key of 'gate' 'rules'; did you mean 'rule'?"));
  EXPECT_THAT(complaint("gate: {rule: exactly}"), HasSubstr("unknown rule 'exactly'; did you mean 'exact'?"));
  EXPECT_THAT(complaint("gate: {metrics: [iteration]}"), HasSubstr("s.yaml:5:18: unknown metric of task ik"));
  EXPECT_THAT(complaint("gate: {time_ratios: {of: a}}"), HasSubstr("'time_ratios' must be a list, found a mapping"));
  EXPECT_THAT(complaint("gate: {time_ratios: [{of: a}]}"), HasSubstr("s.yaml:5:22: a time ratio needs 'over'"));
  EXPECT_THAT(complaint("gate: {time_ratios: [{of: a, over: a}]}"), HasSubstr("needs two methods"));
  EXPECT_THAT(complaint("gate: {time_ratios: [{of: a, over: c}]}"), HasSubstr("s.yaml:5:36: unknown over 'c'"));
  EXPECT_THAT(complaint("gate: {time_ratios: [{of: a, over: b, at_most: 0}]}"), HasSubstr("'at_most': 0 is out of"));
}

TEST(Scenario, NamesWhatSuccessIsOrTakesTheTasks) {
  const Scenario plain = ParseOne(kHead + kMethods);
  EXPECT_EQ(plain.success, "solved_practical");
  EXPECT_EQ(plain.success_matters, 0.05);
  const Study study = StudyOf(ParseOne(kHead + kMethods + "success: {metric: solved_tight, matters: 0.1}\n"));
  EXPECT_EQ(study.success, "solved_tight");
  EXPECT_EQ(study.success_matters, 0.1);
  EXPECT_EQ(ParseOne(kHead + kMethods + "success: {matters: 0.02}\n").success, "solved_practical");
  const auto complaint = [](const std::string& line) { return Complaint(kHead + kMethods + line + "\n"); };
  EXPECT_THAT(complaint("success: {metric: iterations}"), HasSubstr("s.yaml:5:19: unknown metric 'iterations'"));
  EXPECT_THAT(complaint("success: {metric: solved_tigt}"), HasSubstr("did you mean 'solved_tight'?"));
  EXPECT_THAT(complaint("success: {matters: 5}"), HasSubstr("s.yaml:5:20: 'matters': 5 is out of range"));
  EXPECT_THAT(complaint("success: solved_tight"), HasSubstr("s.yaml:5:10: 'success' must be a mapping"));
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

TEST(Scenario, TellsWhatIsWrongWithAnExpectation) {
  const auto complaint = [](const std::string& expectation) {
    return Complaint(kHead + kMethods + "expect:\n  - " + expectation + "\n");
  };
  EXPECT_EQ(complaint("{metric: position_error_cm, of: a, below: b}"), "");
  EXPECT_THAT(complaint("{metric: position_error_cm, of: c, below: b}"), HasSubstr("s.yaml:6:37: unknown of 'c'"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, below: a}"), HasSubstr("differ from itself"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a}"), HasSubstr("exactly one of: below, above"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, below: b, at_most: 1}"), HasSubstr("found 2"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, belw: b}"), HasSubstr("did you mean 'below'?"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, below: b, where: {x: 1}}"),
              HasSubstr("this scenario sweeps none"));
  EXPECT_THAT(Complaint(kHead + kMethods +
                        "sweep: {poses: [0.5, 1]}\n"
                        "expect: [{metric: iterations, of: a, below: b, where: {pose: 1}}]\n"),
              HasSubstr("s.yaml:6:56: unknown condition 'pose: 1'; did you mean 'poses: 1'?"));
  EXPECT_THAT(Complaint(kHead + kMethods +
                        "sweep: {together: {poses: [0.5, 1], max_sweeps: [10, 20]}}\n"
                        "expect: [{metric: iterations, of: a, below: b, where: {poses: 1, max_sweeps: 10}}]\n"),
              HasSubstr("s.yaml:6:55: no condition has poses=1, max_sweeps=10"));
}

TEST(Scenario, RefusesFractionsWhereOnlyWholeNumbersMeanSomething) {
  EXPECT_THAT(Complaint(kHead + kMethods + "seed: 1.5\n"), HasSubstr("s.yaml:5:7: 'seed' must be a whole number"));
  EXPECT_THAT(Complaint(kHead + kMethods + "video: {trials: [0.5]}\n"), HasSubstr("must be whole numbers"));
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

}  // namespace
}  // namespace etude

#include "bench/scenario/keys.h"
#include "bench/tasks/registry.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "io/clips/clip_library.h"
#include "tests/bench/scenario/parse.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::ElementsAreArray;

struct Defaults {
  std::string text;  ///< "key: value, …"
  int count = 0;
};

/// Writes out the defaults of all keys that have one, except those that `chosen` already sets.
Defaults WriteOut(const std::vector<KeyInfo>& keys, const std::string& chosen) {
  Defaults defaults{chosen};
  const auto mapping = ParseYaml("{" + chosen + "}", "chosen.yaml");
  EXPECT_TRUE(mapping) << chosen;
  for (const KeyInfo& key : keys) {
    if (!key.HasDefaultValue() || mapping->Find(key.key) != nullptr || !MayStand(key, keys, *mapping)) continue;
    defaults.text += (defaults.text.empty() ? "" : ", ") + key.key + ": " + key.fallback;
    ++defaults.count;
  }
  return defaults;
}

std::vector<std::string> CellOf(const TaskKind& kind, const std::string& condition, const std::string& method,
                                const ClipLibrary& clips) {
  const auto mapping = ParseYaml("{" + condition + "}", "s.yaml");
  const auto entry = ParseYaml("{name: a" + (method.empty() ? "" : ", " + method) + "}", "s.yaml");
  EXPECT_TRUE(mapping && entry) << condition << " / " << method;
  Fields fields(*mapping, "a condition");
  TaskInput input{fields, std::span(&*entry, 1), clips};
  const auto task = kind.make(input);
  EXPECT_TRUE(task) << ToString(task.error());
  if (!task) return {};
  const auto done = fields.Finish();
  EXPECT_TRUE(done) << ToString(done.error());
  std::vector<std::string> said;
  for (const CellResult& cell : RunWorld(**task, {1, "defaults", 0}, 1)) {
    said.push_back(std::string(StatusName(cell.status)) + " " + cell.reason);
    for (const MetricValue& metric : cell.metrics) {
      said.push_back(fmt::format("{} {}", metric.id, metric.value ? fmt::format("{}", *metric.value) : "-"));
    }
    for (const auto& [stage, digest] : cell.digests) said.push_back(stage + " " + digest);
  }
  EXPECT_GT(said.size(), 5u);
  return said;
}

struct Case {
  std::string task;
  std::string condition;  ///< keys of both conditions, which make the world small
  std::string method;
  std::string another;  ///< the control: a key of the condition with another value than its default
};

TEST(Defaults, OfATaskAreTheSameWrittenOrLeftOut) {
  ASSERT_OK(clips, LoadClips({"builtin:boxing", "builtin:clap", "builtin:sway"}, {}));
  std::vector<Case> cases = {{"ik", "", "", "joint_noise_deg: 16"},
                             {"transition", "", "", "tween_s: 2"},
                             {"detection", "", "", "noise: 1.5"},
                             {"detection", "", "weights: adaptive", "turn_deg: 30"},
                             {"tracking", "duration_s: 0.2", "", "rate_hz: 20"},
                             {"capture", "duration_s: 0.1", "", "annotation_error_px: 2.5"}};
  cases.push_back({"ik", "start: middle", "", "poses: 0.4"});
  cases.push_back({"ik", "start: stretched", "", "max_sweeps: 7"});
  for (const IkSolver& solver : AllIkSolvers()) {
    if (solver.name != "gauss-newton") cases.push_back({"ik", "", "solver: " + solver.name, "poses: 0.4"});
  }
  for (const Case& c : cases) {
    const TaskKind& kind = *FindTaskKind(c.task);
    const Defaults condition = WriteOut(kind.condition_keys, c.condition);
    const Defaults method = WriteOut(kind.method_keys, c.method);
    EXPECT_GE(condition.count + method.count, 5) << c.task;
    const auto left_out = CellOf(kind, c.condition, c.method, *clips);
    EXPECT_THAT(CellOf(kind, condition.text, method.text, *clips), ElementsAreArray(left_out))
        << condition.text << " / " << method.text;
    const std::string comma = c.condition.empty() ? "" : ", ";
    EXPECT_NE(CellOf(kind, c.condition + comma + c.another, c.method, *clips), left_out) << c.task << c.another;
  }
}

TEST(Defaults, OfEveryScenarioAreTheSameWrittenOrLeftOut) {
  std::string written;
  int count = 0;
  for (const KeyInfo& key : CommonScenarioKeys()) {
    if (!key.HasDefaultValue()) continue;
    written += key.key + ": " + key.fallback + "\n";
    ++count;
  }
  EXPECT_GE(count, 7);
  const Scenario a = ParseOne(kHead + kMethods + written), b = ParseOne(kHead + kMethods);
  EXPECT_EQ(a.clips, b.clips);
  EXPECT_EQ(a.trials, b.trials);
  EXPECT_EQ(a.seed.value_or(0), 1u);  // a run uses 1 if the scenario gives no seed
  EXPECT_EQ(a.conditions.size(), b.conditions.size());
  EXPECT_EQ(a.expectations.size(), b.expectations.size());
  EXPECT_EQ(a.gate.metrics, b.gate.metrics);
}

TEST(Defaults, OfNestedMappingsAreTheSameWrittenOrLeftOut) {
  const auto group = [](const std::string& path) {
    for (const KeyGroup& each : AllKeyGroups()) {
      if (each.path == path) return WriteOut(each.keys, "").text;
    }
    ADD_FAILURE() << path;
    return std::string();
  };
  const std::string yaml = kHead + kMethods + "sweep: {poses: {from: 0, to: 1, count: 3, " + group("sweep.PARAMETER") +
                           "}}\n" + "limits: {" + group("limits") + "}\n" + "video: {" + group("video") + "}\n" +
                           "expect: [{metric: iterations, of: a, at_most: 1, " + group("expect[]") + "}]\n" +
                           "gate: {rule: threshold, tail: {" + group("gate.tail") +
                           "}, time_ratios: [{of: a, over: b, " + group("gate.time_ratios[]") + "}]}\n";
  const Scenario a = ParseOne(yaml);
  const Scenario b = ParseOne(kHead + kMethods +
                              "sweep: {poses: {from: 0, to: 1, count: 3}}\nvideo: {}\n"
                              "expect: [{metric: iterations, of: a, at_most: 1}]\n"
                              "gate: {time_ratios: [{of: a, over: b}]}\n");
  ASSERT_EQ(a.conditions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.conditions[i].swept, b.conditions[i].swept);
  EXPECT_EQ(a.limits.time_s, b.limits.time_s);
  EXPECT_EQ(a.limits.memory_mb, b.limits.memory_mb);
  EXPECT_EQ(a.recordings.methods, b.recordings.methods);
  EXPECT_EQ(a.recordings.trials, b.recordings.trials);
  EXPECT_EQ(a.expectations[0].statistic, b.expectations[0].statistic);
  EXPECT_EQ(a.expectations[0].where, b.expectations[0].where);
  EXPECT_EQ(a.gate.exact, b.gate.exact);
  EXPECT_THAT(group("gate.tail"), ::testing::HasSubstr("worlds: 4"));
  EXPECT_EQ(a.gate.tail.times, b.gate.tail.times);
  EXPECT_EQ(a.gate.tail.worlds, b.gate.tail.worlds);
  EXPECT_EQ(a.gate.tail.share, b.gate.tail.share);
  EXPECT_EQ(a.gate.tail.lost, b.gate.tail.lost);
  EXPECT_EQ(a.gate.time_ratios[0].at_most, b.gate.time_ratios[0].at_most);
}

}  // namespace
}  // namespace etude

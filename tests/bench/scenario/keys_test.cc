#include "bench/scenario/keys.h"

#include <map>
#include <set>

#include "bench/tasks/registry.h"
#include "engine/base/names.h"
#include "io/clips/clip_library.h"
#include "tests/bench/scenario/parse.h"

namespace etude {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

// An unknown key makes the error message list all keys that were read.
constexpr const char* kNobodyKnows = "zzzz";

using Names = std::set<std::string>;

Names NamesOf(const std::vector<KeyInfo>& keys) {
  Names names;
  for (const KeyInfo& key : keys) names.insert(key.key);
  return names;
}

/// Returns the keys that an error message about kNobodyKnows lists as allowed; fails the test for any other error
/// message.
Names AllowedBy(const std::string& complaint) {
  const std::string about = fmt::format("'{}'. Allowed: ", kNobodyKnows);
  const std::size_t at = complaint.find(about);
  EXPECT_NE(at, std::string::npos) << complaint;
  Names names;
  if (at == std::string::npos) return names;
  std::string list = complaint.substr(at + about.size()) + ", ";
  for (std::size_t from = 0, comma; (comma = list.find(", ", from)) != std::string::npos; from = comma + 2) {
    names.insert(list.substr(from, comma - from));
  }
  return names;
}

Names Differences(const Names& documented, const Names& read) {
  Names found;
  for (const std::string& name : documented) {
    if (read.count(name) == 0) found.insert(name + " is never read");
  }
  for (const std::string& name : read) {
    if (documented.count(name) == 0) found.insert(name + " is not documented");
  }
  return found;
}

Names Union(Names a, const Names& b) {
  a.insert(b.begin(), b.end());
  return a;
}

Names DocumentedAt(const std::string& path, const std::string& title) {
  Names names;
  for (const KeyGroup& group : AllKeyGroups()) {
    if (group.path == path && group.title == title) names = Union(names, NamesOf(group.keys));
  }
  EXPECT_THAT(names, Not(IsEmpty())) << path;
  return names;
}

TEST(Keys, OfEveryScenarioAreThoseThatAreRead) {
  const std::string scenario = kHead + kMethods;
  const auto complaint_of = [&](const std::string& line) { return AllowedBy(Complaint(scenario + line + "\n")); };
  struct Mapping {
    const char *path, *title;
    Names read;
  };
  const std::vector<Mapping> cases = {
      {"", "A file with several scenarios", AllowedBy(Complaint("scenarios: [{}]\nzzzz: 1\n"))},
      {"sweep.PARAMETER", "A range of values", complaint_of("sweep: {poses: {from: 0, to: 1, zzzz: 1}}")},
      {"expect[]", "An expectation", complaint_of("expect: [{metric: iterations, of: a, zzzz: 1}]")},
      {"video", "Recordings for films", complaint_of("video: {zzzz: 1}")},
      {"limits", "Limits", complaint_of("limits: {zzzz: 1}")},
      {"success", "What success is", complaint_of("success: {zzzz: 1}")},
      {"gate", "The gate", complaint_of("gate: {zzzz: 1}")},
      {"gate.tail", "The gate's tail rule", complaint_of("gate: {tail: {zzzz: 1}}")},
      {"gate.time_ratios[]", "A ratio of times", complaint_of("gate: {time_ratios: [{of: a, over: b, zzzz: 1}]}")},
      {"methods[]", "A method", AllowedBy(Complaint(kHead + "methods: [{name: a, exec: [x], zzzz: 1}]\n"))},
  };
  std::size_t checked = 0;
  for (const Mapping& c : cases) {
    EXPECT_THAT(Differences(DocumentedAt(c.path, c.title), c.read), IsEmpty()) << c.path;
    checked += c.read.size();
  }
  EXPECT_GT(checked, 25u);
}

TEST(Keys, OfATasksScenarioAreTheCommonOnesAndItsOwn) {
  for (const TaskKind& kind : AllTaskKinds()) {
    const Names read =
        AllowedBy(Complaint(fmt::format("scenario: s\nquestion: q\ntask: {}\n{}zzzz: 1\n", kind.name, kMethods)));
    const Names documented = Union(DocumentedAt("scenarios[]", "A scenario of any task"), NamesOf(kind.condition_keys));
    EXPECT_THAT(Differences(documented, read), IsEmpty()) << kind.name;
    const Names swept = AllowedBy(
        Complaint(fmt::format("scenario: s\nquestion: q\ntask: {}\n{}sweep: {{zzzz: [1]}}\n", kind.name, kMethods)));
    EXPECT_THAT(Differences(Union(NamesOf(kind.condition_keys), {"together"}), swept), IsEmpty()) << kind.name;
  }
}

// Methods that make each task read all of its keys; some keys are read only if others are set.
struct Probe {
  std::string task, method;
};
const std::vector<Probe> kProbes = {{"ik", ""},
                                    {"ik", "solver: damped-least-squares"},
                                    {"transition", ""},
                                    {"detection", "weights: adaptive"},
                                    {"detection", ""},
                                    {"capture", ""},
                                    {"tracking", ""},
                                    {"coach", ""},
                                    {"coach", "weights: adaptive"},
                                    {"pose-distance", ""},
                                    {"pose-distance", "distance: point-cloud"},
                                    {"evaluation", ""},
                                    {"plausibility", ""},
                                    {"inbetween", "filler: interpolation"},
                                    {"inbetween", "filler: inertialised"}};

/// Returns the error message of a task made from a condition and one method, without clips.
std::string ComplaintOfTask(const TaskKind& kind, const std::string& condition, const std::string& method) {
  const auto mapping = ParseYaml(condition, "s.yaml");
  const auto entry = ParseYaml("{name: a" + (method.empty() ? "" : ", " + method) + "}", "s.yaml");
  EXPECT_TRUE(mapping && entry);
  Fields fields(*mapping, "a condition");
  const ClipLibrary no_clips;
  TaskInput input{fields, std::span(&*entry, 1), no_clips};
  const auto task = kind.make(input);
  const auto done = fields.Finish();
  if (!done) return ToString(done.error());
  return task ? "" : ToString(task.error());
}

TEST(Keys, OfATaskAreThoseThatItReads) {
  std::map<std::string, Names> of_condition, of_methods;
  for (const Probe& probe : kProbes) {
    const TaskKind* const found = FindTaskKind(probe.task);
    ASSERT_NE(found, nullptr) << "a probe of no task: " << probe.task;
    const TaskKind& kind = *found;
    Names& condition = of_condition[probe.task];
    condition = Union(condition, AllowedBy(ComplaintOfTask(kind, "{zzzz: 1}", probe.method)));
    Names& methods = of_methods[probe.task];
    const std::string comma = probe.method.empty() ? "" : ", ";
    methods = Union(methods, AllowedBy(ComplaintOfTask(kind, "{}", probe.method + comma + "zzzz: 1")));
  }
  EXPECT_EQ(of_condition.size(), AllTaskKinds().size()) << "a task without a probe";
  for (const TaskKind& kind : AllTaskKinds()) {
    EXPECT_THAT(Differences(NamesOf(kind.condition_keys), of_condition[kind.name]), IsEmpty()) << kind.name;
    EXPECT_THAT(Differences(Union(NamesOf(kind.method_keys), {"name"}), of_methods[kind.name]), IsEmpty()) << kind.name;
  }
}

// If a name is listed twice, one further key must decide which setting is meant.
TEST(Keys, ThatStandTwiceGoWithDifferentValuesOfOneKey) {
  std::size_t checked = 0;
  for (const TaskKind& kind : AllTaskKinds()) {
    for (const std::vector<KeyInfo>& keys : {kind.condition_keys, kind.method_keys}) {
      std::map<std::string, std::vector<KeyInfo>> of_name;
      for (const KeyInfo& key : keys) of_name[key.key].push_back(key);
      for (const auto& [name, alike] : of_name) {
        Names values;
        for (const KeyInfo& key : alike) {
          EXPECT_TRUE(alike.size() == 1 || !key.only_with.key.empty()) << kind.name << ": " << name;
          EXPECT_EQ(key.only_with.key, alike.front().only_with.key) << kind.name << ": " << name;
          for (const std::string& value : key.only_with.values)
            EXPECT_TRUE(values.insert(value).second) << name << value;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 80u);
}

TEST(Keys, AreComparedBothWays) {
  EXPECT_THAT(Differences({"a", "b"}, {"a", "b"}), IsEmpty());
  EXPECT_THAT(Differences({"a"}, {"a", "b"}), ::testing::ElementsAre("b is not documented"));
  EXPECT_THAT(Differences({"a", "b"}, {"b"}), ::testing::ElementsAre("a is never read"));
}

TEST(Keys, SayEverythingAboutThemselves) {
  std::size_t checked = 0;
  for (const KeyGroup& group : AllKeyGroups()) {
    Names seen;
    for (const KeyInfo& key : group.keys) {
      const std::string variant = key.key + " with " + key.only_with.key + " " + Join(key.only_with.values);
      EXPECT_TRUE(seen.insert(variant).second) << variant << " stands twice in " << group.title;
      EXPECT_THAT(key.value.allowed, Not(IsEmpty())) << key.key;
      EXPECT_TRUE(!key.meaning.empty() && key.meaning.back() == '.') << group.title << ": " << key.key;
      ++checked;
    }
  }
  EXPECT_GT(checked, 80u);
}

}  // namespace
}  // namespace etude

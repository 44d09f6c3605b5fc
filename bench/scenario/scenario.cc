#include "bench/scenario/scenario.h"

#include <algorithm>
#include <cmath>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/registry.h"
#include "engine/base/names.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr int kMostTrials = 1'000'000;
constexpr std::size_t kMostConditions = 1000;
constexpr std::size_t kMostMethods = 100;

/// Names become parts of cell identities and file names.
bool IsPlainName(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !name.empty() && name.size() <= 80 && name[0] != '.' && std::all_of(name.begin(), name.end(), plain);
}

std::string ReadName(Fields& fields, std::string_view key) {
  std::string name = fields.RequiredText(key);
  if (fields.ok() && !IsPlainName(name)) {
    fields.Complain(fields.node().Find(key)->place,
                    fmt::format("'{}' is no {}; allowed: letters, digits, '-', '_' and '.', at most 80", name, key));
  }
  return name;
}

void ReadMethods(Fields& fields, Scenario& scenario) {
  const Node* list = fields.Raw("methods");
  if (list == nullptr || list->kind != Node::Kind::kSequence || list->items.empty()) {
    return fields.Complain(list == nullptr ? fields.node().place : list->place,
                           "a scenario needs 'methods', a list of at least one {name: …}");
  }
  if (list->items.size() > kMostMethods) {
    return fields.Complain(list->place, fmt::format("{} methods; at most {}", list->items.size(), kMostMethods));
  }
  for (const Node& item : list->items) {
    Fields method(item, "a method");
    const std::string name = ReadName(method, "name");
    if (!method.ok()) return fields.Complain(method.Finish().error().place, method.Finish().error().message);
    if (std::find(scenario.method_names.begin(), scenario.method_names.end(), name) != scenario.method_names.end()) {
      return fields.Complain(item.place, fmt::format("two methods are named '{}'", name));
    }
    scenario.method_names.push_back(name);
    scenario.methods.push_back(item);
  }
  for (Node& method : scenario.methods) {
    Fields entry(method, "a method");
    scenario.baselines.push_back(entry.Choice("against", scenario.method_names, scenario.method_names.front()));
    if (!entry.ok()) return fields.Complain(entry.Finish().error().place, entry.Finish().error().message);
    std::erase_if(method.entries, [](const Node::Entry& key) { return key.key == "against"; });
  }
}

/// The product of all swept lists; the last key varies fastest.
void ReadSweep(Fields& fields, Scenario& scenario) {
  scenario.conditions = {Condition{{}, fields.node()}};
  const Node* sweep = fields.Raw("sweep");
  if (sweep == nullptr) return;
  if (sweep->kind != Node::Kind::kMapping) {
    return fields.Complain(sweep->place, "'sweep' must map parameters to lists of values, found " + Describe(*sweep));
  }
  for (const Node::Entry& swept : sweep->entries) {
    const std::vector<std::string>& common = CommonScenarioKeys();
    if (std::find(common.begin(), common.end(), swept.key) != common.end()) {
      return fields.Complain(swept.place, fmt::format("'{}' cannot be swept; only a task's parameters can", swept.key));
    }
    if (swept.value.kind != Node::Kind::kSequence || swept.value.items.empty()) {
      return fields.Complain(swept.value.place, fmt::format("'{}' needs a list of values to sweep over, found {}",
                                                            swept.key, Describe(swept.value)));
    }
    if (scenario.conditions.size() * swept.value.items.size() > kMostConditions) {
      return fields.Complain(sweep->place, fmt::format("the sweep has more than {} conditions", kMostConditions));
    }
    std::vector<Condition> product;
    for (const Condition& condition : scenario.conditions) {
      for (const Node& value : swept.value.items) {
        if (value.kind != Node::Kind::kScalar) {
          return fields.Complain(value.place, "a swept value must be a number or a text, found " + Describe(value));
        }
        if (value.scalar.empty() || value.scalar.find_first_of(",=/ ") != std::string::npos) {
          return fields.Complain(value.place, "a swept value has no ',', '=', '/' or space, found " + Describe(value));
        }
        const auto repeated = [&](const Condition& other) {
          return std::equal(condition.settings.begin(), condition.settings.end(), other.settings.begin(),
                            [](const Setting& a, const Setting& b) { return a.value == b.value; }) &&
                 other.settings.back().value == value.scalar;
        };
        if (std::any_of(product.begin(), product.end(), repeated)) {
          return fields.Complain(value.place, fmt::format("the value '{}' stands here twice", value.scalar));
        }
        Condition next = condition;
        next.settings.push_back({swept.key, value.scalar});
        auto& entries = next.node.entries;
        std::erase_if(entries, [&](const Node::Entry& entry) { return entry.key == swept.key; });
        entries.push_back({swept.key, swept.place, value});
        product.push_back(std::move(next));
      }
    }
    scenario.conditions = std::move(product);
  }
}

void ReadMetrics(Fields& fields, Scenario& scenario, const TaskKind& kind) {
  const Node* list = fields.Raw("metrics");
  scenario.metrics = list == nullptr ? kind.default_metrics : fields.Texts("metrics");
  for (std::size_t i = 0; i < scenario.metrics.size(); ++i) {
    if (FindMetric(scenario.metrics[i]) != nullptr) continue;
    std::vector<std::string> known;
    for (const MetricInfo& metric : AllMetrics()) known.push_back(metric.id);
    fields.Complain(list == nullptr ? fields.node().place : list->items[i].place,
                    UnknownName("metric", scenario.metrics[i], known));
  }
}

std::string MethodIn(Fields& fields, std::string_view key, const Scenario& scenario) {
  const Node* value = fields.Raw(key);
  return value == nullptr ? "" : fields.Choice(key, scenario.method_names, "");
}

/// The settings of `where`, each of which must be one of the sweep's own.
std::vector<Setting> ReadWhere(Fields& fields, const Scenario& scenario) {
  std::vector<Setting> where;
  const Node* node = fields.Raw("where");
  if (node == nullptr) return where;
  if (node->kind != Node::Kind::kMapping) {
    fields.Complain(node->place, "'where' must map swept parameters to one of their values, found " + Describe(*node));
    return where;
  }
  for (const Node::Entry& entry : node->entries) {
    std::vector<std::string> known;
    for (const Condition& condition : scenario.conditions) {
      for (const Setting& setting : condition.settings) {
        const std::string text = setting.key + ": " + setting.value;
        if (std::find(known.begin(), known.end(), text) == known.end()) known.push_back(text);
      }
    }
    const std::string found = entry.key + ": " + entry.value.scalar;
    if (std::find(known.begin(), known.end(), found) == known.end()) {
      fields.Complain(entry.place, UnknownName("condition", found, known));
    }
    where.push_back({entry.key, entry.value.scalar});
  }
  return where;
}

void ReadExpectations(Fields& fields, Scenario& scenario) {
  const Node* list = fields.Raw("expect");
  if (list == nullptr) return;
  if (list->kind != Node::Kind::kSequence) {
    return fields.Complain(list->place, "'expect' must be a list, found " + Describe(*list));
  }
  std::vector<std::string> metric_ids;
  for (const MetricInfo& metric : AllMetrics()) metric_ids.push_back(metric.id);
  for (const Node& item : list->items) {
    Fields entry(item, "an expectation");
    Expectation expectation;
    expectation.place = item.place;
    entry.RequiredText("metric");
    expectation.metric = entry.Choice("metric", metric_ids, "");
    entry.RequiredText("of");
    expectation.of = entry.Choice("of", scenario.method_names, "");
    expectation.below = MethodIn(entry, "below", scenario);
    expectation.above = MethodIn(entry, "above", scenario);
    expectation.at_most = entry.OptionalNumber("at_most");
    expectation.at_least = entry.OptionalNumber("at_least");
    expectation.statistic = entry.Choice("statistic", {"median", "mean", "p95"}, "median");
    expectation.where = ReadWhere(entry, scenario);
    const int claims = !expectation.below.empty() + !expectation.above.empty() + expectation.at_most.has_value() +
                       expectation.at_least.has_value();
    if (const auto done = entry.Finish(); !done) return fields.Complain(done.error().place, done.error().message);
    if (expectation.below == expectation.of || expectation.above == expectation.of) {
      return fields.Complain(item.place, fmt::format("'{}' cannot be expected to differ from itself", expectation.of));
    }
    if (claims != 1) {
      return fields.Complain(item.place, fmt::format("an expectation says exactly one of: below, above (a method), "
                                                     "at_most, at_least (a number); found {}",
                                                     claims));
    }
    scenario.expectations.push_back(std::move(expectation));
  }
}

void ReadVideo(Fields& fields, Scenario& scenario) {
  const Node* node = fields.Raw("video");
  if (node == nullptr) return;
  Fields video(*node, "'video'");
  const Node* methods = video.Raw("compare");
  scenario.recordings.methods = video.Texts("compare");
  for (std::size_t i = 0; video.ok() && i < scenario.recordings.methods.size(); ++i) {
    const std::string& name = scenario.recordings.methods[i];
    if (std::find(scenario.method_names.begin(), scenario.method_names.end(), name) == scenario.method_names.end()) {
      video.Complain(methods->items[i].place, UnknownName("method", name, scenario.method_names));
    }
  }
  const Node* trials = video.Raw("trials");
  for (double trial : video.Numbers("trials", {0, scenario.trials - 1.0})) {
    if (trial != std::floor(trial)) video.Complain(trials->place, "'trials' must be whole numbers");
    scenario.recordings.trials.push_back(static_cast<int>(trial));
  }
  if (scenario.recordings.trials.empty()) scenario.recordings.trials = {0};
  if (scenario.recordings.methods.empty()) scenario.recordings.methods = scenario.method_names;
  const auto done = video.Finish();
  if (!done) fields.Complain(done.error().place, done.error().message);
}

}  // namespace

const std::vector<std::string>& CommonScenarioKeys() {
  static const std::vector<std::string> keys = {"scenario", "question", "task",    "clips",  "trials", "seed",
                                                "sweep",    "methods",  "metrics", "expect", "video"};
  return keys;
}

Result<Scenario> ParseScenario(std::string text, const std::string& file) {
  const auto node = ParseYaml(text, file);
  if (!node) return tl::unexpected(node.error());
  Fields fields(*node, "a scenario");
  Scenario scenario;
  scenario.file = file;
  scenario.text = std::move(text);
  scenario.name = ReadName(fields, "scenario");
  scenario.question = fields.RequiredText("question");
  std::vector<std::string> kinds;
  for (const TaskKind& kind : AllTaskKinds()) kinds.push_back(kind.name);
  fields.RequiredText("task");
  scenario.task = fields.Choice("task", kinds, kinds.front());
  scenario.clips = fields.Texts("clips");
  scenario.trials = fields.Integer("trials", 10, {1, kMostTrials});
  constexpr double kLargestSeed = 9007199254740992;  // 2^53: every whole number up to it is exact
  if (const auto seed = fields.OptionalWhole("seed", {0, kLargestSeed})) {
    scenario.seed = static_cast<std::uint64_t>(*seed);
  }
  ReadMethods(fields, scenario);
  if (fields.ok()) ReadSweep(fields, scenario);
  if (fields.ok()) ReadMetrics(fields, scenario, *FindTaskKind(scenario.task));
  if (fields.ok()) ReadExpectations(fields, scenario);
  if (fields.ok()) ReadVideo(fields, scenario);
  if (!fields.ok()) return tl::unexpected(fields.Finish().error());
  return scenario;
}

}  // namespace etude

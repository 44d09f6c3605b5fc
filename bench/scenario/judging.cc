#include "bench/scenario/judging.h"

#include <algorithm>

#include "bench/metrics/catalogue.h"
#include "engine/base/names.h"

namespace etude {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The metrics that a task's cells report.
std::vector<std::string> MetricsOf(const TaskKind& kind) {
  if (!kind.metrics.empty()) return kind.metrics;
  std::vector<std::string> all;
  for (const MetricInfo& metric : AllMetrics()) all.push_back(metric.id);
  return all;
}

/// A list of metrics that the task reports, each once.
std::vector<std::string> ReadMetricList(Fields& fields, std::string_view key, const TaskKind& kind) {
  const std::vector<std::string> known = MetricsOf(kind);
  const std::vector<std::string> metrics = fields.Texts(key);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    const Place& place = fields.node().Find(key)->items[i].place;
    if (!Contains(known, metrics[i])) {
      fields.Complain(place, UnknownName("metric of task " + kind.name, metrics[i], known));
    } else if (std::find(metrics.begin(), metrics.begin() + static_cast<std::ptrdiff_t>(i), metrics[i]) !=
               metrics.begin() + static_cast<std::ptrdiff_t>(i)) {
      fields.Complain(place, fmt::format("the metric '{}' stands here twice", metrics[i]));
    }
  }
  return metrics;
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
  std::vector<std::string> known;
  for (const Condition& condition : scenario.conditions) {
    for (const Setting& setting : condition.settings) {
      const std::string text = setting.key + ": " + setting.value;
      if (!Contains(known, text)) known.push_back(text);
    }
  }
  for (const Node::Entry& entry : node->entries) {
    const std::string found = entry.key + ": " + entry.value.scalar;
    if (known.empty()) {
      fields.Complain(entry.place, "'where' names swept parameters; this scenario sweeps none");
    } else if (!Contains(known, found)) {
      fields.Complain(entry.place, UnknownName("condition", found, known));
    }
    where.push_back({entry.key, entry.value.scalar});
  }
  // Values that are stepped through together do not meet in every combination.
  const auto has = [](const Condition& condition, const Setting& setting) {
    return std::find(condition.settings.begin(), condition.settings.end(), setting) != condition.settings.end();
  };
  const auto is_meant = [&](const Condition& condition) {
    return std::all_of(where.begin(), where.end(), [&](const Setting& setting) { return has(condition, setting); });
  };
  if (std::none_of(scenario.conditions.begin(), scenario.conditions.end(), is_meant)) {
    fields.Complain(node->place, fmt::format("no condition has {}", ConditionLabel(where)));
  }
  return where;
}

std::string RequiredChoice(Fields& fields, std::string_view key, const std::vector<std::string>& allowed) {
  fields.RequiredText(key);
  return fields.Choice(key, allowed, "");
}

Result<Expectation> ReadExpectation(const Node& item, const Scenario& scenario, const TaskKind& kind) {
  const std::vector<std::string> methods = MethodNames(scenario);
  Fields entry(item, "an expectation");
  Expectation expectation;
  expectation.place = item.place;
  expectation.metric = RequiredChoice(entry, "metric", MetricsOf(kind));
  expectation.of = RequiredChoice(entry, "of", methods);
  expectation.below = entry.Choice("below", methods, "");
  expectation.above = entry.Choice("above", methods, "");
  expectation.at_most = entry.OptionalNumber("at_most");
  expectation.at_least = entry.OptionalNumber("at_least");
  expectation.statistic = entry.Choice("statistic", {"median", "mean", "p95"}, "median");
  expectation.confidence = entry.Number("confidence", expectation.confidence, {0.5, 0.999});
  expectation.where = ReadWhere(entry, scenario);
  RETURN_IF_ERROR(entry.Finish());
  if (expectation.below == expectation.of || expectation.above == expectation.of) {
    return Fail(item.place, "'{}' cannot be expected to differ from itself", expectation.of);
  }
  const int claims = !expectation.below.empty() + !expectation.above.empty() + expectation.at_most.has_value() +
                     expectation.at_least.has_value();
  if (claims != 1) {
    return Fail(item.place,
                "an expectation says exactly one of: below, above (a method), at_most, at_least (a number); found {}",
                claims);
  }
  return expectation;
}

Result<TimeRatio> ReadTimeRatio(const Node& item, const Scenario& scenario) {
  const std::vector<std::string> methods = MethodNames(scenario);
  Fields entry(item, "a time ratio");
  TimeRatio ratio;
  ratio.place = item.place;
  ratio.of = RequiredChoice(entry, "of", methods);
  ratio.over = RequiredChoice(entry, "over", methods);
  ratio.at_most = entry.Number("at_most", ratio.at_most, {0.001, 1e6});
  RETURN_IF_ERROR(entry.Finish());
  if (ratio.of == ratio.over) return Fail(item.place, "the ratio of '{}' over itself says nothing", ratio.of);
  return ratio;
}

/// The items of a list, or nothing, with a complaint, when it is none.
std::vector<Node> ItemsOf(Fields& fields, std::string_view key) {
  const Node* list = fields.Raw(key);
  if (list == nullptr) return {};
  if (list->kind != Node::Kind::kSequence) {
    fields.Complain(list->place, fmt::format("'{}' must be a list, found {}", key, Describe(*list)));
  }
  return list->items;
}

}  // namespace

std::vector<std::string> ReadMetrics(Fields& fields, const TaskKind& kind) {
  std::vector<std::string> metrics = ReadMetricList(fields, "metrics", kind);
  return metrics.empty() ? kind.default_metrics : metrics;
}

std::vector<Expectation> ReadExpectations(Fields& fields, const Scenario& scenario, const TaskKind& kind) {
  std::vector<Expectation> expectations;
  for (const Node& item : ItemsOf(fields, "expect")) {
    auto expectation = ReadExpectation(item, scenario, kind);
    if (!expectation) {
      fields.Complain(expectation.error().place, expectation.error().message);
      return {};
    }
    expectations.push_back(*std::move(expectation));
  }
  return expectations;
}

GateRules ReadGate(Fields& fields, const Scenario& scenario, const TaskKind& kind) {
  GateRules rules;
  rules.metrics = scenario.metrics;
  const Node* node = fields.Raw("gate");
  if (node == nullptr) return rules;
  Fields gate(*node, "'gate'");
  if (auto metrics = ReadMetricList(gate, "metrics", kind); !metrics.empty()) rules.metrics = std::move(metrics);
  rules.exact = gate.Choice("rule", {"threshold", "exact"}, "threshold") == "exact";
  for (const Node& item : ItemsOf(gate, "time_ratios")) {
    auto ratio = ReadTimeRatio(item, scenario);
    if (!ratio) {
      gate.Complain(ratio.error().place, ratio.error().message);
      break;
    }
    rules.time_ratios.push_back(*std::move(ratio));
  }
  if (auto done = gate.Finish(); !done) fields.Complain(done.error().place, done.error().message);
  return rules;
}

}  // namespace etude

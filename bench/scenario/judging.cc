#include "bench/scenario/judging.h"

#include <algorithm>

#include "bench/metrics/catalogue.h"
#include "engine/base/names.h"

namespace etude {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads a list of metrics. The task must report each of them, and each may be listed once.
std::vector<std::string> ReadMetricList(Fields& fields, const std::string& task,
                                        const std::vector<std::string>& known) {
  const char* key = "metrics";
  std::vector<std::string> metrics;
  const std::vector<std::string> names = fields.Texts(key);
  for (std::size_t i = 0; i < names.size(); ++i) {
    NoteMetric(fields, task, known, names[i], fields.node().Find(key)->items[i].place, metrics);
  }
  return metrics;
}

/// Reads `where`: swept parameters, each with one of its values.
std::vector<SweptValue> ReadWhere(Fields& fields, const Scenario& scenario) {
  std::vector<SweptValue> where;
  const Node* node = fields.Raw("where");
  if (node == nullptr) return where;
  if (node->kind != Node::Kind::kMapping) {
    fields.Complain(node->place,
                    "'where' must map each swept parameter to one of the parameter's values, found " + Describe(*node));
    return where;
  }
  // Check the swept parameters and their values.
  std::vector<std::string> known;
  for (const Condition& condition : scenario.conditions) {
    for (const SweptValue& swept : condition.swept) {
      const std::string text = swept.key + ": " + swept.value;
      if (!Contains(known, text)) known.push_back(text);
    }
  }
  for (const Node::Entry& entry : node->entries) {
    const std::string found = entry.key + ": " + entry.value.scalar;
    if (known.empty()) {
      fields.Complain(entry.place, "'where' selects values of swept parameters, but this scenario has no sweep");
    } else if (!Contains(known, found)) {
      fields.Complain(entry.place, UnknownName("condition", found, known));
    }
    where.push_back({entry.key, entry.value.scalar});
  }
  // With `together`, parameters change their values together, so some combinations of known values are not a condition.
  const auto has = [](const Condition& condition, const SweptValue& swept) {
    return std::find(condition.swept.begin(), condition.swept.end(), swept) != condition.swept.end();
  };
  const auto is_meant = [&](const Condition& condition) {
    return std::all_of(where.begin(), where.end(), [&](const SweptValue& swept) { return has(condition, swept); });
  };
  if (std::none_of(scenario.conditions.begin(), scenario.conditions.end(), is_meant)) {
    fields.Complain(node->place, fmt::format("no condition has {}", ConditionLabel(where)));
  }
  return where;
}

/// Returns a field whose value must be one of `known`, which depends on the scenario. `allowed` describes the value to
/// users.
template <typename Options>
Field<Options> KnownName(const std::string& key, std::string Options::*member, std::string allowed,
                         const std::vector<std::string>& known, std::string meaning) {
  return {{key, TextKind(std::move(allowed)), "", std::move(meaning)},
          [=](Fields& fields, Options& options) { options.*member = fields.Choice(key, known, options.*member); }};
}

/// Refuses a bound that a share or score can never reach, such as 90 for 90 %.
void CheckBound(Fields& fields, const Expectation& expectation) {
  const MetricInfo* metric = FindMetric(expectation.metric);
  if (metric == nullptr || metric->reading == Reading::kAmount) return;
  const char* key = expectation.at_most ? "at_most" : "at_least";
  const double bound = expectation.at_most ? *expectation.at_most : *expectation.at_least;
  if (bound >= 0 && bound <= 1) return;
  fields.Complain(fields.Raw(key)->place,
                  fmt::format("'{}': {} is out of range; allowed for the metric '{}': 0 to 1 (0.9 is 90 %)", key, bound,
                              expectation.metric));
}

void CheckExpectation(Fields& fields, Expectation& expectation) {
  expectation.place = fields.node().place;
  if (expectation.below == expectation.of || expectation.above == expectation.of) {
    fields.Complain(
        expectation.place,
        fmt::format("an expectation compares '{}' with itself; allowed: two different methods", expectation.of));
  }
  const int claims = !expectation.below.empty() + !expectation.above.empty() + expectation.at_most.has_value() +
                     expectation.at_least.has_value();
  if (claims != 1) {
    fields.Complain(expectation.place, fmt::format("an expectation needs exactly one of the keys below, above (a "
                                                   "method), at_most, at_least (a number); found {}",
                                                   claims));
    return;
  }
  // A key that has no effect here is refused, unless it has its default value.
  const Expectation defaults;
  const bool is_bound = expectation.at_most || expectation.at_least;
  if (is_bound) CheckBound(fields, expectation);
  const bool is_default =
      is_bound ? expectation.confidence == defaults.confidence : expectation.statistic == defaults.statistic;
  const char* without_effect = is_bound ? "confidence" : "statistic";
  const Node* given = fields.Raw(without_effect);
  if (given == nullptr || is_default) return;
  fields.Complain(given->place, fmt::format("'{}' has no effect here; allowed: only with {}", without_effect,
                                            is_bound ? "below or above" : "at_most or at_least"));
}

void CheckGateRules(Fields& fields, GateRules& rules) {
  const Node* tail = fields.Raw("tail");
  if (rules.exact && tail != nullptr) fields.Complain(tail->place, "'tail' is not allowed with 'rule: exact'");
}

void CheckTimeRatio(Fields& fields, TimeRatio& ratio) {
  ratio.place = fields.node().place;
  if (ratio.of != ratio.over) return;
  fields.Complain(ratio.place, fmt::format("a ratio of times needs two different methods, found '{}' twice", ratio.of));
}

}  // namespace

std::vector<std::string> MetricsOf(const TaskKind& kind) {
  if (!kind.metrics.empty()) return kind.metrics;
  std::vector<std::string> all;
  for (const MetricInfo& metric : AllMetrics()) all.push_back(metric.id);
  return all;
}

std::vector<std::string> MetricsOf(const TaskKind& kind, const Scenario& scenario) {
  std::vector<std::string> metrics = MetricsOf(kind);
  for (const OutsideMetric& own : scenario.outside_metrics) metrics.push_back(own.info.id);
  return metrics;
}

void NoteMetric(Fields& fields, const std::string& task, const std::vector<std::string>& known, const std::string& name,
                const Place& place, std::vector<std::string>& metrics) {
  if (!Contains(known, name)) {
    fields.Complain(place, UnknownName("metric of task " + task, name, known));
  } else if (Contains(metrics, name)) {
    fields.Complain(place, fmt::format("the metric '{}' is listed twice", name));
  } else {
    metrics.push_back(name);
  }
}

FieldTable<Expectation> ExpectationFields(const Scenario& scenario, const std::vector<std::string>& metrics) {
  using Key = Field<Expectation>;
  const std::vector<std::string> methods = MethodNames(scenario);
  const char* another = "(not claimed)";
  return {
      {KnownName("metric", &Expectation::metric, "a metric of the task", metrics,
                 "The metric whose values are compared."),
       KnownName("of", &Expectation::of, "a method", methods, "The method that the expectation is about."),
       KnownName("below", &Expectation::below, "a method", methods,
                 "In the same worlds, the method `of` must have lower values than this method.")
           .WhenAbsent(another),
       KnownName("above", &Expectation::above, "a method", methods,
                 "In the same worlds, the method `of` must have higher values than this method.")
           .WhenAbsent(another),
       Key::Number("at_most", &Expectation::at_most, {}, "The largest allowed value of the statistic of method `of`.")
           .WhenAbsent(another),
       Key::Number("at_least", &Expectation::at_least, {},
                   "The smallest allowed value of the statistic of method `of`.")
           .WhenAbsent(another),
       Key::Name("statistic", &Expectation::statistic, {{"median", "median"}, {"mean", "mean"}, {"p95", "p95"}},
                 "The statistic that `at_most` and `at_least` limit."),
       Key::Number("confidence", &Expectation::confidence, {0.5, 0.999},
                   "The confidence with which `below` and `above` must hold."),
       {{"where",
         {"a mapping: for each swept parameter, one of its values", R"({"type":"object"})"},
         "{}",
         "The conditions in which the expectation is checked; by default all conditions."},
        [&](Fields& fields, Expectation& expectation) { expectation.where = ReadWhere(fields, scenario); }}},
      CheckExpectation};
}

std::vector<std::string> SuccessMetricsOf(const TaskKind& kind, const Scenario& scenario) {
  std::vector<std::string> shares;
  for (const std::string& id : MetricsOf(kind, scenario)) {
    const MetricInfo* metric = FindMetric(id);
    if (metric != nullptr && metric->direction == Direction::kHigherIsBetter && metric->reading != Reading::kAmount) {
      shares.push_back(id);
    }
  }
  return shares;
}

FieldTable<Scenario> SuccessFields(const std::vector<std::string>& metrics) {
  return {
      {KnownName("metric", &Scenario::success, "a share or score of the task whose higher values are better", metrics,
                 "The metric that measures success. It is a share of all cells, or a share within each cell.")
           .WhenAbsent("(the task's)"),
       Field<Scenario>::Number("matters", &Scenario::success_matters, {0.001, 1},
                               "The smallest difference between two methods that matters, as a share. In task "
                               "evaluation, the default is 0.01.")}};
}

FieldTable<TimeRatio> TimeRatioFields(const Scenario& scenario) {
  const std::vector<std::string> methods = MethodNames(scenario);
  return {{KnownName("of", &TimeRatio::of, "a method", methods, "The method whose processor time is checked."),
           KnownName("over", &TimeRatio::over, "a method", methods,
                     "The method in the denominator. In each world, the time of method `of` is divided by the time of "
                     "this method."),
           Field<TimeRatio>::Number("at_most", &TimeRatio::at_most, {0.001, 1e6},
                                    "The largest allowed median of these ratios.")},
          CheckTimeRatio};
}

FieldTable<TailRule> TailFields() {
  using Key = Field<TailRule>;
  constexpr Range kWorlds{0, 1e6};
  return {{Key::Number("times", &TailRule::times, {1, 1e6},
                       "A world is far worse if its value is worse by more than this number of practical thresholds."),
           Key::Number(
               "worlds", &TailRule::worlds, kWorlds,
               "A comparison with at least this number of far worse worlds (or all worlds, if there are fewer) is a "
               "regression. 0 turns this rule off."),
           Key::Number("share", &TailRule::share, {0, 1},
                       "The number of far worse worlds must also be at least this share of the compared worlds. Among "
                       "many worlds, rounding alone makes some worlds far worse."),
           Key::Number("lost", &TailRule::lost, kWorlds,
                       "A comparison in which at least this number of worlds lost their value or answer is a "
                       "regression. 0 turns this rule off; lost worlds still count as far worse worlds.")}};
}

FieldTable<GateRules> GateFields(const Scenario& scenario, const std::vector<std::string>& metrics) {
  using Key = Field<GateRules>;
  return {
      {{{"metrics", ListKind("a list of metrics of the task", TextKind("")),
         "(the metric of `success` and the scenario's `metrics`)", "The metrics that the gate compares."},
        [&scenario, metrics](Fields& gate, GateRules& rules) {
          auto named = ReadMetricList(gate, scenario.task, metrics);
          if (!named.empty()) rules.metrics = std::move(named);
        }},
       Key::Name("rule", &GateRules::exact, {{"threshold", false}, {"exact", true}},
                 "threshold: only a difference that matters is a regression; exact: every difference is a regression."),
       {{"tail", MappingKind("a mapping", TailFields().Describe()), "{}",
         "Decides when single far worse worlds are a regression although the comparison of all worlds finds no "
         "regression. Not allowed with `rule: exact`."},
        [](Fields& gate, GateRules& rules) { ReadNested(gate, "tail", TailFields(), rules.tail); }},
       {{"time_ratios", ListKind("a list of ratios", MappingKind("", TimeRatioFields(scenario).Describe())), "[]",
         "Limits on ratios between the processor times of two methods of the run."},
        [&](Fields& gate, GateRules& rules) {
          rules.time_ratios = ReadListed(gate, "time_ratios", "a time ratio", TimeRatioFields(scenario));
        }}},
      CheckGateRules};
}

}  // namespace etude

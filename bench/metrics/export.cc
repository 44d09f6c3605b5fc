#include "bench/metrics/export.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench/metrics/catalogue.h"
#include "engine/motion/body.h"
#include "engine/motion/motion_faults.h"
#include "io/files/json.h"

namespace etude {
namespace {

const char* DirectionKey(Direction direction) {
  constexpr std::array kKeys = {"lower", "higher", "neither"};
  return kKeys[static_cast<std::size_t>(direction)];
}

Json EncodeJoints() {
  Json joints = Json::array();
  for (Role role : AllRoles()) {
    const auto parent = ParentOf(role);
    joints.push_back({{"name", RoleName(role)}, {"parent", parent ? Json(RoleName(*parent)) : Json(nullptr)}});
  }
  return joints;
}

Json EncodeVector(const MetricInfo& metric, const MetricVector& vector) {
  Json json = {{"metric", metric.id},
               {"version", metric.version},
               {"title", vector.title},
               {"input", Json::parse(vector.input_json)},
               {"expected", vector.expected ? Json(*vector.expected) : Json(nullptr)}};
  if (!vector.null_reason.empty()) json["null_reason"] = vector.null_reason;
  json["tolerance"] = vector.tolerance;
  json["source"] = vector.source;
  return json;
}

// One word per Reading, in the order of Reading.
constexpr std::array kReadings = {"amount", "yes-no", "share", "score"};

Json EncodeMetric(const MetricInfo& metric) {
  Json inputs = Json::object();
  for (const MetricInput& input : metric.inputs) inputs[input.key] = input.meaning;
  Json vectors = Json::array();
  for (const MetricVector& vector : metric.vectors) vectors.push_back(EncodeVector(metric, vector));
  Json json = {{"id", metric.id},
               {"version", metric.version},
               {"domain", metric.domain},
               {"label", metric.label},
               {"unit", metric.unit},
               {"direction", DirectionKey(metric.direction)},
               {"aggregate", metric.aggregate == Aggregate::kMedian ? "median" : "mean"},
               {"definition", metric.definition},
               {"formula", metric.formula},
               {"null_rule", metric.null_rule},
               {"practical_threshold", metric.practical},
               {"practical_reason", metric.practical_reason},
               {"source", metric.source},
               {"inputs", std::move(inputs)},
               {"vectors", std::move(vectors)},
               {"reads", kReadings[static_cast<std::size_t>(metric.reading)]}};
  if (!metric.weight.empty()) json["weight"] = metric.weight;
  return json;
}

constexpr std::string_view kIntroduction = R"(# Metrics

Written by `etude list metrics --markdown`; a test compares the two. This page defines every number of `cells.jsonl` so
precisely that another implementation can prove its agreement:

    etude list metrics --json | python3 tests/bench/metrics/second_implementation.py

The JSON (`docs/schemas/metrics.schema.json`) contains every definition below with its test vectors and their inputs.

## All metrics

- **Identity.** The id of a metric contains the unit. If a definition changes, the metric gets a higher version. Values
  of two versions are not comparable.
- **Motions** are judged at 30 Hz as positions of twenty joints, in metres with Y up. A limb is the line from a joint to
  the joint's parent (`joints` of the JSON). In transitions, the hips of the standing body are at 0.90 m.
- **A missing value** is null, never zero, and `null_reasons` contains the reason. A cell without an answer (failed,
  timeout, crashed, out_of_memory, bad_output) has no values. Exceptions are metrics that give a failure a value: 0
  for a solved share, and twice the limit for PAR-2. With such a value, the cell stays in the denominator. A skipped
  cell has no values at all.
- **A run** aggregates the values of the cells by the median or the mean, with a 95 % bootstrap interval. Each metric
  states its aggregate. Shares and 0/1 values are aggregated by the mean.
- **The practical threshold** is the smallest difference that matters in practice. A smaller difference is never better
  or worse.
- **∠(u, v)** is atan2(‖u × v‖, u · v). It is 0 when one of the vectors is zero.

## Inputs of the test vectors

- A motion: `{"rate_hz": 30, "frames": 3, "joints_m": {"left_hand": [[x, y, z], …]}}`. A joint has one position
  per frame, or one position for all frames. A joint that is not listed stays at the origin. The default of `rate_hz`
  is 30.
- A pose: `{"left_hand": [x, y, z], …}`. A joint that is not listed is at the origin.
- A computed value may differ from the expected value by at most the tolerance, in the metric's unit. `expected: null`
  means that the metric has no value.
- `derived:` values were derived from the definition by hand. `published:` values come from the cited work.
)";

std::string Amount(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::string Facts(const MetricInfo& metric) {
  std::string facts = metric.label;
  for (const std::string& fact : {metric.unit, std::string(DirectionWords(metric.direction)),
                                  (metric.aggregate == Aggregate::kMedian ? "median over cells" : "mean over cells") +
                                      (metric.weight.empty() ? "" : fmt::format(", weighted by `{}`", metric.weight)),
                                  fmt::format("version {}", metric.version)}) {
    if (!fact.empty()) facts += " · " + fact;
  }
  return facts;
}

std::string ExpectedText(const MetricVector& vector) {
  if (!vector.expected) return fmt::format("null: {}", vector.null_reason);
  return vector.tolerance > 0 ? fmt::format("{:.9g} ± {:g}", *vector.expected, vector.tolerance)
                              : fmt::format("{:.9g}", *vector.expected);
}

/// Escapes '|', which would otherwise end a table cell.
std::string EscapeTableCell(std::string_view content) {
  std::string text(content);
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string Section(const MetricInfo& metric) {
  std::string text = fmt::format("\n### `{}`\n\n{}\n\n{}\n\n", metric.id, Facts(metric), metric.definition);
  text += fmt::format("- **Formula.** {}\n- **Null.** {}\n", metric.formula, metric.null_rule);
  text += fmt::format("- **Smallest difference that matters: {}.** {}\n", Amount(metric.practical, metric.unit),
                      metric.practical_reason);
  text += fmt::format("- **Source.** {}\n- **Input of the test vectors.**", metric.source);
  for (const MetricInput& input : metric.inputs) {
    text += fmt::format("{} `{}`: {}", &input == &metric.inputs.front() ? "" : ";", input.key, input.meaning);
  }
  text += ".\n\n| test vector | value | source of the value |\n|---|---|---|\n";
  for (const MetricVector& vector : metric.vectors) {
    text += fmt::format("| {} | {} | {} |\n", EscapeTableCell(vector.title), EscapeTableCell(ExpectedText(vector)),
                        EscapeTableCell(vector.source));
  }
  return text;
}

}  // namespace

Json MetricsJson() {
  Json json = {{"joints", EncodeJoints()}};
  Json& metrics = json["metrics"] = Json::array();
  for (const MetricInfo& metric : AllMetrics()) metrics.push_back(EncodeMetric(metric));
  return json;
}

std::string FaultsTable() {
  std::string text = "| fault | unit of the fault's size | reported when |\n|---|---|---|\n";
  for (const FaultRule& rule : FaultRules()) text += fmt::format("| {} | {} | {} |\n", rule.name, rule.unit, rule.rule);
  return text;
}

std::string MetricsPage() {
  std::string page(kIntroduction);
  std::string domain;
  for (const MetricInfo& metric : AllMetrics()) {
    if (metric.domain != domain) page += fmt::format("\n## {}\n", metric.domain);
    domain = metric.domain;
    if (metric.id == "faults") page += "\n" + FaultsTable();
    page += Section(metric);
  }
  return page;
}

Json AddedMetricsJson() {
  Json list = Json::array();
  for (const auto& [id, metric] : AddedMetrics()) list.push_back(EncodeMetric(metric));
  return list;
}

Result<void> ReadAddedMetrics(const Json& list, const Place& place) {
  const auto index_of = [](const auto& words, const Json& word) {
    const auto found = std::ranges::find(words, word.get<std::string>());
    if (found == words.end()) throw Json::other_error::create(501, "unknown word " + word.dump(), nullptr);
    return found - words.begin();
  };
  // The texts for each enumeration's values, in the order of their declaration.
  constexpr std::array kDirections = {"lower", "higher", "neither"};
  constexpr std::array kAggregates = {"median", "mean"};
  // Read and add each definition. AddMetric fails if a known id has another definition.
  for (const Json& each : list) {
    MetricInfo metric;
    try {
      metric.id = each.at("id").get<std::string>();
      metric.version = each.at("version").get<int>();
      metric.label = each.at("label").get<std::string>();
      metric.unit = each.at("unit").get<std::string>();
      metric.direction = static_cast<Direction>(index_of(kDirections, each.at("direction")));
      metric.aggregate = static_cast<Aggregate>(index_of(kAggregates, each.at("aggregate")));
      metric.reading = static_cast<Reading>(index_of(kReadings, each.at("reads")));
      metric.practical = each.at("practical_threshold").get<double>();
      metric.definition = each.at("definition").get<std::string>();
      metric.domain = each.at("domain").get<std::string>();
    } catch (const Json::exception& error) {  // a missing key, a wrong type, or an unknown word
      return Fail(place, "is not the definition of a metric of a scenario: {}", error.what());
    }
    if (auto added = AddMetric(std::move(metric)); !added) return Fail(place, "{}", added.error().message);
  }
  return {};
}

}  // namespace etude

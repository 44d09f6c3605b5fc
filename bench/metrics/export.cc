#include "bench/metrics/export.h"

#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "bench/metrics/catalogue.h"
#include "engine/motion/body.h"

namespace etude {
namespace {

constexpr const char* kFormat = "etude-metrics";
constexpr int kVersion = 1;

const char* DirectionKey(Direction direction) {
  switch (direction) {
    case Direction::kLowerIsBetter:
      return "lower";
    case Direction::kHigherIsBetter:
      return "higher";
    case Direction::kNeither:
      break;
  }
  return "neither";
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

Json EncodeMetric(const MetricInfo& metric) {
  Json inputs = Json::object();
  for (const MetricInput& input : metric.inputs) inputs[input.key] = input.meaning;
  Json vectors = Json::array();
  for (const MetricVector& vector : metric.vectors) vectors.push_back(EncodeVector(metric, vector));
  return {{"id", metric.id},
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
          {"vectors", std::move(vectors)}};
}

}  // namespace

std::string MetricsJson() {
  Json json = {{"format", kFormat}, {"version", kVersion}, {"joints", EncodeJoints()}};
  Json& metrics = json["metrics"] = Json::array();
  for (const MetricInfo& metric : AllMetrics()) metrics.push_back(EncodeMetric(metric));
  return WriteJson(json).value();  // the files' numbers are finite
}

}  // namespace etude

#include "bench/metrics/vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "bench/metrics/catalogue.h"
#include "bench/metrics/vector_files.h"

namespace etude {
namespace {

constexpr std::string_view kSources[] = {"derived: ", "published: "};

std::string ValueText(std::optional<double> value) { return value ? fmt::format("{}", *value) : "no value"; }

MetricVector Decode(const Json& json) {
  MetricVector vector;
  vector.metric = json.at("metric");
  vector.version = json.at("version");
  vector.title = json.at("title");
  vector.input_json = json.at("input").dump();
  if (!json.at("expected").is_null()) vector.expected = json.at("expected").get<double>();
  vector.null_reason = json.value("null_reason", "");
  vector.tolerance = json.at("tolerance");
  vector.source = json.at("source");
  return vector;
}

/// What is wrong with a vector, or "".
std::string FindFault(const MetricVector& vector) {
  const MetricInfo* metric = FindMetric(vector.metric);
  if (metric == nullptr) return "the metric '" + vector.metric + "' is not in the catalogue";
  if (vector.version != metric->version) {
    return fmt::format("version {} of {}; the catalogue has {}", vector.version, vector.metric, metric->version);
  }
  if (vector.expected.has_value() != vector.null_reason.empty()) {
    return "either a value is expected, or 'null_reason' says why none is";
  }
  if (!(vector.tolerance >= 0)) return "the tolerance is negative";
  const bool has_source = std::any_of(std::begin(kSources), std::end(kSources),
                                      [&](std::string_view start) { return vector.source.starts_with(start); });
  if (!has_source) return fmt::format("source '{}' begins with neither 'derived: ' nor 'published: '", vector.source);
  return "";
}

}  // namespace

Result<std::vector<MetricVector>> ReadVectors(const std::string& text, const std::string& file) {
  ASSIGN_OR_RETURN(const auto list, ReadJson(text, file));
  std::vector<MetricVector> vectors;
  try {
    for (const Json& entry : list) {
      vectors.push_back(Decode(entry));
      const std::string fault = FindFault(vectors.back());
      if (!fault.empty()) return Fail({file, 0, 0}, "vector {}: {}", vectors.size(), fault);
    }
  } catch (const Json::exception& error) {
    return Fail({file, 0, 0}, "vector {}: {}", vectors.size() + 1, error.what());
  }
  return vectors;
}

Result<std::vector<MetricVector>> AllVectors() {
  std::vector<MetricVector> all;
  for (const EmbeddedText& file : MetricVectorFiles()) {
    auto vectors = ReadVectors(std::string(file.text), std::string(file.name));
    if (!vectors) return vectors;
    std::move(vectors->begin(), vectors->end(), std::back_inserter(all));
  }
  std::stable_sort(all.begin(), all.end(), [](const MetricVector& a, const MetricVector& b) {
    return FindMetric(a.metric) < FindMetric(b.metric);  // both in one array
  });
  return all;
}

std::string Disagreement(const MetricVector& vector, std::optional<double> found) {
  const bool agrees = found && vector.expected ? std::abs(*found - *vector.expected) <= vector.tolerance
                                               : found.has_value() == vector.expected.has_value();
  if (agrees) return "";
  return fmt::format("{} of \"{}\" is {}, expected {} ± {} ({})", vector.metric, vector.title, ValueText(found),
                     ValueText(vector.expected), vector.tolerance, vector.source);
}

}  // namespace etude

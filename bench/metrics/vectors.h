#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A metric's value for one input, known without this program: what another implementation must agree with.
struct MetricVector {
  std::string metric;
  int version = 0;                 ///< of the metric
  std::string title;               ///< what it is about: "one joint of twenty jumps"
  std::string input_json;          ///< one JSON object, with the keys of MetricInfo::inputs
  std::optional<double> expected;  ///< nothing: the metric has no value here
  std::string null_reason;         ///< why it has none; "" when it has
  double tolerance = 0;            ///< absolute, in the metric's unit
  std::string source;              ///< "derived: …" or "published: …"
};

/// Reads one file of vectors; complains with the file, and with the place in its list.
Result<std::vector<MetricVector>> ReadVectors(const std::string& text, const std::string& file);

/// All vectors that the program carries (bench/metrics/vectors/*.json), in the catalogue's order.
Result<std::vector<MetricVector>> AllVectors();

/// Why this value is not the vector's, or "" when it is, within the tolerance.
std::string Disagreement(const MetricVector& vector, std::optional<double> found);

}  // namespace etude

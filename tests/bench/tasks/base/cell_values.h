#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// Returns a cell's value of a metric; nothing if it is missing. Fails the test if the cell does not list the metric.
inline std::optional<double> ValueOf(const CellResult& cell, std::string_view id) {
  for (const MetricValue& metric : cell.metrics) {
    if (metric.id == id) return metric.value;
  }
  ADD_FAILURE() << "no metric " << id;
  return std::nullopt;
}

/// Returns a cell's digest of a stage. Fails the test if the cell has no such stage.
inline std::string DigestOf(const CellResult& cell, std::string_view stage) {
  for (const auto& [name, digest] : cell.digests) {
    if (name == stage) return digest;
  }
  ADD_FAILURE() << stage << " is not among the digests";
  return "";
}

}  // namespace etude

#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// A cell's value of a metric, nothing where it is missing. A metric that the cell does not tell of fails the test.
inline std::optional<double> ValueOf(const CellResult& cell, std::string_view id) {
  for (const MetricValue& metric : cell.metrics) {
    if (metric.id == id) return metric.value;
  }
  ADD_FAILURE() << "no metric " << id;
  return std::nullopt;
}

}  // namespace etude

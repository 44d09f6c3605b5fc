#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// Returns a cell's value of a metric; nothing if it is missing. Fails the test if the cell does not list the metric at
/// all.
inline std::optional<double> ValueOf(const CellResult& cell, std::string_view id) {
  for (const MetricValue& metric : cell.metrics) {
    if (metric.id == id) return metric.value;
  }
  ADD_FAILURE() << "no metric " << id;
  return std::nullopt;
}

}  // namespace etude

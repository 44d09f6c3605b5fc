#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/statistics/compare.h"

namespace etude {

/// The rows of one condition, in order.
std::vector<const Row*> RowsIn(std::span<const Row> rows, const std::vector<SweptValue>& condition);

/// All values of a metric of one method, in order; `missing` counts the cells without one.
std::vector<double> ValuesOf(std::span<const Row* const> rows, const std::string& method, const std::string& metric,
                             int& missing);

/// One metric of two methods in the worlds of a condition; a world that was skipped for both is in none of these.
struct PairedWorlds {
  std::vector<Pair> pairs;  ///< both have a value
  int only_baseline = 0, only_method = 0, neither = 0;
  FailedWorlds
      failed;  ///< of only_method and only_baseline: where the other's cell failed, rather than having no such metric
};

/// Rows of one world share their trial.
PairedWorlds PairsOf(std::span<const Row* const> rows, const std::string& baseline, const std::string& method,
                     const std::string& metric);

/// What keys the dice of a comparison: stable under adding methods, metrics or conditions.
std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition, const std::string& metric,
                      const std::string& baseline, const std::string& method);

}  // namespace etude

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/sensor_fit/statistics.h"

namespace etude {

/// How two values of a statistic are held against each other.
enum class HeldBy { kRatio, kDifference };

struct StatisticRow {
  std::string name;
  std::string unit;
  HeldBy held_by;
  std::optional<double> value;
};

/// The statistics in the order in which they are told.
std::vector<StatisticRow> RowsOf(const SensorStatistics& statistics);

/// What a simulation has to reach: sizes within 30 % of real ones, correlations within 0.15.
constexpr double kSizeTolerance = 0.30, kCorrelationTolerance = 0.15;

/// How many of the rows that both columns have lie within these, and how many there are.
struct Agreement {
  int within = 0;
  int compared = 0;
};
Agreement AgreementOf(const SensorStatistics& reference, const SensorStatistics& other);

/// A table for people, a line per statistic and a column per recording, "-" for what one cannot tell. With `compares`,
/// the second column is held against the first: its ratio or difference, "!" where out of tolerance.
std::string StatisticsTable(const std::vector<std::pair<std::string, SensorStatistics>>& columns, bool compares);

}  // namespace etude

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/cell_result.h"
#include "bench/model/study.h"
#include "engine/base/result.h"

namespace etude {

/// Where a run of many cells keeps its rows, a folder per scenario.
constexpr const char* kColumnsFolder = "columns";
/// Where the times of its cells stand, alike.
constexpr const char* kTimesFolder = "timings";
/// Within a scenario's folder, the columns of curves: their values one behind the other, and of each row where they
/// end.
constexpr const char* kSeriesFolder = "series";
constexpr const char* kCurveEnds = ".ends";

/// What the rows of one scenario are made of beside their numbers: columns/SCENARIO/index.json.
struct ColumnIndex {
  static constexpr int kOwnReason = -1;  ///< a value is missing for the reason that the cell has
  /// What some rows have in common: which metrics, stages and curves, in which order, and why values are missing.
  struct Kind {
    std::vector<std::string> metrics;
    std::vector<std::optional<int>> why;  ///< of each metric without a value: its text, or kOwnReason
    std::vector<std::string> stages;
    std::vector<Series> series;  ///< without values
  };

  std::string scenario, task;
  std::vector<std::vector<SweptValue>> conditions;
  int trials = 0;
  std::vector<std::string> methods;
  std::vector<std::string> texts = {""};  ///< reasons, clips and units, which columns name by their place
  std::vector<Kind> kinds;

  std::size_t row_count() const { return conditions.size() * static_cast<std::size_t>(trials) * methods.size(); }
};

/// Fails, naming the path, when the file cannot be written.
Result<void> WriteColumnIndex(const std::filesystem::path& folder, const ColumnIndex& index);
/// Fails, naming the path, when there is none, or one that contradicts itself.
Result<ColumnIndex> ReadColumnIndex(const std::filesystem::path& folder);

std::filesystem::path ColumnFile(const std::filesystem::path& folder, const std::string& name);
std::string DigestColumn(const std::string& stage);

}  // namespace etude

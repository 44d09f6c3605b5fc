#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/recording.h"

namespace etude {

/// How a cell (world × method) ended. Every cell becomes a row with one of these.
enum class Status { kOk, kUnsolved, kFailed, kTimeout, kCrashed, kOutOfMemory, kBadOutput, kSkipped };
constexpr int kStatusCount = static_cast<int>(Status::kSkipped) + 1;

std::string_view StatusName(Status status);
/// Nothing when no status is called so.
std::optional<Status> FindStatus(std::string_view name);

/// One measured value of a cell; a missing value says why, and never counts as zero.
struct MetricValue {
  std::string id;  ///< an id of bench/metrics, unit in the name
  std::optional<double> value;
  std::string null_reason;  ///< only when `value` is empty
};

/// A curve of a cell: one value per frame or iteration, e.g. the error of each frame.
struct Series {
  std::string name;  ///< e.g. "mpjpe_mm"
  std::string axis;  ///< what the values are along: "frame", "iteration", "effector", "angle"
  std::vector<double> values;
  std::vector<std::string> names = {};  ///< of categories, where `values` are indices into them
};

/// What one method did in one world.
struct CellResult {
  Status status = Status::kFailed;
  std::string reason = "the task did not fill this cell";
  std::vector<MetricValue> metrics;
  /// Fingerprint of each stage's output, in order: the first one that differs names the culprit.
  std::vector<std::pair<std::string, std::string>> digests;
  std::vector<Series> series;
  std::optional<Recording> recording;

  /// A cell that ended without measurements.
  static CellResult Ended(Status status, std::string reason) {
    CellResult result;
    result.status = status;
    result.reason = std::move(reason);
    return result;
  }
  void Measure(std::string id, double value) { metrics.push_back({std::move(id), value, ""}); }
  void MeasureOr(std::string id, std::optional<double> value, std::string why_missing) {
    value ? Measure(std::move(id), *value) : Missing(std::move(id), std::move(why_missing));
  }
  void Missing(std::string id, std::string why) { metrics.push_back({std::move(id), std::nullopt, std::move(why)}); }
};

}  // namespace etude

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/clip_library.h"
#include "engine/document/fields.h"
#include "sim/random/stream.h"

namespace etude {

/// How a cell (world × method) ended. Every cell becomes a row with one of these.
enum class Status { kOk, kUnsolved, kFailed, kTimeout, kCrashed, kBadOutput, kSkipped };

std::string_view StatusName(Status status);

/// One measured value of a cell; a missing value says why, and never counts as zero.
struct MetricValue {
  std::string id;  ///< an id of bench/metrics, unit in the name
  std::optional<double> value;
  std::string null_reason;  ///< only when `value` is empty
};

/// A curve of a cell: one value per frame or iteration, e.g. the error of each frame.
struct Series {
  std::string name;  ///< e.g. "mpjpe_mm"
  std::string axis;  ///< "frame", "iteration"
  std::vector<double> values;
};

/// A named motion of a recording.
struct Track {
  std::string name;  ///< "truth", "recovered", "coach", …
  BodyMotion motion;
};

/// Everything needed to show a cell again without rerunning it: what a video draws.
struct Recording {
  std::vector<Track> tracks;
  /// Free-form facts for the viewer, as JSON text written by the task (cameras, masks, captions).
  std::string extras_json;
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
  void Missing(std::string id, std::string why) { metrics.push_back({std::move(id), std::nullopt, std::move(why)}); }
};

/// One scenario under one condition (one value of each swept parameter), ready to run any trial.
class Task {
 public:
  virtual ~Task() = default;

  /// Builds the world of `key` once and runs every method in it: one result per method, in order.
  /// A pure function of its arguments.
  virtual std::vector<CellResult> RunWorld(const WorldKey& key) const = 0;

  /// The name of the clip that this trial uses, or "" for tasks without clips.
  virtual std::string ClipOf(const WorldKey& key) const = 0;
};

/// What a scenario gives a task to make itself from.
struct TaskInput {
  Fields& condition;              ///< the scenario's mapping, swept keys replaced; the task reads its own keys
  std::span<const Node> methods;  ///< each a mapping with at least `name`
  const ClipLibrary& clips;
  bool wants_recordings = false;  ///< fill CellResult::recording
};

/// A kind of question that can be asked: one entry per folder of bench/tasks.
struct TaskKind {
  std::string name;
  std::string question;                      ///< one line, for `etude list`
  std::vector<std::string> default_metrics;  ///< the headline metrics of a report, most important first
  Result<std::unique_ptr<Task>> (*make)(TaskInput& input);
  /// The keys of its methods beside `name`, each with what it may say, for `etude list methods`.
  std::vector<std::pair<std::string, std::string>> method_keys = {};
};

}  // namespace etude

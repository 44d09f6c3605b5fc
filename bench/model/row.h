#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/named.h"

namespace etude {

/// The time and memory that one cell took on this machine.
struct CellUsage {
  double wall_s = 0;
  double cpu_s = 0;  ///< processor time of the worker and of the outside method
  /// The largest resident memory of the worker or of the outside method while the cell ran, MB. It is sampled, so cells
  /// that are shorter than the sampling interval may share one sample.
  double peak_mb = 0;
  /// The time to build the world, seconds. Only the first cell that ran in a world has it; it is 0 in the world's other
  /// cells.
  double world_wall_s = 0, world_cpu_s = 0;
};

/// The way in which a cell (world × method) ended. Every cell becomes a row with one of these statuses.
enum class Status { kOk, kUnsolved, kFailed, kTimeout, kCrashed, kOutOfMemory, kBadOutput, kSkipped };
inline constexpr std::array<Named<Status>, 8> kStatuses = {{{"ok", Status::kOk},
                                                            {"unsolved", Status::kUnsolved},
                                                            {"failed", Status::kFailed},
                                                            {"timeout", Status::kTimeout},
                                                            {"crashed", Status::kCrashed},
                                                            {"out_of_memory", Status::kOutOfMemory},
                                                            {"bad_output", Status::kBadOutput},
                                                            {"skipped", Status::kSkipped}}};

std::string_view StatusName(Status status);
/// Returns true if the status depends on the limits of the machine (timeout, crashed, out of memory). Another run of
/// the cell may then end with another status.
bool DependsOnMachine(Status status);
/// Returns the status with this name; nullopt if no status has it.
std::optional<Status> FindStatus(std::string_view name);

/// One measured value of a cell. A missing value has a reason and never counts as zero.
struct MetricValue {
  std::string id;  ///< id of a metric in bench/metrics; the id names the unit
  std::optional<double> value;
  std::string null_reason;  ///< why the value is missing; "" = the value exists
};

/// A curve of a cell: one value per frame or iteration, e.g. the error in each frame.
struct Series {
  std::string name;  ///< name of the curve, e.g. "mpjpe_mm"
  std::string axis;  ///< what the values are indexed by: "frame", "iteration", "effector", "angle"
  std::vector<double> values;
  std::vector<std::string> names = {};  ///< names of categories, if `values` are indices into these names
};

struct Track;  // Forward declaration: bench/model/recording.h defines Track and includes the headers of motions.

/// The motions and other data from which a cell can be shown again, e.g. in a film, without running it.
struct Recording {
  Recording();
  Recording(std::vector<Track> motions, std::string extras);
  Recording(const Recording&);
  Recording(Recording&&) noexcept;
  Recording& operator=(const Recording&);
  Recording& operator=(Recording&&) noexcept;
  ~Recording();

  std::vector<Track> tracks;
  /// Data besides the motions, as JSON text that the task writes (cameras, masks, captions).
  std::string extras_json;
};

/// The joints, rates and shares on which a cell's values were measured. Two methods are compared by a metric only if
/// they were judged alike (bench/statistics/judged_alike.h).
struct JudgedOn {
  std::vector<std::string> parts;  ///< what was judged, e.g. the names of joints; empty: the task does not say
  double rate_hz = 0;              ///< the rate of the answer's frames; 0: the task does not say
  /// By metric, the share of what the truth shows on which the value was measured. Metrics not listed have the share 1.
  std::vector<std::pair<std::string, double>> shares;
  /// The rate of the frames at which answer and truth are compared, which is lower than `rate_hz` if the truth has
  /// fewer frames; 0: `rate_hz`.
  double compared_hz = 0;

  double ShareOf(std::string_view metric) const;
  bool operator==(const JudgedOn&) const = default;
};

/// The beginning of the text of JudgedOn that names the root.
inline constexpr std::string_view kRootPart = "root ";

/// If the judged shares of two methods differ by at least this much on average, their values are not compared: one
/// frame in a hundred. The report, `etude compare` and `etude gate` use this limit.
inline constexpr double kMaxShareDifference = 0.01;

/// The result of one method in one world.
struct CellResult {
  Status status = Status::kFailed;
  std::string reason = "the task did not fill this cell";
  std::vector<MetricValue> metrics;
  /// The digest of each stage's output, in the order of the stages. The first digest that differs between two runs
  /// shows the stage at which the runs diverge.
  std::vector<std::pair<std::string, std::string>> digests;
  std::vector<Series> series;
  std::optional<Recording> recording;
  JudgedOn judged = {};

  /// Returns the result of a cell that ended without measurements.
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

/// A swept parameter and its value in one condition, both as the scenario wrote them.
struct SweptValue {
  std::string key;
  std::string value;
  bool operator==(const SweptValue&) const = default;
};

/// One line of cells.jsonl: a cell's identity and its result.
struct Row {
  std::string scenario;
  std::string task;
  std::vector<SweptValue> condition;  ///< the swept parameters and their values; empty if nothing is swept
  int trial = 0;
  std::string clip;  ///< name of the world's clip; "" for tasks without clips
  /// Sampling units (clips, people, …) from which the world was drawn (Study::unit); empty if the world is its own
  /// unit.
  std::vector<std::string> units;
  std::string method;
  CellResult result;  ///< the result; `series` and `recording` are stored in files of their own

  /// Returns the cell's identity "scenario/key=value,key=value/trial/method", which is unique in a run. If nothing is
  /// swept, the condition is "-".
  std::string Id() const;
};

/// Returns a row's value of a metric; nullopt if the value is missing or the metric was not measured.
std::optional<double> ValueOf(const Row& row, std::string_view metric);

/// Returns a condition as text for display: "key=value, key=value", or "" if nothing is swept.
std::string ConditionLabel(const std::vector<SweptValue>& condition);
/// Returns a condition as text in a cell's identity: "key=value,key=value", or "-" if nothing is swept.
std::string CompactLabel(const std::vector<SweptValue>& condition);

}  // namespace etude

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/model/summary.h"

namespace etude {

/// The rows of a run that is too large to be held in memory, in canonical order: scenario, condition, trial, method.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual std::size_t size() const = 0;
  /// The places of all rows of whole worlds at equal steps, about so many rows or all that there are.
  virtual std::vector<std::size_t> PlacesAtEqualSteps(std::size_t rows) const = 0;
  /// Makes `row` the one at this place, whatever it was; its memory is used again. Without series and recording.
  virtual void Read(std::size_t place, Row& row) const = 0;
  virtual std::vector<Series> SeriesOf(std::size_t place) const = 0;
  /// Processor time of the cell; nothing where the folder tells of none.
  virtual std::optional<double> CpuSecondsOf(std::size_t place) const = 0;
};

struct CellSeries {
  std::string cell;  ///< Row::Id()
  std::vector<Series> series;
};

struct CellRecording {
  std::string cell;
  Recording recording;
};

/// What a result may depend on beside this program, as a run's manifest tells.
struct RunSystem {
  std::string compiler;  ///< "12.2.0"
  std::string glibc;     ///< "2.36"
  std::string ceres;     ///< "2.1.0"
  std::string renderer;  ///< "4.5 (Core Profile) Mesa 22.3.6, by OSMesa"; "" where nothing was drawn
  friend bool operator==(const RunSystem&, const RunSystem&) = default;
};

/// A whole result folder in memory; of a run of many cells some of its worlds, and a way to all others.
struct RunData {
  std::string suite;
  std::uint64_t seed = 1;  ///< of secret worlds a number that their key's digest makes
  std::string key_digest;  ///< of secret worlds; else ""
  std::string fence;       ///< what programs that are methods ran in; "" = there were none
  std::string program_version;
  std::string command_line;  ///< from host.json
  std::string host;          ///< one line about the machine
  RunSystem system;
  double wall_seconds = 0;
  std::vector<Row> rows;  ///< canonical order: scenario, condition, trial, method
  /// All rows, when there are too many to be held; `rows`, `series` and `cpu_seconds` are then those of whole worlds at
  /// equal steps.
  std::shared_ptr<const RowSource> source;
  std::vector<ScenarioSummary> scenarios;
  std::vector<CellSeries> series;
  std::vector<CellRecording> recordings;
  std::string seal;      ///< the text of its seal; "" = it has none, or was not loaded
  std::string unsealed;  ///< why the folder is not as the run wrote it, when it was read all the same; else ""
  std::map<std::string, double> cpu_seconds;  ///< processor time, by Row::Id(); empty where the folder tells of none
};

/// Says what the worlds were drawn by, and whether a program that was asked could have known it: "seed 1", "seed 1,
/// open worlds", "secret worlds, key 0123456789abcdef…". Under a sweep secret worlds of two conditions are not the
/// same, which it says, too: a difference between conditions is then one between other worlds.
std::string DescribeWorlds(const RunData& run);

std::size_t CountRows(const RunData& run);
/// Hands on every row of the run, also those that are not held, and its place.
void ForEachRow(const RunData& run, const std::function<void(const Row& row, std::size_t place)>& use);
Row RowAt(const RunData& run, std::size_t place);
/// The place of the row of this identity; nothing where there is none.
std::optional<std::size_t> FindRow(const RunData& run, const std::string& id);
/// Processor time of a row at its place; nothing where the folder tells of none.
std::optional<double> CpuSecondsOf(const RunData& run, const Row& row, std::size_t place);

}  // namespace etude

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

/// The rows of a run that does not fit into memory, in canonical order: scenario, condition, trial, method. `place` is
/// the index of a row in this order.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual std::size_t size() const = 0;
  /// Chooses evenly spaced worlds and returns the indices of all their rows. The result has about `rows` indices. If
  /// the run has fewer rows, the result has the indices of all rows. A source of OpenTextRows returns no indices.
  virtual std::vector<std::size_t> SampleRowIndices(std::size_t rows) const = 0;
  /// Replaces `row` by the row at index `place`, reusing its memory. Series and recording are not read.
  virtual void Read(std::size_t place, Row& row) const = 0;
  virtual std::vector<Series> SeriesOf(std::size_t place) const = 0;
  /// Returns the processor time of the cell at index `place`, seconds; nullopt if the result folder does not record it.
  virtual std::optional<double> CpuSecondsOf(std::size_t place) const = 0;
};

struct CellSeries {
  std::string cell;  ///< identity of the cell (Row::Id)
  std::vector<Series> series;
};

struct CellRecording {
  std::string cell;
  Recording recording;
};

/// The software, apart from this program, on which a result may depend. The run's manifest records it.
struct RunSystem {
  std::string compiler;  ///< version of the compiler, e.g. "12.2.0"
  std::string glibc;     ///< version, e.g. "2.36"
  std::string ceres;     ///< version, e.g. "2.1.0"
  /// The OpenGL version, e.g. "4.5 (Core Profile) Mesa 22.3.6, by OSMesa"; "" = nothing was drawn.
  std::string renderer;
  friend bool operator==(const RunSystem&, const RunSystem&) = default;
};

/// A result folder in memory. `rows` contains all rows, but if the run is very large, only the rows of some worlds;
/// `source` then reads all rows one by one.
struct RunData {
  std::string suite;
  std::uint64_t seed = 1;  ///< seed of the worlds; for secret worlds, a number derived from `key_digest`
  std::string key_digest;  ///< digest of the key of secret worlds; "" if worlds are not secret
  std::string fence;       ///< description of the sandbox in which outside methods ran; "" = no outside method
  std::string program_version;
  std::string command_line;  ///< the command line of the run, as host.json records it
  std::string host;          ///< description of the machine in one line
  RunSystem system;
  double wall_seconds = 0;
  std::vector<Row> rows;  ///< rows in canonical order: scenario, condition, trial, method
  /// The source of all rows if the run does not fit into memory, else null. If it is set, `rows`, `series` and
  /// `cpu_seconds` contain only the data of some evenly spaced worlds; after LoadRunRowByRow they are empty.
  std::shared_ptr<const RowSource> source;
  std::vector<ScenarioSummary> scenarios;
  std::vector<CellSeries> series;
  std::vector<CellRecording> recordings;
  std::string seal;      ///< the content of the folder's seal.json; "" = the file does not exist, or was not loaded
  std::string unsealed;  ///< why the files do not match the seal, if the folder was read nevertheless; else ""
  /// Processor times of cells, by Row::Id(); empty if the result folder does not record them.
  std::map<std::string, double> cpu_seconds;
};

/// Returns a text that says how the worlds were drawn and whether an outside program could have known them: "seed 1",
/// "seed 1, open worlds", "secret worlds, key 0123456789abcdef…". The text also says if the conditions of a sweep have
/// different worlds, because then the worlds add to the difference between conditions. Secret worlds always differ
/// between conditions.
std::string DescribeWorlds(const RunData& run);

/// Returns the number of rows of the run, including those that are not in memory.
std::size_t CountRows(const RunData& run);
/// Calls `use` for every row of the run with the row's index, including rows that are not in memory.
void ForEachRow(const RunData& run, const std::function<void(const Row& row, std::size_t place)>& use);
/// The series with one name that the cells of one method under one condition of a scenario contain.
struct SeriesGroup {
  std::string place;  ///< "scenario/condition/name"; keys random streams, so it names no method
  std::vector<SweptValue> condition;
  std::string method, name;
  std::vector<std::vector<double>> values;  ///< one list for each cell
  std::vector<std::string> units;           ///< each cell's unit: the person, or the clip if the cell names no person
};

/// Groups the series with this axis of all rows, including rows that are not in memory. The groups are in the order in
/// which they first occur.
std::vector<SeriesGroup> GroupSeries(const RunData& run, const std::string& axis);
/// Returns the row at index `place`. A row that is read from `source` has no series and no recording.
Row RowAt(const RunData& run, std::size_t place);
/// Returns the index of the row with this identity (Row::Id); nullopt if no row has it.
std::optional<std::size_t> FindRow(const RunData& run, const std::string& id);
/// Returns the processor time of the row at index `place`, seconds; nullopt if the result folder does not record it.
std::optional<double> CpuSecondsOf(const RunData& run, const Row& row, std::size_t place);

}  // namespace etude

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/model/run_data.h"
#include "bench/model/study.h"
#include "bench/results/npy.h"
#include "engine/base/cyclic_lookup.h"
#include "engine/base/result.h"

namespace etude {

/// The folder in which a run of many cells keeps its rows, one folder per scenario.
constexpr const char* kColumnsFolder = "columns";
/// The folder of the times of its cells, laid out alike.
constexpr const char* kTimesFolder = "timings";
/// The columns of curves within a scenario's folder: their values one behind the other, and the end of each row's
/// curve.
constexpr const char* kSeriesFolder = "series";
constexpr const char* kCurveEnds = ".ends";

/// The texts that the rows of one scenario share, beside their numbers: columns/SCENARIO/index.json.
struct ColumnIndex {
  static constexpr int kOwnReason = -1;  ///< a value is missing for the reason that the cell has
  /// The shape that some rows have in common: which metrics, stages and curves, in which order, and why values are
  /// missing.
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

  /// The shape of arrays with a number for each row.
  std::vector<std::size_t> shape() const {
    return {conditions.size(), static_cast<std::size_t>(trials), methods.size()};
  }
  std::size_t row_count() const { return conditions.size() * static_cast<std::size_t>(trials) * methods.size(); }
};

/// Fails, naming the path, when the file cannot be written.
Result<void> WriteColumnIndex(const FilePath& folder, const ColumnIndex& index);
/// Fails, naming the path, when there is none, or one that contradicts itself.
Result<ColumnIndex> ReadColumnIndex(const FilePath& folder);

FilePath ColumnFile(const FilePath& folder, const std::string& name);
std::string DigestColumn(const std::string& stage);

/// The file of a scenario's index, in its folder.
constexpr const char* kIndexFile = "index.json";
/// The files that hold the columns and times of a scenario, from the run's folder.
std::set<std::filesystem::path> FilesOfColumns(const ColumnIndex& index);

/// Columns of one kind of number. Rows of which nothing is put into one hold `fill` there.
template <typename Number>
class NpyColumns {
 public:
  NpyColumns(FilePath folder, Number fill) : folder_(std::move(folder)), fill_(fill) {}
  Result<void> Put(std::size_t row, const std::string& name, Number number);
  Result<void> Finish(const std::vector<std::size_t>& shape);

 private:
  Result<void> FillUp(std::size_t rows, NpyWriter& writer) const;

  FilePath folder_;
  Number fill_;
  CyclicLookup<NpyWriter> columns_;
};

/// Writes the rows of one scenario as columns of numbers, one file each, that NumPy reads (docs/results.md). The arrays
/// are indexed by condition, trial and method.
class ColumnWriter {
 public:
  ColumnWriter(const std::filesystem::path& folder, const Study& study);

  /// The next row, in canonical order.
  Result<void> Add(const Row& row, const CellUsage& usage);
  /// Writes what is left; to be called once there are all rows.
  Result<void> Finish();

 private:
  /// The values of one curve of all rows one behind the other, and where each row's end.
  struct Curve {
    NpyWriter values, ends;
    Result<void> FillUp(std::size_t rows);
  };

  Result<void> AddSeries(const Series& series);
  std::uint32_t TextOf(const std::string& text);
  std::uint32_t KindOf(const Row& row);

  FilePath folder_;
  ColumnIndex index_;
  std::size_t rows_ = 0;
  std::map<std::string, std::uint32_t> text_places_;
  std::uint32_t last_kind_ = 0;
  NpyColumns<double> values_;
  NpyColumns<std::uint64_t> digests_;
  NpyColumns<std::uint32_t> places_;  ///< of texts and kinds
  NpyColumns<std::uint8_t> statuses_;
  NpyColumns<float> times_;
  CyclicLookup<Curve> curves_;
};

/// Opens the columns of a run; rows, in canonical order, are made of them one at a time. Fails, naming the file, when
/// one is missing, or leads out of what is there.
Result<std::shared_ptr<const RowSource>> OpenColumns(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& scenarios);

}  // namespace etude

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

/// The name of the folder in which a run with many cells stores its rows as columns. It contains one folder per
/// scenario.
constexpr const char* kColumnsFolder = "columns";
/// The name of the folder with the cells' times. It has the layout of kColumnsFolder.
constexpr const char* kTimesFolder = "timings";
/// The name of the folder with the curves. Each curve is two files: the values of all rows, and the index at which each
/// row's values end.
constexpr const char* kSeriesFolder = "series";
constexpr const char* kCurveEnds = ".ends";

/// Everything about the rows of one scenario that is not a number. It is stored in columns/SCENARIO/index.json.
struct ColumnIndex {
  static constexpr int kOwnReason = -1;  ///< the value is missing for the row's reason, CellResult::reason
  /// The data that several rows share: their metrics, stages and curves, in order, and the reasons of missing values.
  struct Kind {
    std::vector<std::string> metrics;
    std::vector<std::optional<int>> why;  ///< per metric: an index in `texts`, or kOwnReason; nullopt if it has a value
    std::vector<std::string> stages;
    std::vector<Series> series;  ///< the curves, without their values
  };

  std::string scenario, task;
  std::vector<std::vector<SweptValue>> conditions;
  int trials = 0;
  std::vector<std::string> methods;
  std::vector<std::string> texts = {""};  ///< reasons, clips and units; columns contain indices of these texts
  std::vector<Kind> kinds;

  std::vector<std::size_t> shape() const {
    return {conditions.size(), static_cast<std::size_t>(trials), methods.size()};
  }
  std::size_t row_count() const { return conditions.size() * static_cast<std::size_t>(trials) * methods.size(); }
};

/// Writes index.json. Fails, naming the path, if the file cannot be written.
Result<void> WriteColumnIndex(const FilePath& folder, const ColumnIndex& index);
/// Reads index.json. Fails, naming the path, if the file is missing or contradicts itself.
Result<ColumnIndex> ReadColumnIndex(const FilePath& folder);

FilePath ColumnFile(const FilePath& folder, const std::string& name);
std::string DigestColumn(const std::string& stage);

constexpr const char* kIndexFile = "index.json";
/// Returns the files of a scenario's columns and times, relative to the run's folder.
std::set<std::filesystem::path> FilesOfColumns(const ColumnIndex& index);

/// Writes columns that hold one type of number. A row that has no value in a column gets `fill` there.
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

/// Writes the rows of one scenario as NumPy arrays over condition, trial and method, one file each (docs/results.md).
class ColumnWriter {
 public:
  ColumnWriter(const std::filesystem::path& folder, const Study& study);

  /// Adds the next row, in canonical order.
  Result<void> Add(const Row& row, const CellUsage& usage);
  /// Writes the remaining data. Must be called after the last row.
  Result<void> Finish();

 private:
  /// The values of one curve for all rows, one row after the other, and the end of each row's values.
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
  std::map<std::string, std::uint32_t> text_indices_;
  std::uint32_t last_kind_ = 0;
  NpyColumns<double> values_;
  NpyColumns<std::uint64_t> digests_;
  NpyColumns<std::uint32_t> indices_;  ///< indices of texts and kinds
  NpyColumns<std::uint8_t> statuses_;
  NpyColumns<float> times_;
  CyclicLookup<Curve> curves_;
};

/// Opens the columns of a run. The returned source makes rows from the columns one at a time, in canonical order.
/// Fails, naming the file, if a column is missing or contains an index that is out of range.
Result<std::shared_ptr<const RowSource>> OpenColumns(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& scenarios);

}  // namespace etude

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/cell_usage.h"
#include "bench/model/row_source.h"
#include "bench/model/study.h"
#include "bench/results/npy.h"

namespace etude {

/// Where a run of many cells keeps its rows, a folder per scenario.
constexpr const char* kColumnsFolder = "columns";
/// Where the times of its cells stand, alike.
constexpr const char* kTimesFolder = "timings";

/// What the rows of one scenario are made of beside their numbers: columns/SCENARIO/index.json.
struct ColumnIndex {
  /// What some rows have in common: which metrics, stages and curves, in which order, and why values are missing.
  struct Kind {
    std::vector<std::string> metrics;
    std::vector<std::optional<int>> why;  ///< of each metric without a value: its text, −1 = the cell's own reason
    std::vector<std::string> stages;
    std::vector<std::pair<std::string, std::string>> series;  ///< name and axis
    bool operator==(const Kind&) const = default;
  };

  std::string scenario, task;
  std::vector<std::vector<SweptValue>> conditions;
  int trials = 0;
  std::vector<std::string> methods;
  std::vector<std::string> texts = {""};  ///< reasons, clips and units, which columns name by their place
  std::vector<Kind> kinds;

  std::size_t row_count() const { return conditions.size() * static_cast<std::size_t>(trials) * methods.size(); }
};

/// Columns of one kind of number. Rows of which nothing is put into one hold `fill` there.
template <typename Number>
class NpyColumns {
 public:
  NpyColumns(std::filesystem::path folder, Number fill) : folder_(std::move(folder)), fill_(fill) {}
  Result<void> Put(std::size_t row, const std::string& name, Number number);
  Result<void> Finish(const std::vector<std::size_t>& shape);

 private:
  Result<void> FillUp(std::size_t rows, NpyWriter& writer) const;

  std::filesystem::path folder_;
  Number fill_;
  std::map<std::string, NpyWriter> columns_;
};

/// Writes the rows of one scenario as columns of numbers, one file each, that NumPy reads (docs/results.md). The arrays
/// are indexed by condition, trial and method.
class ColumnWriter {
 public:
  ColumnWriter(const std::filesystem::path& folder, const Study& study);

  /// The next row, in canonical order.
  Result<void> Add(const Row& row, const CellUsage& usage);
  /// Once there are all rows.
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

  std::filesystem::path folder_;
  ColumnIndex index_;
  std::size_t rows_ = 0;
  std::map<std::string, std::uint32_t> text_places_;
  std::uint32_t last_kind_ = 0;
  NpyColumns<double> values_;
  NpyColumns<std::uint64_t> digests_;
  NpyColumns<std::uint32_t> places_;  ///< of texts and kinds
  NpyColumns<std::uint8_t> statuses_;
  NpyColumns<float> times_;
  std::map<std::string, Curve> curves_;
};

/// Opens the columns of a run; rows, in canonical order, are made of them one at a time.
Result<std::shared_ptr<const RowSource>> OpenColumns(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& scenarios);

}  // namespace etude

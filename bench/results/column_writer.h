#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/model/cell_usage.h"
#include "bench/model/row.h"
#include "bench/model/study.h"
#include "bench/results/column_index.h"
#include "bench/results/npy.h"
#include "engine/base/cyclic_lookup.h"

namespace etude {

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
  CyclicLookup<NpyWriter> columns_;
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
  CyclicLookup<Curve> curves_;
};

}  // namespace etude

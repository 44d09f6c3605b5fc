#include "engine/switching/choices/diagonal_sums.h"

#include <bit>

namespace etude {

DiagonalSums::DiagonalSums(int first_row, int columns, int depth)
    : first_row_(first_row),
      next_row_(first_row),
      columns_(columns),
      depth_(static_cast<int>(std::bit_ceil(static_cast<unsigned>(depth)))),
      sums_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(depth_)) {}

std::span<double> DiagonalSums::Row(int row) {
  return std::span(sums_).subspan(Start(row), static_cast<std::size_t>(columns_));
}

std::span<double> DiagonalSums::OpenRow() { return Row(next_row_); }

void DiagonalSums::CloseRow() {
  if (next_row_ > first_row_) {
    const std::span<double> above = Row(next_row_ - 1), row = Row(next_row_);
    for (std::size_t c = 1; c < row.size(); ++c) row[c] += above[c - 1];
  }
  ++next_row_;
}

}  // namespace etude

#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace etude {

/// Sums along the diagonals of a table of two clips' frames, whose rows come one after the other: what two stretches of
/// motion that run side by side have in common. Each sum takes two look-ups, however long the stretch. `Value` is a
/// number or a vector of numbers.
template <class Value>
class DiagonalSums {
 public:
  /// Keeps the last `depth` rows (up to the next power of two), which bounds the memory; the first row will be
  /// `first_row`.
  DiagonalSums(int first_row, int columns, int depth)
      : first_row_(first_row),
        next_row_(first_row),
        columns_(columns),
        depth_(static_cast<int>(std::bit_ceil(static_cast<unsigned>(depth)))),
        sums_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(depth_)) {}

  /// Room for the next row's values; CloseRow counts them in.
  std::span<Value> OpenRow() { return Row(next_row_); }
  void CloseRow() {
    if (next_row_ > first_row_) {
      const std::span<Value> above = Row(next_row_ - 1), row = Row(next_row_);
      for (std::size_t c = 1; c < row.size(); ++c) row[c] += above[c - 1];
    }
    ++next_row_;
  }
  int NextRow() const { return next_row_; }

  /// The sum of `count` values that end at (row, column) and go up along the diagonal, which must stay in the table.
  /// Row − `count` must be among the kept rows, or before the first.
  Value SumEndingAt(int row, int column, int count) const { return At(row, column) - At(row - count, column - count); }

 private:
  std::size_t Start(int row) const {
    return static_cast<std::size_t>((row - first_row_) & (depth_ - 1)) * static_cast<std::size_t>(columns_);
  }
  std::span<Value> Row(int row) { return std::span(sums_).subspan(Start(row), static_cast<std::size_t>(columns_)); }
  /// Everything on the diagonal down to here; 0 outside.
  Value At(int row, int column) const {
    if (row < first_row_ || column < 0) return Value(0);
    assert(row < next_row_ && row >= next_row_ - depth_ && column < columns_);
    return sums_[Start(row) + static_cast<std::size_t>(column)];
  }

  int first_row_, next_row_, columns_;
  int depth_;                ///< a power of two: places in the ring are found without dividing
  std::vector<Value> sums_;  ///< a ring of rows
};

/// How far a stretch around a pair of frames reaches, both sides alike in both clips, as far as both clips go.
struct Reach {
  int before = 0, after = 0;

  int Count() const { return before + 1 + after; }
};
inline Reach ReachAround(int frame_a, int frames_a, int frame_b, int frames_b, int half) {
  return {.before = std::min({half, frame_a, frame_b}),
          .after = std::min({half, frames_a - 1 - frame_a, frames_b - 1 - frame_b})};
}

}  // namespace etude

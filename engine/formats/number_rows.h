#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A table of numbers as text: one line a row, values apart by blanks, tabs, commas or semicolons.
struct NumberRows {
  std::string heading;  ///< the first line that is neither empty nor a remark, when it holds no numbers
  std::size_t columns = 0;
  std::vector<double> values;  ///< row by row; NaN where a value is missing
  std::vector<int> lines;      ///< where each row stands in the text, from 1

  std::size_t RowCount() const { return columns == 0 ? 0 : values.size() / columns; }
  std::span<const double> Row(std::size_t row) const { return std::span(values).subspan(row * columns, columns); }
};

/// The largest text that is read, bytes: an hour of a Kinect v2's 25 joints is 170 MB; this is some twenty minutes.
constexpr std::size_t kLargestNumberText = std::size_t{64} << 20;

/// Reads such a text. Empty lines and lines that begin with '#' or "//" are skipped; "nan" in any case, and nothing
/// between two commas, is a missing value. Refused, with the line and column: rows of different lengths, words,
/// infinity, numbers beyond ±`largest` (clocks may need more than places do), no rows at all, more than
/// `kLargestNumberText` bytes.
Result<NumberRows> ReadNumberRows(std::string_view text, const std::string& file, double largest = 1e9);

}  // namespace etude

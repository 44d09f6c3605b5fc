#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A table of numbers as text, with one line per row and values separated by spaces, tabs, commas or semicolons.
struct NumberRows {
  std::string heading;  ///< the first line that is not empty or a comment, if it is not a row of numbers
  std::size_t columns = 0;
  std::vector<double> values;  ///< row by row; NaN for a missing value
  std::vector<int> lines;      ///< per row: its line in the text, from 1

  std::size_t RowCount() const { return columns == 0 ? 0 : values.size() / columns; }
  std::span<const double> Row(std::size_t row) const { return std::span(values).subspan(row * columns, columns); }
};

/// The maximum size of a text in bytes. It is enough for about twenty minutes of a Kinect v2's 25 joints; an hour takes
/// 170 MB.
constexpr std::size_t kMaxNumberTextBytes = std::size_t{64} << 20;

/// Reads a table of numbers. Empty lines and lines that begin with '#' or "//" are skipped. "nan" in any case, or
/// nothing between two commas, is a missing value. Returns an error with line and column for rows of different lengths,
/// words, infinity, numbers beyond ±`largest` (times may need a larger limit than positions), no rows, or more than
/// `kMaxNumberTextBytes` bytes.
Result<NumberRows> ReadNumberRows(std::string_view text, const std::string& file, double largest = 1e9);

}  // namespace etude

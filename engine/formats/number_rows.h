#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A table of numbers as text, with one line per row and values separated by spaces, tabs, commas or semicolons.
struct NumberRows {
  std::string heading;  ///< the first line that is neither empty nor a comment, unless it is a row of numbers
  std::size_t columns = 0;
  std::vector<double> values;  ///< the numbers, row by row; NaN for a missing value
  std::vector<int> lines;      ///< line of each row in the text, from 1
  bool has_decimal_commas = false;
  char separator = 0;  ///< ';' or a tab if rows are split only at it; 0: the separator is found in each row
  /// The columns that contain texts, each with its first text; all values of these columns are NaN.
  std::vector<std::pair<std::size_t, std::string>> texts = {};

  std::size_t RowCount() const { return columns == 0 ? 0 : values.size() / columns; }
  std::span<const double> Row(std::size_t row) const { return std::span(values).subspan(row * columns, columns); }
};

/// The maximum size of a text in bytes. It is enough for about twenty minutes of a Kinect v2's 25 joints; an hour takes
/// 170 MB.
constexpr std::size_t kMaxNumberTextBytes = std::size_t{64} << 20;

/// Reads a table of numbers. Empty lines and lines that begin with '#' or "//" are skipped. A missing value is "nan",
/// "na", "n/a" or "null" in any case, or nothing between two commas or after the last comma. If the heading contains
/// semicolons or tabs but no commas, rows that contain this separator are split only at it, and a comma within a
/// number is a decimal comma. The same holds without a heading if the first row, split only at it, consists of numbers;
/// commas that separate thousands are refused (CommaUse). Quotes around a value are ignored. Returns an error, with the
/// position as far as it is known, for a word, for infinity, for a number beyond ±`largest` (times may need a larger
/// limit than positions), for rows of different lengths, for a table without rows, and for more than
/// `kMaxNumberTextBytes` bytes. If `allows_texts`, up to a hundred columns whose first value is a word are columns of
/// texts.
Result<NumberRows> ReadNumberRows(std::string_view text, const std::string& file, double largest = 1e9,
                                  bool allows_texts = false);

/// Returns the headings of a table, without blanks and quotes.
std::vector<std::string> HeadingsOf(std::string_view heading);

}  // namespace etude

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Formats a text as a field of a CSV file (RFC 4180), quoted if necessary. Hidden and control characters are made
/// visible (Visible), and a text that a spreadsheet would read as a formula is prefixed with an apostrophe. Do not use
/// it for numbers.
std::string CsvText(std::string_view text);

/// A row of a CSV file, and its line in the file, from 1.
struct CsvRow {
  std::vector<std::string> cells;
  int line = 0;
};

/// Splits a CSV text into rows of cells, as spreadsheets, R and Python write it. Cells are separated by commas; if the
/// first row has none, by semicolons or tabs. A cell may be in quotes, with doubled quotes inside. Blanks around a
/// cell, empty lines and a byte order mark are ignored. Fails if a quoted cell does not end on its line.
Result<std::vector<CsvRow>> ReadCsv(std::string_view text, const std::string& file);

}  // namespace etude

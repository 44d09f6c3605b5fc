#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Formats a text as a field of a CSV file (RFC 4180), quoted if necessary. Hidden and control characters are made
/// visible (Visible), and a text that a spreadsheet would read as a formula is prefixed with an apostrophe. Do not use
/// it for numbers.
std::string CsvText(std::string_view text);

}  // namespace etude

#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Writes a text as a field of a CSV file (RFC 4180), in quotes where it must be. What is hidden or commands a terminal
/// is shown (Visible), and a text that a spreadsheet would take for a formula gets a ' before it; numbers are not
/// written through this.
std::string CsvText(std::string_view text);

}  // namespace etude

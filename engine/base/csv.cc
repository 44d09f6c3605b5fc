#include "engine/base/csv.h"

#include <algorithm>
#include <array>
#include <optional>

#include "engine/base/text.h"
#include "engine/base/utf8.h"

namespace etude {
namespace {

/// Returns true if a spreadsheet would read the text as a formula. Only the first character matters; spreadsheets skip
/// spaces before it, and some also accept its full-width form.
bool BeginsFormula(std::string_view text) {
  constexpr std::array<char32_t, 8> kSigns = {'=', '+', '-', '@', 0xff1d, 0xff0b, 0xff0d, 0xff20};
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return !text.empty() && std::ranges::find(kSigns, FirstCharacter(text).code) != kSigns.end();
}

/// Takes the first cell and the separator behind it off a row. Sets `is_last` if no separator is behind it. Returns
/// nullopt if the cell begins with a quote and does not end with one.
std::optional<std::string> TakeCell(std::string_view& row, char separator, bool& is_last) {
  std::string cell;
  row.remove_prefix(std::min(row.find_first_not_of(separator == '\t' ? " " : " \t"), row.size()));
  const bool is_quoted = row.starts_with('"');
  if (is_quoted) {
    row.remove_prefix(1);
    while (true) {
      const std::size_t quote = row.find('"');
      if (quote == std::string_view::npos) return std::nullopt;
      cell += row.substr(0, quote);
      row.remove_prefix(quote + 1);
      if (!row.starts_with('"')) break;
      cell += '"';
      row.remove_prefix(1);
    }
  }
  const std::size_t end = row.find(separator);
  const std::string_view rest = Trimmed(row.substr(0, end));
  is_last = end == std::string_view::npos;
  row.remove_prefix(is_last ? row.size() : end + 1);
  if (is_quoted && !rest.empty()) return std::nullopt;
  return cell + std::string(rest);
}

}  // namespace

std::string CsvText(std::string_view text) {
  std::string field = Visible(text);
  if (BeginsFormula(field)) field.insert(0, 1, '\'');
  if (field.find_first_of(",;\"") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

Result<std::vector<CsvRow>> ReadCsv(std::string_view text, const std::string& file) {
  text = WithoutByteOrderMark(text);
  std::vector<CsvRow> rows;
  char separator = 0;
  for (int line = 0; !text.empty();) {
    std::string_view row = TakeLine(text, line);
    if (Trimmed(row).empty()) continue;
    const auto has = [row](char c) { return row.find(c) != std::string_view::npos; };
    if (separator == 0) separator = has(',') ? ',' : has(';') ? ';' : has('\t') ? '\t' : ',';
    rows.push_back({{}, line});
    for (bool is_last = false; !is_last;) {
      const auto cell = TakeCell(row, separator, is_last);
      if (!cell) return Fail({file, line}, "cell {} has no closing quotation mark", rows.back().cells.size() + 1);
      rows.back().cells.push_back(*cell);
    }
  }
  return rows;
}

}  // namespace etude

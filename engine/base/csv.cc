#include "engine/base/csv.h"

#include <algorithm>
#include <array>

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

}  // namespace

std::string CsvText(std::string_view text) {
  std::string field = Visible(text);
  if (BeginsFormula(field)) field.insert(0, 1, '\'');
  if (field.find_first_of(",;\"") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace etude

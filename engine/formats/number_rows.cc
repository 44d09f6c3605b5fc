#include "engine/formats/number_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"

namespace etude {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool IsRowBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool IsComma(char c) { return c == ',' || c == ';'; }

/// Returns the words of one line; between commas they may be empty.
std::vector<std::string_view> WordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  const bool by_comma = line.find_first_of(",;") != std::string_view::npos;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && !(by_comma ? IsComma(line[i]) : IsRowBlank(line[i]))) continue;
    const std::string_view word = Trimmed(line.substr(start, i - start));
    if (by_comma || !word.empty()) words.push_back(word);
    start = i + 1;
  }
  if (by_comma && !words.empty() && words.back().empty()) words.pop_back();  // "1,2,3,"
  return words;
}

bool MeansMissing(std::string_view word) {
  constexpr std::string_view kNan = "nan";
  if (word.empty()) return true;
  const auto same = [](char a, char b) { return (a | 0x20) == b; };
  return std::ranges::equal(word, kNan, same) || (word[0] == '-' && std::ranges::equal(word.substr(1), kNan, same));
}

std::optional<double> NumberOf(std::string_view word) {
  if (MeansMissing(word)) return kMissing;
  if (word.front() == '+') word.remove_prefix(1);
  return ParseNumber<double>(word);
}

bool IsRemark(std::string_view line) { return line.empty() || line.starts_with('#') || line.starts_with("//"); }

}  // namespace

Result<NumberRows> ReadNumberRows(std::string_view text, const std::string& file, double largest) {
  if (text.size() > kMaxNumberTextBytes) {
    return Fail({file}, "{} bytes; allowed: at most {}", text.size(), kMaxNumberTextBytes);
  }
  // Skip a byte order mark, then read line by line.
  text = WithoutByteOrderMark(text);
  NumberRows table;
  for (int line_number = 1; !text.empty(); ++line_number) {
    const char* const line_start = text.data();
    const std::string_view line = Trimmed(TakeLine(text));
    if (IsRemark(line)) continue;
    const std::vector<std::string_view> words = WordsOf(line);
    // The first line may be a heading.
    if (table.columns == 0 && table.heading.empty() && !NumberOf(words.front())) {
      table.heading = line;
      continue;
    }
    // Refuse a row that has another number of values than the first.
    if (table.columns == 0) table.columns = words.size();
    if (words.size() != table.columns) {
      return Fail({file, line_number}, "{} values, but earlier rows have {}", words.size(), table.columns);
    }
    table.lines.push_back(line_number);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto value = NumberOf(words[i]);
      if (!value || std::abs(*value) > largest) {
        const int column = static_cast<int>(words[i].data() - line_start) + 1;
        return Fail({file, line_number, column},
                    "value {}: {}; allowed: a number within ±{:g}, or nan for a missing one", i + 1, Quote(words[i]),
                    largest);
      }
      table.values.push_back(*value);
    }
  }
  if (table.columns == 0) return Fail({file}, "no rows of numbers");
  return table;
}

}  // namespace etude

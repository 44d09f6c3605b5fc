#include "engine/formats/number_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/comma_use.h"

namespace etude {
namespace {

constexpr double kMaxPosition = 1e9;  // limit of positions, in any unit
constexpr std::size_t kMaxTextColumns = 100;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool IsRowBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool IsComma(char c) { return c == ',' || c == ';'; }

/// Returns the separator of a heading without commas: ';' if the heading contains one, else a tab if it contains one.
/// Returns 0 for any other heading; then the separator is found in each row.
char SeparatorOf(std::string_view heading) {
  if (heading.find(',') != std::string_view::npos) return 0;
  if (heading.find(';') != std::string_view::npos) return ';';
  return heading.find('\t') != std::string_view::npos ? '\t' : '\0';
}

/// Returns the words of one line. Words between commas, semicolons or the heading's `separator` may be empty.
std::vector<std::string_view> WordsOf(std::string_view line, char separator) {
  std::vector<std::string_view> words;
  const bool is_told = separator != 0 && line.find(separator) != std::string_view::npos;
  const bool by_comma = is_told || line.find_first_of(",;") != std::string_view::npos;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const auto ends = [&](char c) { return is_told ? c == separator : by_comma ? IsComma(c) : IsRowBlank(c); };
    if (i < line.size() && !ends(line[i])) continue;
    std::string_view word = Trimmed(line.substr(start, i - start));
    if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
    if (by_comma || !word.empty()) words.push_back(word);
    start = i + 1;
  }
  return words;
}

/// Removes the empty word after a separator that ends a line ("1,2,3,"), unless the line has no more words than
/// `columns`: then the line's last value is missing.
void DropEmptyEnd(std::vector<std::string_view>& words, std::size_t columns) {
  if (words.size() > std::max<std::size_t>(columns, 1) && words.back().empty()) words.pop_back();
}

bool MeansMissing(std::string_view word) {
  constexpr std::string_view kMeanings[] = {"nan", "-nan", "na", "n/a", "null"};
  return word.empty() ||
         std::ranges::any_of(kMeanings, [&](std::string_view one) { return EqualsIgnoringCase(word, one); });
}

std::optional<double> NumberOf(std::string_view word) {
  if (MeansMissing(word)) return kMissing;
  if (word.front() == '+') word.remove_prefix(1);
  return ParseNumber<double>(word);
}

/// Returns a number with a decimal comma; nullopt for any other word.
std::optional<double> NumberWithComma(std::string_view word) {
  std::string pointed(word);
  const std::size_t comma = pointed.find(',');
  if (comma == std::string::npos || pointed.find('.') != std::string::npos) return std::nullopt;
  pointed[comma] = '.';
  return NumberOf(pointed);
}

/// Returns the separator of a row of numbers with decimal commas; 0 if the row has none.
char SeparatorOfNumbers(std::string_view line) {
  if (line.find(',') == std::string_view::npos) return 0;
  for (const char separator : {';', '\t'}) {
    if (line.find(separator) == std::string_view::npos) continue;
    const auto words = WordsOf(line, separator);
    if (std::ranges::all_of(words, [](std::string_view word) { return NumberOf(word) || NumberWithComma(word); }))
      return separator;
  }
  return 0;
}

/// Returns true if a word contains a comma, and otherwise only digits, points, commas and signs. An example is 1,234.5,
/// in which the comma separates thousands.
bool IsOfDigits(std::string_view word) {
  return word.find(',') != std::string_view::npos && word.find_first_not_of("0123456789.,+-") == std::string_view::npos;
}

bool IsRemark(std::string_view line) { return line.empty() || line.starts_with('#') || line.starts_with("//"); }

}  // namespace

Result<NumberRows> ReadNumberRows(std::string_view text, const std::string& file, double largest, bool allows_texts) {
  if (text.size() > kMaxNumberTextBytes) {
    return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxNumberTextBytes);
  }
  // Skip a byte order mark, then read line by line.
  text = WithoutByteOrderMark(text);
  NumberRows table;
  char separator = 0;
  std::size_t headings = 0;
  CommaUse commas;
  for (int line_number = 1; !text.empty(); ++line_number) {
    const char* const line_start = text.data();
    const std::string_view whole = TakeLine(text), line = Trimmed(whole);
    if (IsRemark(line)) continue;
    if (table.columns == 0 && table.heading.empty()) separator = SeparatorOfNumbers(line);
    std::vector<std::string_view> words = WordsOf(separator == '\t' ? whole : line, separator);
    DropEmptyEnd(words, table.columns > 0 ? table.columns : headings);
    // The first line may be a heading.
    const bool has_word = !NumberOf(words.front()) ||
                          (words.front().empty() && words.size() > 1 && !NumberOf(words[1]));  // pandas' index
    if (table.columns == 0 && table.heading.empty() && separator == 0 && has_word) {
      table.heading = line;
      separator = SeparatorOf(line);
      headings = HeadingsOf(line).size();
      continue;
    }
    // Every row must have as many numbers as the first.
    const bool is_first = table.columns == 0;
    if (is_first) table.columns = words.size();
    if (words.size() != table.columns) {
      return Fail({file, line_number}, "found {} values in this row, but earlier rows have {}", words.size(),
                  table.columns);
    }
    table.lines.push_back(line_number);
    for (std::size_t i = 0; i < words.size(); ++i) {
      auto value = NumberOf(words[i]);
      if (!value && separator != 0) {
        value = NumberWithComma(words[i]);
        table.has_decimal_commas = table.has_decimal_commas || value;
      }
      if (value && separator != 0) commas.Add(words[i], i, whole, line_number);
      // In the first row, a word makes its column a column of texts.
      const bool may_be_text = is_first && allows_texts && table.texts.size() < kMaxTextColumns;
      if (!value && may_be_text) table.texts.emplace_back(i, words[i]);
      const auto is_here = [i](const auto& column) { return column.first == i; };
      if (std::ranges::any_of(table.texts, is_here)) value = kMissing;
      if (!value || std::abs(*value) > largest) {
        // Where text is allowed, the word may have been meant as a position: the message then states the limit of
        // positions. The larger limit `largest` applies only to the column of times.
        const int column = static_cast<int>(words[i].data() - line_start) + 1;
        return Fail({file, line_number, column},
                    "value {}: found {}; allowed: a number within ±{:g}{}, or nan for a missing value", i + 1,
                    Quote(words[i]), value || !allows_texts ? largest : kMaxPosition,
                    IsOfDigits(words[i]) ? ", without a thousands separator" : "");
      }
      table.values.push_back(*value);
    }
  }
  if (table.columns == 0) return Fail({file}, "no rows of numbers");
  RETURN_IF_ERROR(commas.Check(file));
  table.separator = separator;
  return table;
}

std::vector<std::string> HeadingsOf(std::string_view heading) {
  std::vector<std::string> headings;
  std::vector<std::string_view> words = WordsOf(heading, SeparatorOf(heading));
  DropEmptyEnd(words, 0);
  for (const std::string_view word : words) {
    headings.emplace_back(word);
    std::erase_if(headings.back(), [](char c) { return c == ' ' || c == '"'; });
  }
  return headings;
}

}  // namespace etude

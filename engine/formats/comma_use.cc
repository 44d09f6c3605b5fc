#include "engine/formats/comma_use.h"

#include <algorithm>

#include "engine/base/names.h"
#include "engine/base/text.h"

namespace etude {
namespace {

/// Returns true for 1 to 3 digits, of which the first is not 0.
bool IsShortNumber(std::string_view text) {
  return !text.empty() && text.size() <= 3 && text.front() != '0' && std::ranges::all_of(text, IsDigit);
}

}  // namespace

void CommaUse::Add(std::string_view number, std::size_t column, std::string_view line_text, int line) {
  const int character = static_cast<int>(number.data() - line_text.data()) + 1;
  if (!number.empty() && (number.front() == '-' || number.front() == '+')) number.remove_prefix(1);
  columns_.resize(std::max(columns_.size(), column + 1));
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos) {
    columns_[column].has_short |= IsShortNumber(number);
    if (pointed_.empty() && number.find('.') != std::string_view::npos) pointed_ = number;
    return;
  }
  if (!first_) first_ = First{std::string(number), column, line, character};
  columns_[column].has_comma = true;
  const std::string_view after = number.substr(comma + 1);
  has_decimal_comma_ |=
      !IsShortNumber(number.substr(0, comma)) || after.size() != 3 || !std::ranges::all_of(after, IsDigit);
}

Result<void> CommaUse::Check(const std::string& file) const {
  const bool is_mixed = std::ranges::any_of(columns_, [](Column one) { return one.has_comma && one.has_short; });
  if (!first_ || has_decimal_comma_ || (pointed_.empty() && !is_mixed)) return {};
  return Fail({file, first_->line, first_->character},
              "value {}: {} has a thousands separator{}; allowed: numbers without thousands separators, such as 1234.5",
              first_->column + 1, Quote(first_->number),
              pointed_.empty() ? "" : ", because other numbers have a decimal point, such as " + pointed_);
}

}  // namespace etude

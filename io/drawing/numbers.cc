#include "io/drawing/numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/drawing/escape.h"

namespace etude {
namespace {

// A value below this constant is, in any unit, the rounding error of a zero.
constexpr double kRounding = 1e-12;

std::string GroupThousands(std::string digits) {
  const std::size_t start = digits.starts_with('-') ? 1 : 0;
  for (std::size_t end = std::min(digits.find('.'), digits.size()); end > start + 3; end -= 3) {
    digits.insert(end - 3, ",");
  }
  return digits;
}

}  // namespace

int DecimalsFor(double value) {
  const double size = std::abs(value);
  if (size == 0 || size >= 100) return 0;
  if (size >= 10) return 1;
  if (size >= 1) return 2;
  return size >= 0.1 ? 3 : 4;
}

std::string ExactText(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{}", *value) : std::string();
}

std::string FormatFixed(double value, int decimals) {
  if (!std::isfinite(value)) return std::string(kNoValue);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // "-0.0" comes from rounding and is not a negative value.
  if (text.find_first_of("123456789") == std::string::npos && text.starts_with('-')) text.erase(0, 1);
  text = GroupThousands(std::move(text));
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

std::string FormatNumber(double value) {
  if (!std::isfinite(value)) return std::string(kNoValue);
  const double size = std::abs(value);
  if (size < kRounding) return "0";
  if (size < 0.001 || size >= 1e9) return fmt::format("{}{:.1e}", value < 0 ? "−" : "", size);
  return FormatFixed(value, DecimalsFor(value));
}

std::string FormatCount(long long count) { return GroupThousands(fmt::format("{}", count)); }

std::string FormatShare(long long part, long long whole) {
  if (whole <= 0) return std::string(kNoValue);
  double percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  if (part < whole) percent = std::min(percent, 99.9);
  if (part > 0) percent = std::max(percent, 0.1);
  const bool needs_digit = (percent > 99 && percent < 100) || (percent > 0 && percent < 1);
  return fmt::format("{:.{}f} %", percent, needs_digit ? 1 : 0);
}

std::string FormatP(std::optional<double> p) {
  if (!p) return std::string(kNoValue);
  if (*p < 0.001) return "< 0.001";
  return fmt::format("{:.{}f}", *p, *p < 0.1 ? 3 : 2);
}

std::string Plural(long long count, std::string_view singular) {
  return fmt::format("{} {}{}", FormatCount(count), singular, count == 1 ? "" : "s");
}

std::string LeftOutWords(std::size_t total, std::size_t shown, std::string_view things, std::string_view where) {
  if (total <= shown) return "";
  return fmt::format("{} more {} are not shown here; all of them are in {}.",
                     FormatCount(static_cast<long long>(total - shown)), things, where);
}

std::string LeftOutHtml(std::size_t total, std::size_t shown, std::string_view things, std::string_view where) {
  const std::string words = LeftOutWords(total, shown, things, where);
  return words.empty() ? "" : fmt::format("<p class=\"quiet legend\">{}</p>", EscapeMarkup(words));
}

}  // namespace etude

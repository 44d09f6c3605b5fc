#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

// Letters and digits of ASCII, in every locale.
constexpr bool IsLower(char c) { return c >= 'a' && c <= 'z'; }
constexpr bool IsUpper(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool IsDigit(char c) { return c >= '0' && c <= '9'; }
constexpr char ToLower(char c) { return IsUpper(c) ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr char ToUpper(char c) { return IsLower(c) ? static_cast<char>(c - 'a' + 'A') : c; }
inline std::string InLowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), ToLower);
  return text;
}
inline std::string InUpperCase(std::string text) {
  std::ranges::transform(text, text.begin(), ToUpper);
  return text;
}
inline bool EqualsIgnoringCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, ToLower, ToLower);
}

/// Returns the text without the spaces, tabs and carriage returns at its ends.
inline std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Takes the first line off the text and returns it without its line break, "\n" or "\r\n".
inline std::string_view TakeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

/// Takes the first line off the text and returns it without its line break, as `TakeLine(text)` does, and increments
/// `number`.
inline std::string_view TakeLine(std::string_view& text, int& number) {
  ++number;
  return TakeLine(text);
}

/// Splits a text at every separator; n separators give n + 1 parts, some of which may be empty.
inline std::vector<std::string_view> SplitAt(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size(); from += parts.back().size() + 1) {
    parts.push_back(text.substr(from, text.find(separator, from) - from));
  }
  return parts;
}

/// Parses the whole text as a number; returns nullopt for any other text. Blanks and a leading plus are not allowed. A
/// double may be infinite or NaN.
template <typename Number>
std::optional<Number> ParseNumber(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

/// Parses the whole text as a finite number; returns nullopt for any other text.
inline std::optional<double> ParseFinite(std::string_view text) {
  const auto value = ParseNumber<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Takes a number off the beginning of the text. If the text does not begin with a number, returns nullopt and leaves
/// the text unchanged.
inline std::optional<double> TakeNumber(std::string_view& text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

}  // namespace etude

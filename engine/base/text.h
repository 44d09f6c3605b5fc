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

/// Takes the first line off the text and returns it without its line break: "\n", "\r\n", "\r\r\n" (text that was
/// converted twice) or "\r" (old Macs, and spreadsheets on Macs).
inline std::string_view TakeLine(std::string_view& text) {
  const auto is_end = [](char c) { return c == '\n' || c == '\r'; };
  const std::string_view line(text.begin(), std::ranges::find_if(text, is_end));
  text.remove_prefix(line.size());
  const std::size_t length = text.starts_with("\r\r\n") ? 3 : text.starts_with("\r\n") ? 2 : 1;
  text.remove_prefix(std::min(length, text.size()));
  return line;
}

/// Takes the first line off the text and returns it without its line break, as `TakeLine(text)` does, and increments
/// `number`.
inline std::string_view TakeLine(std::string_view& text, int& number) {
  ++number;
  return TakeLine(text);
}

/// Takes lines off the text, as `TakeLine(text, number)` does, up to the first line that is not blank, and returns this
/// line; returns an empty line at the end of the text.
inline std::string_view TakeFirstLine(std::string_view& text, int& number) {
  std::string_view line;
  while (!text.empty() && Trimmed(line).empty()) line = TakeLine(text, number);
  return line;
}

/// Returns the first line that is not blank.
inline std::string_view FirstLine(std::string_view text) {
  int number = 0;
  return TakeFirstLine(text, number);
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

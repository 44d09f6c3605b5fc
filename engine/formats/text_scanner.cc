#include "engine/formats/text_scanner.h"

#include <charconv>
#include <cmath>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"

namespace etude {
namespace {

constexpr double kMaxNumber = 1e9;

bool IsAllowed(double value) { return std::isfinite(value) && std::abs(value) <= kMaxNumber; }

bool IsBlank(char c) { return c == ' ' || c == '\t'; }
bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }
bool IsMark(char c) { return c == '{' || c == '}' || c == ':'; }

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file)
    : text_(WithoutByteOrderMark(text)), file_(std::move(file)) {}

void TextScanner::SkipBlanks() {
  while (position_ < text_.size() && IsBlank(text_[position_])) ++position_;
}

bool TextScanner::SkipToText() {
  for (SkipBlanks(); position_ < text_.size() && IsLineEnd(text_[position_]); SkipBlanks()) {
    position_ += text_.substr(position_).starts_with("\r\n") ? 2 : 1;
    line_start_ = position_;
    ++line_;
  }
  return position_ < text_.size();
}

Token TextScanner::Take(std::size_t length) {
  const Token token{text_.substr(position_, length), line_, static_cast<int>(position_ - line_start_) + 1};
  position_ += length;
  return token;
}

Token TextScanner::Next() {
  if (!SkipToText()) return Take(0);
  if (IsMark(text_[position_])) return Take(1);
  std::size_t end = position_;
  while (end < text_.size() && !IsBlank(text_[end]) && !IsLineEnd(text_[end]) && !IsMark(text_[end])) ++end;
  return Take(end - position_);
}

Token TextScanner::NextInLine() {
  SkipBlanks();
  std::size_t end = position_;
  while (end < text_.size() && !IsBlank(text_[end]) && !IsLineEnd(text_[end])) ++end;
  return Take(end - position_);
}

Token TextScanner::NameInLine() {
  SkipBlanks();
  std::size_t end = position_;
  while (end < text_.size() && !IsLineEnd(text_[end]) && text_[end] != '{') ++end;
  while (end > position_ && IsBlank(text_[end - 1])) --end;
  return Take(end - position_);
}

std::optional<double> TextScanner::TakeNumberInLine() {
  SkipBlanks();
  const char* const end_of_text = text_.data() + text_.size();
  double value = 0;
  const auto [end, error] = std::from_chars(text_.data() + position_, end_of_text, value);
  const bool is_whole_word = end == end_of_text || IsBlank(*end) || IsLineEnd(*end);
  if (error != std::errc() || !is_whole_word || !IsAllowed(value)) return std::nullopt;
  position_ = static_cast<std::size_t>(end - text_.data());
  return value;
}

Result<double> TextScanner::Number(const Token& token, std::string_view what) const {
  // Hand-written files often have a leading plus, which from_chars does not accept.
  const std::string_view digits = token.text.starts_with('+') ? token.text.substr(1) : token.text;
  const auto value = ParseNumber<double>(digits);
  if (!value || !IsAllowed(*value)) {
    return Fail(At(token), "found {} for {}; allowed: a number within ±{:g}", Quote(token.text), what, kMaxNumber);
  }
  return *value;
}

}  // namespace etude

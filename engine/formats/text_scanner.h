#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A word of a text with its line and column, both counted from 1 (columns in bytes). `text` is empty for the end of
/// the scanned text.
struct Token {
  std::string_view text;
  int line = 1;
  int column = 1;
};

/// Reads a text word by word and keeps the line and column of each, for readers of text formats with precise error
/// messages. Blanks are spaces and tabs; lines end with LF, CR LF or CR; a leading UTF-8 byte order mark is skipped.
/// `text` must outlive the scanner and its tokens.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string file);

  /// Returns the next word on this line or a later one. `{`, `}` and `:` are separate words.
  Token Next();
  /// Returns the next word on this line, split at blanks only; empty at the end of the line.
  Token NextInLine();
  /// Returns the rest of this line before any `{`, without blanks around it, because a name may contain blanks.
  Token NameInLine();
  /// Returns the next word on this line if it is a number that `Number` accepts; otherwise returns nullopt, and the
  /// next call returns this word.
  std::optional<double> TakeNumberInLine();
  /// Skips blanks and line ends; returns false at the end of the text.
  bool SkipToText();

  Place At(const Token& token) const { return {file_, token.line, token.column}; }
  /// Reads a word as a number. Returns an error for anything else, NaN, infinity, and numbers beyond ±10⁹ (so that sums
  /// and products of input numbers stay finite). `what` names the number in the message.
  Result<double> Number(const Token& token, std::string_view what) const;

 private:
  void SkipBlanks();
  Token Take(std::size_t length);

  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
};

}  // namespace etude

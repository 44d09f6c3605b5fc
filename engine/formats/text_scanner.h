#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A word of a text and where it stands, both counted from 1 (columns in bytes). Empty at the end.
struct Token {
  std::string_view text;
  int line = 1;
  int column = 1;
};

/// Walks a text word by word and knows the line and column of each, for readers of plain-text
/// formats whose complaints must point at what was found. Blanks are spaces and tabs; lines end with LF, CR LF or
/// CR; a leading UTF-8 byte order mark is skipped. `text` must outlive the scanner and its tokens.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string file);

  /// The next word on this line or a later one. `{`, `}` and `:` are words of their own.
  Token Next();
  /// The next word of this line, split at blanks only; empty at the end of the line.
  Token NextInLine();
  /// Returns the rest of this line before any `{`, without blanks around it: a name may contain blanks.
  Token NameInLine();
  /// The next word of this line if it is a number that `Number` takes; else none, and the word is still to come.
  std::optional<double> TakeNumberInLine();
  /// Passes over blanks and line ends; false when nothing follows.
  bool SkipToText();

  Place At(const Token& token) const { return {file_, token.line, token.column}; }
  /// Reads a word as a number. Refused: anything but a number, NaN, infinity, more than ±10⁹ (so that
  /// sums and products of what was read stay finite). `what` names the number in the complaint.
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

#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/random_clip.h"

namespace etude::testing {

/// Returns the parts of a text between separators.
inline std::vector<std::string> Parts(std::string_view text, char separator = '^') {
  std::vector<std::string> parts(1);
  for (const char c : text) c == separator ? parts.emplace_back().clear() : parts.back().push_back(c);
  return parts;
}

/// Returns variants of a text, each with one typical change: a number, word or line is replaced, missing, repeated or
/// moved, or the text ends early.
inline std::vector<std::string> SpoiltTexts(std::string_view text, std::uint64_t seed, int count) {
  constexpr std::array<std::string_view, 14> kWords = {"0",   "-1", "1e9", "1.0000001e9", "nan", "inf", "x",
                                                       "1.5", "2",  "+3",  "0.0",         "{",   "}",   "1e-4"};
  constexpr std::string_view kCharacters = " \t\n\r{}:;,\"#/xX-.1\xff";
  Dice dice(seed);
  std::vector<std::string> spoilt;
  // Returns the text between separators around a position, and the separator after it.
  const auto around = [&](std::string_view separators, std::size_t at) {
    const std::size_t before = text.find_last_of(separators, at);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    return std::pair(begin, std::min(text.find_first_of(separators, begin), text.size() - 1) + 1 - begin);
  };
  for (int i = 0; i < count; ++i) {
    std::string& made = spoilt.emplace_back(text);
    const std::size_t at = dice.Below(text.size());
    const auto [line, line_size] = around("\n", at);
    const auto [word, word_size] = around(" \t\n,;[]", at);
    switch (dice.Below(9)) {
      case 0:
      case 1:
      case 2:
        made.replace(word, word_size - 1, kWords[dice.Below(kWords.size())]);
        break;
      case 3:
        made.erase(word, word_size);
        break;
      case 4:
        made.insert(word, text.substr(word, word_size));
        break;
      case 5:
        made.erase(line, line_size);
        break;
      case 6:
        made.insert(around("\n", dice.Below(text.size())).first, text.substr(line, line_size));
        break;
      case 7:
        made[at] = kCharacters[dice.Below(kCharacters.size())];
        break;
      default:
        made.resize(at);
    }
  }
  return spoilt;
}

/// Returns variants of these bytes with a few bytes changed or missing, or one added.
inline std::vector<std::string> SpoiltBytes(std::string_view bytes, std::uint64_t seed, int count) {
  constexpr std::string_view kBytes("\0\1\2\x7f\x80\xff@", 7);
  Dice dice(seed);
  std::vector<std::string> spoilt;
  for (int i = 0; i < count; ++i) {
    std::string& made = spoilt.emplace_back(bytes);
    const std::size_t at = dice.Below(dice.Below(2) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 700));
    switch (dice.Below(5)) {
      case 0:
        made.resize(at);
        break;
      case 1:
        made.insert(at, 1, kBytes[dice.Below(kBytes.size())]);
        break;
      default:
        made[at] = kBytes[dice.Below(kBytes.size())];
    }
  }
  return spoilt;
}

}  // namespace etude::testing

#pragma once

#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/kept_lines.h"
#include "tests/support/results.h"

namespace etude::testing {

inline std::string AllReplaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Removes libraries' texts, which differ between versions, and long lists of allowed values.
inline std::string Shortened(const std::string& answer) {
  for (const std::string begin : {"not valid YAML: ", "not valid JSON: "}) {
    const std::size_t at = answer.find(begin);
    if (at != std::string::npos) return answer.substr(0, at + begin.size()) + "…";
  }
  constexpr std::string_view kAllowed = "Allowed: ";
  const std::size_t at = answer.find(kAllowed);
  return at == std::string::npos || answer.size() - at < 100 ? answer : answer.substr(0, at + kAllowed.size()) + "…";
}

/// Calls `answer` with each line of a text file, and compares the answer (Shortened) with the following line, which
/// begins with two blanks. After a line "@ TEXT", `answer` receives TEXT with the line in place of "…". In TEXT and in
/// lines, "\n" is a line end. Empty lines and lines that begin with '#' are comments. `ETUDE_RENEW` works as in
/// AreKept.
inline ::testing::AssertionResult AnswersAreKept(const std::string& path,
                                                 const std::function<std::string(const std::string& text)>& answer) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::string> lines;
  std::string around = "…";
  std::size_t asked = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("  ")) continue;
    lines.push_back(line);
    const bool surrounds = line.starts_with("@ ");
    if (surrounds) around = line.substr(2);
    if (surrounds || line.empty() || line.starts_with('#')) continue;
    lines.push_back("  " + Shortened(answer(AllReplaced(AllReplaced(around, "…", line), "\\n", "\n"))));
    ++asked;
  }
  if (asked == 0) return ::testing::AssertionFailure() << path << ": asks nothing";
  return AreKept(lines, path);
}

/// Returns the text with its first FROM replaced by TO, if `line` is "FROM => TO". A line without an arrow is a whole
/// new text.
inline std::string Edited(std::string text, const std::string& line) {
  const std::size_t arrow = line.find(" => ");
  if (arrow == std::string::npos) return line;
  const std::string from = line.substr(0, arrow);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << line;
  return at == std::string::npos ? text : text.replace(at, from.size(), line.substr(arrow + 4));
}

}  // namespace etude::testing

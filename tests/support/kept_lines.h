#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude::testing {

/// Compares lines, such as error messages, with a text file beside the test. A failure shows the first different line.
/// If `ETUDE_RENEW` is the file's path or its beginning, writes the file anew; the test still fails, and `git diff`
/// shows the changes. The author of the commit states the reason.
inline ::testing::AssertionResult AreKept(const std::vector<std::string>& lines, const std::string& path) {
  const char* const renewed = std::getenv("ETUDE_RENEW");
  if (renewed != nullptr && *renewed != 0 && path.starts_with(renewed)) {
    std::ofstream file(path, std::ios::binary);
    for (const std::string& line : lines) file << line << '\n';
    return ::testing::AssertionFailure() << path << (file ? ": written anew" : ": cannot be written");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return ::testing::AssertionFailure() << path << ": cannot be read";
  std::vector<std::string> kept;
  for (std::string line; std::getline(file, line);) kept.push_back(line);
  const auto [now, was] = std::ranges::mismatch(lines, kept);
  if (now == lines.end() && was == kept.end()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << fmt::format(
             "{}:{}: is  '{}'\n  was '{}'\n  If that is right: ETUDE_RENEW={}, once more, and git diff", path,
             now - lines.begin() + 1, now == lines.end() ? "(the end)" : *now, was == kept.end() ? "(the end)" : *was,
             path);
}

/// Lines that describe how readers treat texts: the number of accepted texts, and the first error message of each kind.
/// Messages that differ only in numbers and quoted words are of one kind. Texts of libraries are left out, because they
/// change between versions.
class ComplaintLines {
 public:
  /// Adds texts; `read` takes a text and returns a Result.
  template <typename Texts, typename Read>
  void Add(const std::string& what, const Texts& texts, const Read& read) {
    std::set<std::string> kinds;
    std::vector<std::string> complaints;
    std::size_t taken = 0, count = 0;
    for (const auto& text : texts) {
      ++count;
      const auto result = read(text);
      taken += result.has_value();
      if (result) continue;
      const std::string complaint = OwnWords(ToString(result.error()));
      if (kinds.insert(KindOf(complaint)).second) complaints.push_back("  " + complaint);
    }
    lines_.push_back(fmt::format("{}: {} of {} are read", what, taken, count));
    std::ranges::copy(complaints, std::back_inserter(lines_));
  }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  static std::string OwnWords(const std::string& complaint) {
    for (const std::string introduction : {"not valid YAML: ", "not glTF 2.0: "}) {
      const std::size_t at = complaint.find(introduction);
      if (at != std::string::npos) return complaint.substr(0, at + introduction.size()) + "…";
    }
    return complaint;
  }

  static std::string KindOf(const std::string& complaint) {
    std::string kind;
    for (std::size_t i = 0; i < complaint.size(); ++i) {
      const std::size_t end = complaint[i] == '\'' ? complaint.find('\'', i + 1) : std::string::npos;
      if (end != std::string::npos) i = end;
      const bool is_number = std::isdigit(static_cast<unsigned char>(complaint[i])) != 0;
      if (!is_number || !kind.ends_with('0')) kind += is_number ? '0' : complaint[i];
    }
    return kind;
  }

  std::vector<std::string> lines_;
};

}  // namespace etude::testing

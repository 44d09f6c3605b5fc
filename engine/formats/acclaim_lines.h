#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/text.h"
#include "engine/formats/text_scanner.h"

namespace etude {

/// Iterates over the lines of a text that contain words; '#' begins a comment.
class AcclaimLines {
 public:
  AcclaimLines(std::string_view text, const std::string& file) : scanner_(text, file), text_(text) {}

  /// Sets `words` to the words of the next line that has any; returns false at the end.
  bool Next() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + (text_.substr(end).starts_with("\r\n") ? 2 : 1), text_.size()));
      ++number_;
      line = line.substr(0, line.find('#'));
      words.clear();
      for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
        const std::size_t stop = std::min(line.find_first_of(" \t", at), line.size());
        words.push_back({line.substr(at, stop - at), number_, static_cast<int>(at) + 1});
        at = stop;
      }
      if (!words.empty()) return true;
    }
    return false;
  }

  bool Is(std::string_view first) const { return !words.empty() && words.front().text == first; }
  /// Returns true if the first word is `section`, in any case.
  bool IsSection(std::string_view section) const {
    return !words.empty() && EqualsIgnoringCase(words.front().text, section);
  }
  bool IsSection() const { return !words.empty() && words.front().text.starts_with(':'); }
  Place At(std::size_t word = 0) const {
    return word < words.size() ? scanner_.At(words[word]) : scanner_.At({"", number_, 0});
  }
  Result<double> Number(std::size_t word) const {
    if (word >= words.size()) return Fail(At(word), "a number is missing at the end of this line");
    return scanner_.Number(words[word], "value");
  }
  Result<glm::dvec3> Vector(std::size_t first) const {
    glm::dvec3 vector(0);
    for (int i = 0; i < 3; ++i) {
      ASSIGN_OR_RETURN(vector[i], Number(first + static_cast<std::size_t>(i)));
    }
    return vector;
  }

  std::vector<Token> words;

 private:
  TextScanner scanner_;
  std::string_view text_;
  int number_ = 0;
};

}  // namespace etude

#include "bench/gate/json_places.h"

#include <nlohmann/json.hpp>
#include <set>

#include "bench/files/json.h"
#include "engine/base/names.h"

namespace etude {
namespace {

/// An object or a list that has been opened and not closed.
struct Level {
  bool is_object = false;
  bool key_comes = false;           ///< the next string is a key
  std::string key;                  ///< the last one
  std::map<std::string, int> keys;  ///< with their lines
};

class Walk {
 public:
  Walk(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

  Result<JsonPlaces> Run() {
    for (; at_ < text_.size(); ++at_) {
      RETURN_IF_ERROR(Step(text_[at_]));
    }
    return std::move(places_);
  }

 private:
  Result<void> Step(char c) {
    if (c == '\n') ++line_;
    if (c == '"') return String();
    if (c == '{' || c == '[') {
      NoteEntry();
      levels_.push_back({c == '{', c == '{', "", {}});
    } else if (c == '}' || c == ']') {
      if (!levels_.empty()) levels_.pop_back();
    } else if (c == ',') {
      if (!levels_.empty()) levels_.back().key_comes = levels_.back().is_object;
    } else if (c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z')) {
      NoteEntry();
      while (at_ + 1 < text_.size() && std::string_view(",]} \t\r\n").find(text_[at_ + 1]) == std::string::npos) ++at_;
    }
    return {};
  }

  /// A key, or a value, from its opening quote to its closing one.
  Result<void> String() {
    const std::size_t from = at_;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) at_ += text_[at_] == '\\';
    if (levels_.empty() || !levels_.back().key_comes) {
      NoteEntry();
      return {};
    }
    Level& level = levels_.back();
    level.key_comes = false;
    level.key = Json::parse(text_.substr(from, at_ + 1 - from)).get<std::string>();  // "a" and "\u0061" are one key
    const auto [first, is_new] = level.keys.emplace(level.key, line_);
    if (is_new) return {};
    return Fail({file_, line_, 0}, "the key {} stands twice in one object, first in line {}; allowed: once",
                Quote(level.key), first->second);
  }

  /// A value begins here: is it an entry of a list in the outermost object?
  void NoteEntry() {
    if (levels_.size() == 2 && levels_[0].is_object && !levels_[1].is_object) {
      places_.lines[levels_[0].key].push_back(line_);
    }
  }

  const std::string& text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Level> levels_;
  JsonPlaces places_;
};

}  // namespace

Result<JsonPlaces> FindJsonPlaces(const std::string& text, const std::string& file) { return Walk(text, file).Run(); }

}  // namespace etude

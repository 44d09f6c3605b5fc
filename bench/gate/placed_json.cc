#include "bench/gate/placed_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/names.h"

namespace etude {
namespace {

struct Level {
  bool is_object = false;
  bool key_comes = false;           ///< true: the next string is a key, not a value
  std::string key;                  ///< the key that was read last
  std::map<std::string, int> keys;  ///< the keys read so far in this object, each with its line
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

  /// Reads a string from its opening to its closing quote. The string may be a key or a value.
  Result<void> String() {
    const std::size_t from = at_;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) at_ += text_[at_] == '\\';
    if (levels_.empty() || !levels_.back().key_comes) {
      NoteEntry();
      return {};
    }
    Level& level = levels_.back();
    level.key_comes = false;
    level.key = Json::parse(text_.substr(from, at_ + 1 - from)).get<std::string>();  // decodes escapes: "\u0061" is "a"
    const auto [first, is_new] = level.keys.emplace(level.key, line_);
    if (is_new) return {};
    return Fail({file_, line_, 0}, "the key {} appears twice in one object, first in line {}; allowed: once",
                Quote(level.key), first->second);
  }

  /// Records the current line number if the value that begins here is an entry of a list in the outermost object.
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

std::string DescribeJson(const Json& json) {
  if (json.is_object()) return json.empty() ? "an empty object" : "an object";
  if (json.is_array()) return json.empty() ? "an empty list" : "a list";
  if (json.is_string()) return Quote(json.get<std::string>());
  return json.dump();
}

Result<JsonObject> JsonObject::Of(const Json& json, Place place, std::string what,
                                  std::initializer_list<std::string_view> required,
                                  std::initializer_list<std::string_view> optional) {
  if (!json.is_object()) return Fail(place, "{} must be an object, found {}", what, DescribeJson(json));
  std::vector<std::string> known(required.begin(), required.end());
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& [key, value] : json.items()) {
    if (std::ranges::find(known, key) == known.end()) {
      return Fail(place, "{}", UnknownName("key of " + what, key, known));
    }
  }
  for (const std::string_view key : required) {
    if (!json.contains(key)) return Fail(place, "{} lacks '{}'; allowed keys: {}", what, key, Join(known));
  }
  return JsonObject(json, std::move(place), std::move(what));
}

const Json& JsonObject::At(std::string_view key) const { return (*json_)[std::string(key)]; }

bool JsonObject::Has(std::string_view key) const { return json_->contains(key); }

tl::unexpected<Error> JsonObject::Wrong(std::string_view key, std::string_view allowed) const {
  return Fail(place_, "'{}' of {} is {}; allowed: {}", key, what_, DescribeJson(At(key)), allowed);
}

Result<std::string> JsonObject::Text(std::string_view key) const {
  if (!At(key).is_string()) return Wrong(key, "a text");
  return At(key).get<std::string>();
}

Result<std::int64_t> JsonObject::Whole(std::string_view key, std::int64_t lowest, std::int64_t highest) const {
  const Json& value = At(key);
  const std::string allowed = fmt::format("a whole number, {}…{}", lowest, highest);
  // Without this check, a number above INT64_MAX would become negative.
  const bool fits =
      value.is_number_integer() && !(value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX);
  if (!fits || value.get<std::int64_t>() < lowest || value.get<std::int64_t>() > highest) return Wrong(key, allowed);
  return value.get<std::int64_t>();
}

Result<std::uint64_t> JsonObject::Unsigned(std::string_view key) const {
  if (!At(key).is_number_unsigned()) return Wrong(key, "a whole number, 0 or more");
  return At(key).get<std::uint64_t>();
}

Result<const Json*> JsonObject::List(std::string_view key) const {
  if (!At(key).is_array()) return Wrong(key, "a list");
  return &At(key);
}

Result<void> JsonObject::Each(std::string_view key,
                              const std::function<Result<void>(const std::string&, const JsonObject&)>& take) const {
  if (!At(key).is_object() || At(key).empty()) return Wrong(key, "an object with at least one key");
  const JsonObject inner(At(key), place_, fmt::format("'{}' of {}", key, what_));
  for (const auto& [name, value] : At(key).items()) {
    RETURN_IF_ERROR(take(name, inner));
  }
  return {};
}

}  // namespace etude

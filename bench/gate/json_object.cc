#include "bench/gate/json_object.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/base/names.h"

namespace etude {

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
    if (!json.contains(key)) return Fail(place, "{} lacks '{}'; it has: {}", what, key, Join(known));
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
  // What does not fit into 64 bits with a sign would come out negative.
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

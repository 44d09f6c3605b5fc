#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace etude {

/// The lines of a JSON document's entries, which a JSON library forgets when it has read it.
struct JsonPlaces {
  /// The line of each entry, from 1, of every list in the outermost object.
  std::map<std::string, std::vector<int>> lines;
};

/// Walks over a document that is valid JSON (ReadJson). Fails, with the line, on a key that stands twice in one object:
/// a JSON library would keep one of the two and not tell.
Result<JsonPlaces> FindJsonPlaces(const std::string& text, const std::string& file);

/// A JSON object read strictly: every key that must be there is, no other one is, and each value is of its kind, where
/// a JSON library would make 1 of 1.9, 18446744073709551615 of −1, or throw in its own words. Complaints name the
/// place, the key, what was found and what is allowed. Null is no text and no number.
class JsonObject {
 public:
  /// `what` is what complaints call it: "a line of statuses". `json` must outlive it.
  static Result<JsonObject> Of(const Json& json, Place place, std::string what,
                               std::initializer_list<std::string_view> required,
                               std::initializer_list<std::string_view> optional = {});

  Result<std::string> Text(std::string_view key) const;
  Result<std::int64_t> Whole(std::string_view key, std::int64_t lowest, std::int64_t highest) const;
  Result<std::uint64_t> Unsigned(std::string_view key) const;
  Result<const Json*> List(std::string_view key) const;
  /// Calls `take` for each key of an object; stops at its first error.
  Result<void> Each(std::string_view key,
                    const std::function<Result<void>(const std::string&, const JsonObject&)>& take) const;
  bool Has(std::string_view key) const;

  const Place& place() const { return place_; }

 private:
  JsonObject(const Json& json, Place place, std::string what)
      : json_(&json), place_(std::move(place)), what_(std::move(what)) {}

  const Json& At(std::string_view key) const;
  tl::unexpected<Error> Wrong(std::string_view key, std::string_view allowed) const;

  const Json* json_;
  Place place_;
  std::string what_;
};

/// A value as complaints show it: null, "text", 1.5, a list, an object.
std::string DescribeJson(const Json& json);

}  // namespace etude

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

/// The line numbers of the values in a JSON document. nlohmann's parser does not keep them.
struct JsonPlaces {
  /// For each key of the outermost object whose value is a list: the line of each entry, counted from 1.
  std::map<std::string, std::vector<int>> lines;
};

/// Finds the line numbers in JSON that ReadJson has found valid. Fails on a duplicate key in an object and names its
/// line, because the parser would silently keep one of the two values.
Result<JsonPlaces> FindJsonPlaces(const std::string& text, const std::string& file);

/// Reads a JSON object strictly: every required key must exist, unknown keys are refused, each value must have its
/// type, and null is neither text nor number. (nlohmann would convert 1.9 to 1 and −1 to 18446744073709551615.) Errors
/// name the place, the key, the value found and what is allowed.
class JsonObject {
 public:
  /// Checks the keys of `json`, which must outlive the result. `what` is the object's name in error messages, e.g. "a
  /// line of statuses".
  static Result<JsonObject> Of(const Json& json, Place place, std::string what,
                               std::initializer_list<std::string_view> required,
                               std::initializer_list<std::string_view> optional = {});

  Result<std::string> Text(std::string_view key) const;
  Result<std::int64_t> Whole(std::string_view key, std::int64_t lowest, std::int64_t highest) const;
  Result<std::uint64_t> Unsigned(std::string_view key) const;
  Result<const Json*> List(std::string_view key) const;
  /// Calls `take` for each key of the object that is the value of `key`. Stops at the first error of `take` and returns
  /// it.
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

/// Describes a value for error messages: null, "text", 1.5, "a list", "an object".
std::string DescribeJson(const Json& json);

}  // namespace etude

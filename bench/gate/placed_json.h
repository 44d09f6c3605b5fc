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

/// The line numbers of a JSON document, which nlohmann's parser does not keep.
struct JsonPlaces {
  /// By key of the outermost object: the line, from 1, of each entry of its list.
  std::map<std::string, std::vector<int>> lines;
};

/// Finds the lines in valid JSON (checked by ReadJson). Fails, with the line, on a duplicate key in an object; the
/// parser would silently keep one of the two.
Result<JsonPlaces> FindJsonPlaces(const std::string& text, const std::string& file);

/// Reads a JSON object strictly: every required key exists, no unknown one does, and each value has its type; null is
/// neither text nor number. (nlohmann would convert 1.9 to 1 and −1 to 18446744073709551615.) Complaints name the
/// place, the key, the value found and what is allowed.
class JsonObject {
 public:
  /// Checks the keys of `json`, which must outlive the result. `what` is its name in complaints: "a line of statuses".
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

/// Describes a value for complaints: null, "text", 1.5, "a list", "an object".
std::string DescribeJson(const Json& json);

}  // namespace etude

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/files/json.h"
#include "sim/random/stream.h"

namespace etude {

inline void ListPlaces(const Json& json, const Json::json_pointer& at, std::vector<Json::json_pointer>& places) {
  places.push_back(at);
  if (json.is_object()) {
    for (const auto& item : json.items()) ListPlaces(item.value(), at / item.key(), places);
  }
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) ListPlaces(json[i], at / i, places);
  }
}

/// The same answer with one value, anywhere in it, replaced by one that a careless or hostile program may say.
inline Json Mutated(Json json, RandomStream& dice) {
  const std::array<Json, 16> said = {Json(nullptr),
                                     Json(-1),
                                     Json(0),
                                     Json(1),
                                     Json(40),
                                     Json(0.25),
                                     Json(-999.5),
                                     Json(1e308),
                                     Json(std::numeric_limits<double>::quiet_NaN()),
                                     Json(std::numeric_limits<std::int64_t>::min()),
                                     Json(std::numeric_limits<std::uint64_t>::max()),
                                     Json("cut"),
                                     Json(std::string(1000, '\xff')),
                                     Json(true),
                                     Json::array(),
                                     Json::object()};
  std::vector<Json::json_pointer> places;
  ListPlaces(json, Json::json_pointer(), places);
  json[places[dice.IndexBelow(places.size())]] = said[dice.IndexBelow(said.size())];
  return json;
}

}  // namespace etude

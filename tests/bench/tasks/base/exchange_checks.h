#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
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

/// Returns the answer with one value, anywhere in it, replaced by one that a careless or hostile program may send.
inline Json Mutated(Json json, RandomStream& dice) {
  Json said = Json::parse(R"([null, -1, 0, 1, 40, 0.25, -999.5, 1e308, "cut", true, [], {}, -9223372036854775808,
                              18446744073709551615])");
  said.push_back(std::numeric_limits<double>::quiet_NaN());
  said.push_back(std::string(1000, '\xff'));
  std::vector<Json::json_pointer> places;
  ListPlaces(json, Json::json_pointer(), places);
  json[places[dice.IndexBelow(places.size())]] = said[dice.IndexBelow(said.size())];
  return json;
}

/// Returns the reason why an answer is refused, or "no complaint".
inline std::string ComplaintAbout(TaskWorld& world, const Json& answer) {
  const auto judged = world.Judge(answer);
  return judged ? "no complaint" : judged.error().message;
}

/// Returns the error message about a good answer after the value at `pointer` ("/events/2/score") was replaced by
/// `value`.
inline std::string ComplaintWith(TaskWorld& world, Json answer, const char* pointer, const Json& value) {
  answer[Json::json_pointer(pointer)] = value;
  return ComplaintAbout(world, answer);
}

/// Returns the error message about a changed answer. `edit` is "PLACE = VALUE" or "PLACE erased", which changes the
/// good `answer`, or it is another answer in JSON.
inline std::string ComplaintOfEdit(TaskWorld& world, Json answer, const std::string& edit) {
  if (!edit.starts_with('/')) return ComplaintAbout(world, Json::parse(edit));
  const std::size_t end = edit.find(' ');
  const Json::json_pointer place(edit.substr(0, end));
  if (edit.substr(end) != " erased") {
    return ComplaintWith(world, answer, place.to_string().c_str(), Json::parse(edit.substr(end + 3)));
  }
  Json& around = answer[place.parent_pointer()];
  around.is_array() ? around.erase(std::stoul(place.back())) : static_cast<void>(around.erase(place.back()));
  return ComplaintAbout(world, answer);
}

struct Judgements {
  int refused = 0, scored = 0;
};

/// Judges `count` answers, each made by Mutated from a good answer. Every answer must be refused with a reason, or
/// scored with numbers.
inline Judgements JudgeMutations(TaskWorld& world, const std::vector<Json>& good, int count, RandomStream dice) {
  Judgements judgements;
  for (int i = 0; i < count; ++i) {
    const Json answer = Mutated(good[static_cast<std::size_t>(i) % good.size()], dice);
    const auto judged = world.Judge(answer);
    judged ? ++judgements.scored : ++judgements.refused;
    if (!judged) {
      EXPECT_FALSE(judged.error().message.empty()) << answer;
      continue;
    }
    for (const MetricValue& metric : judged->metrics) {
      EXPECT_TRUE(std::isfinite(metric.value.value_or(0))) << metric.id << " of " << answer;
    }
  }
  return judgements;
}

}  // namespace etude

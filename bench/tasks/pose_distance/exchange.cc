#include "bench/tasks/pose_distance/exchange.h"

#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"

namespace etude {
namespace {

constexpr double kMaxDistance = 1e9;

}  // namespace

Payload BodyPayload() { return PayloadOf(DescribeBody()); }

Payload PairsPayload(const PairWorld& world) {
  Json pairs = Json::array();
  for (const SeenPair& pair : world.pairs) {
    pairs.push_back({{"a", EncodePose(pair.a.pose)}, {"b", EncodePose(pair.b.pose)}});
  }
  return PayloadOf({{"pairs", std::move(pairs)}});
}

Payload GapsPayload(const PairWorld& world) {
  Json gaps = Json::array();
  for (const SeenPair& pair : world.pairs) gaps.push_back(100 * pair.gap_m);
  return PayloadOf({{"name", world.name}, {"pose_gap_cm", std::move(gaps)}});
}

Result<PairVerdict> ReadPairAnswer(const Json& answer, const PairWorld& world) {
  AnswerFields fields(answer);
  PairVerdict verdict;
  const std::size_t count = world.pairs.size();
  const auto distances = ReadNumbers(fields.List("distances", count, count), "distances", count, {0, kMaxDistance});
  if (distances) {
    verdict.distances = *distances;
  } else {
    fields.Note(distances.error());
  }
  for (const Json& entry : fields.List("alike", count, count)) {
    if (!entry.is_boolean()) {
      const std::string path = fields.PathOf("alike", verdict.alike.size());
      fields.Note(Error{{}, path + ": " + ShowJson(entry) + " is neither true nor false"});
      break;
    }
    verdict.alike.push_back(entry.get<bool>());
  }
  RETURN_IF_ERROR(fields.Finish());
  return verdict;
}

}  // namespace etude

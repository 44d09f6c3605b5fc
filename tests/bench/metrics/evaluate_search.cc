#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/matching.h"
#include "tests/bench/metrics/evaluators.h"

namespace etude {
namespace {

std::vector<FoundFrames> FramesOf(const Json& in, const char* key) {
  return in.at(key).get<std::vector<FoundFrames>>();
}

Value PerQuery(const Json& in, const char* key) {
  if (in.at(key).is_null()) return std::nullopt;
  return MeanPerQuery(in.at(key).get<std::vector<std::int64_t>>());
}

}  // namespace

std::span<const Evaluator> SearchEvaluators() {
  static constexpr Evaluator kAll[] = {
      {"search_agreement",
       [](const Json& in) { return SearchAgreement(FramesOf(in, "found"), FramesOf(in, "truth")); }},
      {"matches_per_query", [](const Json& in) { return MatchesPerQuery(FramesOf(in, "found")); }},
      {"distances_per_query", [](const Json& in) { return PerQuery(in, "distances"); }},
      {"boxes_per_query", [](const Json& in) { return PerQuery(in, "boxes"); }},
  };
  return kAll;
}

}  // namespace etude

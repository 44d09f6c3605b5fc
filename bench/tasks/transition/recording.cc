#include "bench/tasks/transition/recording.h"

#include <nlohmann/json.hpp>

#include "bench/metrics/transition_smoothness.h"

namespace etude {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string NameOf(const Segment& segment, const Stage& stage) {
  return segment.clip == Segment::kOwnFrames ? "in-between" : stage.library.names[segment.clip];
}

OrderedJson ByFeature(const PerFeature& values) {
  OrderedJson json;
  for (std::size_t k = 0; k < kFeatureCount; ++k) json[std::string(FeatureName(AllFeatures()[k]))] = values[k];
  return json;
}

OrderedJson PointsOf(const TransitionRecord& record, const Stage& stage) {
  OrderedJson list = OrderedJson::array();
  for (std::size_t i = 0; i < record.distances.size(); ++i) {
    const Segment &old = record.segments[i], &next = record.segments[i + 1];
    list.push_back({{"from", NameOf(old, stage)},
                    {"from_frame", old.last},
                    {"to", NameOf(next, stage)},
                    {"to_frame", next.first},
                    {"distance", record.distances[i].value},
                    {"partials", ByFeature(record.distances[i].partials)}});
  }
  return list;
}

OrderedJson CandidatesOf(const TransitionRecord& record) {
  OrderedJson list = OrderedJson::array();
  for (const Candidate& candidate : record.candidates) {
    list.push_back({{"point", candidate.point},
                    {"from_frame", candidate.from_frame},
                    {"to_frame", candidate.to_frame},
                    {"distance", candidate.distance.value},
                    {"partials", ByFeature(candidate.distance.partials)},
                    {"cost", candidate.cost ? OrderedJson(*candidate.cost) : OrderedJson()},
                    {"outcome", OutcomeName(candidate.outcome)}});
  }
  return list;
}

}  // namespace

Series JumpSeries(const TransitionOutcome& outcome) {
  const FrameWindow window = AroundPoints(outcome.splice, 1);
  const std::vector<double> all = SecondDifferencesCm(outcome.splice.motion);
  return {"second_difference_cm", "frame", {all.begin() + window.first, all.begin() + window.last + 1}};
}

std::vector<Series> ExplanationOf(const TransitionRecord& record) {
  const auto append = [](std::vector<double>& all, const PerFeature& ten) {
    all.insert(all.end(), ten.begin(), ten.end());
  };
  Series points{"point_partials", "feature", {}}, partials{"candidate_partials", "feature", {}};
  for (const FuzzyDistance& distance : record.distances) append(points.values, distance.partials);
  for (const Candidate& candidate : record.candidates) append(partials.values, candidate.distance.partials);
  const auto each = [&](const char* name, auto&& value) {
    Series series{name, "candidate", {}};
    for (const Candidate& candidate : record.candidates) series.values.push_back(static_cast<double>(value(candidate)));
    return series;
  };
  return {std::move(points),
          each("candidate_point", [](const Candidate& c) { return c.point; }),
          each("candidate_from_frame", [](const Candidate& c) { return c.from_frame; }),
          each("candidate_to_frame", [](const Candidate& c) { return c.to_frame; }),
          each("candidate_distance", [](const Candidate& c) { return c.distance.value; }),
          each("candidate_outcome", [](const Candidate& c) { return static_cast<int>(c.outcome); }),
          std::move(partials)};
}

Recording RecordTransition(const TransitionOutcome& outcome, const Stage& stage) {
  constexpr double kSeconds = 2.5;
  const FrameWindow window = AroundPoints(outcome.splice, kSeconds);
  const std::vector<BodyPose>& all = outcome.splice.motion.poses;
  Track coach{"coach", {outcome.splice.motion.rate_hz, {all.begin() + window.first, all.begin() + window.last + 1}}};

  const TransitionRecord& record = outcome.record;
  const FuzzyDistance& worst = WorstDistance(record);
  OrderedJson facts;
  facts["transition_frame"] = outcome.splice.points.front().frame - window.first;
  facts["transition_frames"] = OrderedJson::array();
  for (const PlacedPoint& point : outcome.splice.points)
    facts["transition_frames"].push_back(point.frame - window.first);
  facts["from"] = NameOf(record.segments.front(), stage);
  facts["to"] = NameOf(record.segments.back(), stage);
  facts["branch"] = BranchName(record.branch);
  facts["why"] = record.why;
  facts["request_frame"] = record.request_frame - window.first;
  facts["wait_s"] = record.wait_s;
  facts["threshold"] = outcome.rules.threshold;
  facts["natural_limit_cm"] = NaturalLimitCm(NaturalJumpsOf(stage, outcome.request.from, outcome.request.to));
  facts["distance"] = worst.value;
  facts["weights"] = ByFeature(outcome.rules.weights);
  facts["partials"] = ByFeature(worst.partials);
  facts["pairs_seen"] = record.pairs_seen;
  facts["pairs_matched"] = record.pairs_matched;
  facts["transition_points"] = PointsOf(record, stage);
  facts["cost_unit"] = record.cost_unit;
  facts["candidates"] = CandidatesOf(record);
  return {{std::move(coach)}, facts.dump()};
}

}  // namespace etude

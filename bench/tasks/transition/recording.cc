#include "bench/tasks/transition/recording.h"

#include <nlohmann/json.hpp>

#include "bench/metrics/transition_smoothness.h"

namespace etude {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string NameOf(const Leg& leg, const Stage& stage) {
  return leg.clip == Leg::kOwnFrames ? "in-between" : stage.library.names[leg.clip];
}

OrderedJson ByFeature(const PerFeature& values) {
  OrderedJson json;
  for (std::size_t k = 0; k < kFeatureCount; ++k) json[std::string(FeatureName(AllFeatures()[k]))] = values[k];
  return json;
}

OrderedJson SwitchesOf(const SwitchRecord& record, const Stage& stage) {
  OrderedJson list = OrderedJson::array();
  for (std::size_t i = 0; i < record.meetings.size(); ++i) {
    const Leg &old = record.legs[i], &next = record.legs[i + 1];
    list.push_back({{"from", NameOf(old, stage)},
                    {"from_frame", old.last},
                    {"to", NameOf(next, stage)},
                    {"to_frame", next.first},
                    {"distance", record.meetings[i].value},
                    {"partials", ByFeature(record.meetings[i].partials)}});
  }
  return list;
}

OrderedJson CandidatesOf(const SwitchRecord& record) {
  OrderedJson list = OrderedJson::array();
  for (const Candidate& candidate : record.candidates) {
    list.push_back({{"meeting", candidate.meeting},
                    {"from_frame", candidate.from_frame},
                    {"to_frame", candidate.to_frame},
                    {"distance", candidate.distance.value},
                    {"partials", ByFeature(candidate.distance.partials)},
                    {"cost", candidate.cost ? OrderedJson(*candidate.cost) : OrderedJson()},
                    {"fate", FateName(candidate.fate)}});
  }
  return list;
}

}  // namespace

Series SeamSeries(const SwitchOutcome& outcome) {
  const FrameWindow window = AroundSeams(outcome.splice, 1);
  const std::vector<double> all = SecondDifferencesCm(outcome.splice.motion);
  return {"second_difference_cm", "frame", {all.begin() + window.first, all.begin() + window.last + 1}};
}

std::vector<Series> ExplanationOf(const SwitchRecord& record) {
  const auto append = [](std::vector<double>& all, const PerFeature& ten) {
    all.insert(all.end(), ten.begin(), ten.end());
  };
  Series meetings{"meeting_partials", "feature", {}}, partials{"candidate_partials", "feature", {}};
  for (const FuzzyDistance& meeting : record.meetings) append(meetings.values, meeting.partials);
  for (const Candidate& candidate : record.candidates) append(partials.values, candidate.distance.partials);
  const auto each = [&](const char* name, auto&& value) {
    Series series{name, "candidate", {}};
    for (const Candidate& candidate : record.candidates) series.values.push_back(static_cast<double>(value(candidate)));
    return series;
  };
  return {std::move(meetings),
          each("candidate_meeting", [](const Candidate& c) { return c.meeting; }),
          each("candidate_from_frame", [](const Candidate& c) { return c.from_frame; }),
          each("candidate_to_frame", [](const Candidate& c) { return c.to_frame; }),
          each("candidate_distance", [](const Candidate& c) { return c.distance.value; }),
          each("candidate_fate", [](const Candidate& c) { return static_cast<int>(c.fate); }),
          std::move(partials)};
}

Recording RecordSwitch(const SwitchOutcome& outcome, const Stage& stage) {
  constexpr double kSeconds = 2.5;
  const FrameWindow window = AroundSeams(outcome.splice, kSeconds);
  const std::vector<BodyPose>& all = outcome.splice.motion.poses;
  Track coach{"coach", {outcome.splice.motion.rate_hz, {all.begin() + window.first, all.begin() + window.last + 1}}};

  const SwitchRecord& record = outcome.record;
  const FuzzyDistance& worst = WorstMeeting(record);
  OrderedJson facts;
  facts["seam_frame"] = outcome.splice.seams.front().frame - window.first;
  facts["seam_frames"] = OrderedJson::array();
  for (const Seam& seam : outcome.splice.seams) facts["seam_frames"].push_back(seam.frame - window.first);
  facts["from"] = NameOf(record.legs.front(), stage);
  facts["to"] = NameOf(record.legs.back(), stage);
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
  facts["switches"] = SwitchesOf(record, stage);
  facts["cost_unit"] = record.cost_unit;
  facts["candidates"] = CandidatesOf(record);
  return {{std::move(coach)}, facts.dump()};
}

}  // namespace etude

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/detection.h"
#include "bench/metrics/dimensionless_jerk.h"
#include "bench/metrics/evaluate_parts.h"
#include "bench/metrics/matching.h"
#include "bench/metrics/pose_distance.h"
#include "bench/metrics/search.h"
#include "bench/metrics/spectral_arc_length.h"
#include "bench/metrics/transition_smoothness.h"
#include "bench/metrics/vector_input.h"
#include "engine/fuzzy/distance.h"

namespace etude {
namespace {

using Value = EvaluatedMetric;

// Transitions.

std::vector<int> TransitionFramesOf(const Json& in) { return in.at("seams").get<std::vector<int>>(); }

TransitionSmoothness SmoothnessOf(const Json& in) {
  return MeasureTransitions(ReadMotion(in.at("motion")), TransitionFramesOf(in));
}

bool IsNaturalJump(const Json& in) {
  std::vector<double> jumps;
  for (const Json& clip : in.at("clips")) {
    const std::vector<double> own = NaturalJumpsCm(ReadMotion(clip));
    jumps.insert(jumps.end(), own.begin(), own.end());
  }
  const Json& jump = in.at("jump_cm");
  return IsNatural(jump.is_null() ? std::nullopt : std::optional(jump.get<double>()), std::move(jumps));
}

double WorstFootSlide(const Json& in) {
  const BodyMotion motion = ReadMotion(in.at("motion"));
  double worst = 0;
  for (int seam : TransitionFramesOf(in)) worst = std::max(worst, FootSlideCmps(motion, seam));
  return worst;
}

double WorstPoseGap(const Json& in) {
  double worst = 0;
  for (const Json& meeting : in.at("meetings")) {
    worst = std::max(worst, PoseGapCm(ReadPose(meeting.at("leaving")), ReadPose(meeting.at("arriving"))));
  }
  return worst;
}

double WorstVelocityGap(const Json& in) {
  double worst = 0;
  for (const Json& meeting : in.at("meetings")) {
    const auto pose = [&](const char* key) { return ReadPose(meeting.at(key)); };
    worst = std::max(worst, VelocityGapCmps(pose("leaving_before"), pose("leaving"), pose("arriving"),
                                            pose("arriving_after"), in.at("rate_hz").get<double>()));
  }
  return worst;
}

Value FalseSmooth(const Json& in) {
  if (!in.at("matched").get<bool>()) return std::nullopt;
  return IsFalselySmooth(in.at("pose_gap_cm").get<double>()) ? 1 : 0;
}

double Waited(const Json& in) {
  std::vector<Stay> stays;
  for (const Json& stay : in.at("stays")) {
    stays.push_back({stay.at("from_frame").get<int>(), stay.at("until_frame").get<int>()});
  }
  return WaitSeconds(stays, in.at("rate_hz").get<double>());
}

double WorstFuzzyDistance(const Json& in) {
  const auto weights = in.at("weights").get<FeatureWeights>();
  double worst = 0;
  for (const Json& change : in.at("switches")) {
    const PoseFeatures from{change.at("from_features").get<PerFeature>()};
    const PoseFeatures to{change.at("to_features").get<PerFeature>()};
    worst = std::max(worst, ComputeDistance(Fuzzify(from), Fuzzify(to), weights).value);
  }
  return worst;
}

struct SpeedProfile {
  std::vector<double> speed;
  double rate_hz = 0;
};

SpeedProfile SpeedOf(const Json& in) {
  if (in.contains("speed_mps")) return {in.at("speed_mps").get<std::vector<double>>(), in.at("rate_hz").get<double>()};
  const BodyMotion motion = ReadMotion(in.at("motion"));
  const std::vector<int> seams = TransitionFramesOf(in);
  const int second = static_cast<int>(motion.rate_hz);
  return {MeanJointSpeed(motion, seams.at(0) - second, seams.back() + second), motion.rate_hz};
}

Value SparcOf(const Json& in) {
  const SpeedProfile profile = SpeedOf(in);
  return SpectralArcLength(profile.speed, profile.rate_hz);
}

// Matching.

/// Nothing for a method that matches no frames.
std::optional<MatchTally> TallyOf(const Json& in) {
  const Json& threshold = in.at("threshold");
  MatchTally tally;
  for (const Json& pair : in.at("pairs")) {
    ++tally.pairs;
    if (threshold.is_null() || pair.at("distance").get<double>() >= threshold.get<double>()) continue;
    ++tally.matching;
    tally.falsely_smooth += IsFalselySmooth(pair.at("pose_gap_cm").get<double>());
  }
  return threshold.is_null() ? std::nullopt : std::optional(tally);
}

Value DirectMatch(const Json& in) {
  const auto tally = TallyOf(in);
  return tally ? Value(HasDirectMatch(*tally) ? 1 : 0) : std::nullopt;
}

Value ShareOfPairs(const Json& in, std::optional<double> (*share)(const MatchTally&)) {
  const auto tally = TallyOf(in);
  return tally ? share(*tally) : std::nullopt;
}

Value InBetween(const Json& in) {
  if (in.at("legs").is_null()) return std::nullopt;
  return in.at("legs").get<int>() > 2 ? 1 : 0;
}

// Search.

std::vector<FoundFrames> FramesOf(const Json& in, const char* key) {
  return in.at(key).get<std::vector<FoundFrames>>();
}

Value PerQuery(const Json& in, const char* key) {
  if (in.at(key).is_null()) return std::nullopt;
  return MeanPerQuery(in.at(key).get<std::vector<std::int64_t>>());
}

// Pose distances.

Value CalledAlike(const Json& in) {
  const Json& pairs = in.at("pairs");
  if (pairs.size() != 1) return std::nullopt;
  return pairs.at(0).at("distance").get<double>() < in.at("threshold").get<double>() ? 1 : 0;
}

Value JointDistance(const Json& in) {
  const BodyPose a = ReadPose(in.at("a")), b = ReadPose(in.at("b"));
  return in.at("method") == "point-cloud" ? RootMeanSquareJointDistanceCm(a, b) : MeanJointDistanceCm(a, b);
}

/// A pair of poses as an event: "right" is close, "called right" is called alike.
std::vector<JudgedEvent> PairEvents(const Json& in) {
  std::vector<JudgedEvent> events;
  for (const Json& pair : in.at("pairs")) {
    const double distance = pair.at("distance").get<double>();
    events.push_back({pair.at("pose_gap_cm").get<double>() < 100 * kCloseGap,
                      distance < in.at("threshold").get<double>(), -distance});
  }
  return events;
}

constexpr Evaluator kEvaluators[] = {
    {"jump_cm", [](const Json& in) -> Value { return SmoothnessOf(in).jump_cm; }},
    {"mean_joint_jump_cm", [](const Json& in) -> Value { return SmoothnessOf(in).mean_joint_jump_cm; }},
    {"rotation_step_change_deg", [](const Json& in) -> Value { return SmoothnessOf(in).rotation_step_change_deg; }},
    {"jerk_peak_mps3", [](const Json& in) -> Value { return SmoothnessOf(in).jerk_peak_mps3; }},
    {"foot_slide_cmps", [](const Json& in) -> Value { return WorstFootSlide(in); }},
    {"pose_gap_cm", [](const Json& in) -> Value { return WorstPoseGap(in); }},
    {"velocity_gap_cmps", [](const Json& in) -> Value { return WorstVelocityGap(in); }},
    {"false_smooth", FalseSmooth},
    {"natural_share", [](const Json& in) -> Value { return IsNaturalJump(in) ? 1 : 0; }},
    {"wait_s", [](const Json& in) -> Value { return Waited(in); }},
    {"fuzzy_distance", [](const Json& in) -> Value { return WorstFuzzyDistance(in); }},
    {"sparc", SparcOf},
    {"ldlj", [](const Json& in) { return LogDimensionlessJerk(SpeedOf(in).speed); }},

    {"direct_match", DirectMatch},
    {"matching_share", [](const Json& in) { return ShareOfPairs(in, MatchingShare); }},
    {"false_smooth_share", [](const Json& in) { return ShareOfPairs(in, FalseSmoothShare); }},
    {"in_between", InBetween},

    {"search_agreement", [](const Json& in) { return SearchAgreement(FramesOf(in, "found"), FramesOf(in, "truth")); }},
    {"matches_per_query", [](const Json& in) { return MatchesPerQuery(FramesOf(in, "found")); }},
    {"distances_per_query", [](const Json& in) { return PerQuery(in, "distances"); }},
    {"boxes_per_query", [](const Json& in) { return PerQuery(in, "boxes"); }},

    {"called_alike", CalledAlike},
    {"joint_distance_cm", JointDistance},
    {"close_auc", [](const Json& in) -> Value { return RocAuc(PairEvents(in)); }},
    {"close_f1", [](const Json& in) -> Value { return F1(CountConfusion(PairEvents(in))); }},
};

}  // namespace

std::span<const Evaluator> SwitchEvaluators() { return kEvaluators; }

}  // namespace etude

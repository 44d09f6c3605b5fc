#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/matching.h"
#include "bench/metrics/speed_profile.h"
#include "bench/metrics/transition_body.h"
#include "bench/metrics/transition_join.h"
#include "bench/metrics/transition_smoothness.h"
#include "engine/fuzzy/distance.h"
#include "tests/bench/metrics/evaluators.h"
#include "tests/bench/metrics/vector_input.h"

namespace etude {
namespace {

std::vector<int> TransitionFramesOf(const Json& in) { return in.at("transition_points").get<std::vector<int>>(); }

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
  for (int point : TransitionFramesOf(in)) worst = std::max(worst, FootSlideCmps(motion, point));
  return worst;
}

double WorstPoseGap(const Json& in) {
  double worst = 0;
  for (const Json& point : in.at("meetings")) {
    worst = std::max(worst, PoseGapCm(ReadPose(point.at("leaving")), ReadPose(point.at("arriving"))));
  }
  return worst;
}

double WorstVelocityGap(const Json& in) {
  double worst = 0;
  for (const Json& point : in.at("meetings")) {
    const auto pose = [&](const char* key) { return ReadPose(point.at(key)); };
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
  const std::vector<int> points = TransitionFramesOf(in);
  const int second = static_cast<int>(motion.rate_hz);
  return {MeanJointSpeed(motion, points.at(0) - second, points.back() + second), motion.rate_hz};
}

Value SparcOf(const Json& in) {
  const SpeedProfile profile = SpeedOf(in);
  return SpectralArcLength(profile.speed, profile.rate_hz);
}

/// Returns nothing for a method that matches no frames.
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

struct JoinInputs {
  explicit JoinInputs(const Json& in)
      : shown(ReadMotion(in.at("shown"))),
        left(ReadMotion(in.at("left"))),
        wanted(ReadMotion(in.at("wanted"))),
        request(in.at("request").get<int>()),
        first(in.at("first").get<int>()),
        last(in.at("last").get<int>()) {}

  JoinView View() const {
    return {.shown = shown.poses,
            .left = left.poses,
            .wanted = wanted.poses,
            .request = request,
            .first = first,
            .last = last,
            .rate_hz = shown.rate_hz};
  }

  BodyMotion shown, left, wanted;
  int request, first, last;
};

Value OfJoin(const Json& in, double (*measure)(const JoinView&)) { return measure(JoinInputs(in.at("join")).View()); }

std::vector<BodyMotion> ClipsOf(const Json& in) {
  std::vector<BodyMotion> clips;
  for (const Json& clip : in.at("clips")) clips.push_back(ReadMotion(clip));
  return clips;
}

Value Settled(const Json& in) { return SettleSeconds(JoinInputs(in.at("join")).View()); }

Value Strange(const Json& in) { return StrangeCmSeconds(JoinInputs(in.at("join")).View(), RealFrames(ClipsOf(in))); }

Value CalmNatural(const Json& in) {
  std::optional<double> limit;
  for (const BodyMotion& clip : ClipsOf(in)) {
    std::vector<double> jumps = NaturalJumpsCm(clip);
    if (jumps.empty()) return std::nullopt;  // The clip is too short for a limit; clean_share reports that.
    const double own = NaturalLimitCm(std::move(jumps));
    limit = std::min(limit.value_or(own), own);
  }
  if (!limit) return std::nullopt;
  return IsCalmlyNatural(JoinInputs(in.at("join")).View(), *limit) ? 1 : 0;
}

std::vector<Support> SupportOf(const Json& in) { return JoinSupport(JoinInputs(in.at("join")).View()); }

Value Balance(const Json& in) {
  const JoinInputs join(in.at("join"));
  return BalanceCm(join.View(), JoinSupport(join.View()));
}

template <std::size_t kRule>
Value OfBody(const Json& in) {
  const JoinInputs join(in.at("join"));
  return MeasureBody(join.View(), JoinSupport(join.View()))[kRule];
}

CleanMeasures CleanOf(const Json& in) {
  const auto number = [&](const char* key) { return in.at(key).get<double>(); };
  CleanMeasures measures{.natural = in.at("natural").get<bool>(),
                         .calmly_natural = in.at("calmly_natural").get<bool>(),
                         .supported = in.at("supported").get<bool>(),
                         .slide_cmps = number("slide_cmps"),
                         .strange_cm_s = number("strange_cm_s"),
                         .live = number("live"),
                         .own_slide_cmps = number("own_slide_cmps"),
                         .skipped_share = number("skipped_share"),
                         .settle_s = {}};
  if (!in.at("settle_s").is_null()) measures.settle_s = number("settle_s");
  return measures;
}

Value Clean(const Json& in) {
  CleanMeasures measures = CleanOf(in);
  BodyMeasures body;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Json& value = in.at("body").at(std::string(kBodyRules[i].metric));
    if (!value.is_null()) body[i] = value.get<double>();
  }
  measures.possible = IsPossible(body);
  return IsClean(measures) ? 1 : 0;
}

std::optional<int> EnteredFrame(const Json& in) {
  const Json& frame = in.at("entered_frame");
  return frame.is_null() ? std::nullopt : std::optional(frame.get<int>());
}

Value SkippedTime(const Json& in) {
  return SkippedSeconds({.entered_frame = EnteredFrame(in), .rate_hz = in.at("rate_hz").get<double>()});
}

Value SkippedPart(const Json& in) {
  return SkippedShare({.entered_frame = EnteredFrame(in), .frames = in.at("clip_frames").get<int>()});
}

Value InBetween(const Json& in) {
  if (in.at("legs").is_null()) return std::nullopt;
  return in.at("legs").get<int>() > 2 ? 1 : 0;
}

}  // namespace

std::span<const Evaluator> TransitionEvaluators() {
  static constexpr Evaluator kAll[] = {
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
      {"settle_s", Settled},
      {"strange_cm_s", Strange},
      {"join_slide_cmps", [](const Json& in) { return OfJoin(in, JoinSlideCmps); }},
      {"live", [](const Json& in) { return OfJoin(in, Liveness); }},
      {"unsupported_frames", [](const Json& in) -> Value { return UnsupportedFrames(SupportOf(in)); }},
      {"supported_share", [](const Json& in) -> Value { return IsSupported(SupportOf(in)) ? 1 : 0; }},
      {"balance_cm", Balance},
      {"skipped_s", SkippedTime},
      {"skipped_share", SkippedPart},
      {"calm_natural_share", CalmNatural},
      {"clean_share", Clean},
      {"clean_share_v3", [](const Json& in) -> Value { return IsCleanByVersion3(CleanOf(in)) ? 1 : 0; }},
      {"zmp_off_cm", OfBody<0>},
      {"slip_mps2", OfBody<1>},
      {"glide_cm", OfBody<2>},
      {"foot_turn_deg", OfBody<3>},
      {"beyond_joint_deg", OfBody<4>},
      {"overlap_cm", OfBody<5>},
      {"sunk_cm", OfBody<6>},
  };
  return kAll;
}

}  // namespace etude

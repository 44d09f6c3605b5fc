#include "bench/tasks/transition/score.h"

#include <algorithm>
#include <array>

#include "bench/metrics/speed_profile.h"
#include "bench/metrics/transition_join.h"
#include "bench/metrics/transition_smoothness.h"

namespace etude {
namespace {

constexpr std::array kTransitionMetrics = {"jump_cm",
                                           "mean_joint_jump_cm",
                                           "rotation_step_change_deg",
                                           "jerk_peak_mps3",
                                           "natural_share",
                                           "pose_gap_cm",
                                           "velocity_gap_cmps",
                                           "false_smooth",
                                           "foot_slide_cmps",
                                           "sparc",
                                           "ldlj",
                                           "wait_s",
                                           "fuzzy_distance",
                                           "in_between",
                                           "settle_s",
                                           "strange_cm_s",
                                           "join_slide_cmps",
                                           "live",
                                           "skipped_s",
                                           "calm_natural_share",
                                           "clean_share"};
constexpr std::array kMatchingMetrics = {"direct_match", "matching_share", "false_smooth_share"};

/// What played from the request on, until the wanted clip did.
std::vector<Stay> StaysOf(const TransitionRecord& record) {
  std::vector<Stay> stays;
  for (std::size_t i = 0; i + 1 < record.segments.size(); ++i)
    stays.push_back({record.segments[i].first, record.segments[i].last});
  return stays;
}

std::vector<int> PointFrames(const Splice& splice) {
  std::vector<int> frames;
  for (const PlacedPoint& point : splice.points) frames.push_back(point.frame);
  return frames;
}

/// What is measured at the transition points. Returns whether the transition is natural there.
bool ScorePoints(const TransitionOutcome& outcome, const Stage& stage, CellResult& result) {
  const Splice& splice = outcome.splice;
  const TransitionSmoothness smoothness = MeasureTransitions(splice.motion, PointFrames(splice));
  result.Measure("jump_cm", smoothness.jump_cm);
  result.Measure("mean_joint_jump_cm", smoothness.mean_joint_jump_cm);
  result.Measure("rotation_step_change_deg", smoothness.rotation_step_change_deg);
  result.Measure("jerk_peak_mps3", smoothness.jerk_peak_mps3);
  std::vector<double> nature = NaturalJumpsOf(stage, outcome.request.from, outcome.request.to);
  const bool natural = IsNatural(smoothness.jump_cm, std::move(nature));
  result.Measure("natural_share", natural ? 1 : 0);

  double pose_gap = 0, velocity_gap = 0, foot_slide = 0;
  for (const PlacedPoint& point : splice.points) {
    pose_gap = std::max(pose_gap, PoseGapCm(point.leaving, point.arriving));
    velocity_gap = std::max(velocity_gap, VelocityGapCmps(point.leaving_before, point.leaving, point.arriving,
                                                          point.arriving_after, splice.motion.rate_hz));
    foot_slide = std::max(foot_slide, FootSlideCmps(splice.motion, point.frame));
  }
  result.Measure("pose_gap_cm", pose_gap);
  result.Measure("velocity_gap_cmps", velocity_gap);
  if (outcome.matched) {
    result.Measure("false_smooth", IsFalselySmooth(pose_gap) ? 1 : 0);
  } else {
    result.Missing("false_smooth", "the frames were not chosen because they match");
  }
  result.Measure("foot_slide_cmps", foot_slide);
  const FrameWindow second = AroundPoints(splice, 1);
  const std::vector<double> speed = MeanJointSpeed(splice.motion, second.first, second.last);
  constexpr const char* kStill = "nothing moves around the point, or too shortly";
  result.MeasureOr("sparc", SpectralArcLength(speed, splice.motion.rate_hz), kStill);
  result.MeasureOr("ldlj", LogDimensionlessJerk(speed), kStill);
  result.Measure("wait_s", WaitSeconds(StaysOf(outcome.record), splice.motion.rate_hz));
  result.Measure("fuzzy_distance", WorstDistance(outcome.record).value);
  result.Measure("in_between", outcome.record.segments.size() > 2 ? 1 : 0);
  return natural;
}

JoinView ViewOf(const TransitionOutcome& outcome, const Stage& stage) {
  const Splice& splice = outcome.splice;
  const Segment& playing = outcome.record.segments.front();
  const int first = splice.points.front().frame;
  return {.shown = splice.motion.poses,
          .left = stage.library.motions[playing.clip].poses,
          .wanted = splice.wanted,
          .request = first - (playing.last - playing.first),
          .first = first,
          .last = splice.points.back().frame,
          .rate_hz = splice.motion.rate_hz};
}

/// What is measured over the whole join.
void ScoreJoin(const TransitionOutcome& outcome, const Stage& stage, bool natural, CellResult& result) {
  const JoinView view = ViewOf(outcome, stage);
  const double limit = CalmerLimitCm(stage, outcome.request.from, outcome.request.to);
  const CleanMeasures clean{.natural = natural,
                            .calmly_natural = IsCalmlyNatural(view, limit),
                            .slide_cmps = JoinSlideCmps(view),
                            .strange_cm_s = StrangeCmSeconds(view, stage.real_frames),
                            .live = Liveness(view),
                            .own_slide_cmps = std::max(stage.natural_slides_cmps[outcome.request.from],
                                                       stage.natural_slides_cmps[outcome.request.to]),
                            .settle_s = SettleSeconds(view)};
  result.MeasureOr("settle_s", clean.settle_s, "the wanted clip was never reached");
  result.Measure("strange_cm_s", clean.strange_cm_s);
  result.Measure("join_slide_cmps", clean.slide_cmps);
  result.Measure("live", clean.live);
  result.Measure("skipped_s", SkippedSeconds(outcome.record.segments.back().first, view.rate_hz));
  result.Measure("calm_natural_share", clean.calmly_natural ? 1 : 0);
  result.Measure("clean_share", IsClean(clean) ? 1 : 0);
}

}  // namespace

void ScoreTransition(const TransitionOutcome& outcome, const Stage& stage, CellResult& result) {
  const bool natural = ScorePoints(outcome, stage, result);
  ScoreJoin(outcome, stage, natural, result);
}

void ScoreMatching(const std::optional<MatchTally>& tally, CellResult& result) {
  if (!tally) {
    for (const char* id : kMatchingMetrics) result.Missing(id, "this method matches no frames by a threshold");
    return;
  }
  result.Measure("direct_match", HasDirectMatch(*tally) ? 1 : 0);
  result.MeasureOr("matching_share", MatchingShare(*tally), "no pair of frames could be compared");
  result.MeasureOr("false_smooth_share", FalseSmoothShare(*tally), "no pair matches");
}

std::vector<std::string> TransitionMetrics() {
  std::vector<std::string> ids(kTransitionMetrics.begin(), kTransitionMetrics.end());
  ids.insert(ids.end(), kMatchingMetrics.begin(), kMatchingMetrics.end());
  return ids;
}

std::optional<double> TransitionFailureValue(std::string_view metric) {
  const bool is_share = metric == "natural_share" || metric == "calm_natural_share" || metric == "clean_share";
  return is_share ? std::optional(0.0) : std::nullopt;
}

void MeasureNoWay(CellResult& result) {
  for (const char* id : kTransitionMetrics) {
    const std::optional<double> value = TransitionFailureValue(id);
    value ? result.Measure(id, *value) : result.Missing(id, "no way was found");
  }
}

}  // namespace etude

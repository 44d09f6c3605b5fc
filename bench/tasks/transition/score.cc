#include "bench/tasks/transition/score.h"

#include <algorithm>
#include <array>

#include "bench/metrics/dimensionless_jerk.h"
#include "bench/metrics/spectral_arc_length.h"
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
                                           "in_between"};
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

}  // namespace

void ScoreTransition(const TransitionOutcome& outcome, const Stage& stage, CellResult& result) {
  const Splice& splice = outcome.splice;
  const TransitionSmoothness smoothness = MeasureTransitions(splice.motion, PointFrames(splice));
  result.Measure("jump_cm", smoothness.jump_cm);
  result.Measure("mean_joint_jump_cm", smoothness.mean_joint_jump_cm);
  result.Measure("rotation_step_change_deg", smoothness.rotation_step_change_deg);
  result.Measure("jerk_peak_mps3", smoothness.jerk_peak_mps3);
  std::vector<double> nature = NaturalJumpsOf(stage, outcome.request.from, outcome.request.to);
  result.Measure("natural_share", IsNatural(smoothness.jump_cm, std::move(nature)) ? 1 : 0);

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
  return metric == "natural_share" ? std::optional(0.0) : std::nullopt;
}

void MeasureNoWay(CellResult& result) {
  for (const char* id : kTransitionMetrics) {
    const std::optional<double> value = TransitionFailureValue(id);
    value ? result.Measure(id, *value) : result.Missing(id, "no way was found");
  }
}

}  // namespace etude

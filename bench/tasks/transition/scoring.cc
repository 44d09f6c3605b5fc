#include "bench/tasks/transition/scoring.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "bench/metrics/seam.h"
#include "bench/metrics/spectral_arc_length.h"

namespace etude {
namespace {

constexpr std::array kMetricIds = {"jump_cm",
                                   "mean_joint_jump_cm",
                                   "rotation_step_change_deg",
                                   "jerk_peak_mps3",
                                   "natural_share",
                                   "pose_gap_cm",
                                   "velocity_gap_cmps",
                                   "false_smooth",
                                   "foot_slide_cmps",
                                   "sparc",
                                   "wait_s",
                                   "fuzzy_distance"};

/// The meeting that the fuzzy distance thinks worst.
const FuzzyDistance& WorstMeeting(const SwitchRecord& record) {
  return *std::max_element(record.meetings.begin(), record.meetings.end(),
                           [](const FuzzyDistance& a, const FuzzyDistance& b) { return a.value < b.value; });
}

/// What played from the request on, until the wanted clip did.
std::vector<Stay> StaysOf(const SwitchRecord& record) {
  std::vector<Stay> stays;
  for (std::size_t i = 0; i + 1 < record.legs.size(); ++i) stays.push_back({record.legs[i].first, record.legs[i].last});
  return stays;
}

std::string NameOf(const Leg& leg, const Stage& stage) {
  return leg.clip == Leg::kOwnFrames ? "in-between" : stage.library.names[leg.clip];
}

std::vector<int> SeamFrames(const Splice& splice) {
  std::vector<int> frames;
  for (const Seam& seam : splice.seams) frames.push_back(seam.frame);
  return frames;
}

/// Frames `first` … `last` of a motion, clamped to it.
struct Cut {
  int first, last;
};
Cut Around(const Splice& splice, double seconds) {
  const int reach = static_cast<int>(seconds * splice.motion.rate_hz);
  return {std::max(splice.seams.front().frame - reach, 0),
          std::min(splice.seams.back().frame + reach, static_cast<int>(splice.motion.poses.size()) - 1)};
}

nlohmann::ordered_json Partials(const FuzzyDistance& distance) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < kFeatureCount; ++k)
    json[std::string(FeatureName(AllFeatures()[k]))] = distance.partials[k];
  return json;
}

}  // namespace

void ScoreSwitch(const SwitchOutcome& outcome, const Stage& stage, CellResult& result) {
  const Splice& splice = outcome.splice;
  const SeamSmoothness smoothness = MeasureSeams(splice.motion, SeamFrames(splice));
  result.Measure("jump_cm", smoothness.jump_cm);
  result.Measure("mean_joint_jump_cm", smoothness.mean_joint_jump_cm);
  result.Measure("rotation_step_change_deg", smoothness.rotation_step_change_deg);
  result.Measure("jerk_peak_mps3", smoothness.jerk_peak_mps3);
  const std::vector<Leg>& legs = outcome.record.legs;
  std::vector<double> nature = NaturalJumpsOf(stage, legs.front().clip, legs.back().clip);
  result.Measure("natural_share", IsNatural(smoothness.jump_cm, std::move(nature)) ? 1 : 0);

  double pose_gap = 0, velocity_gap = 0, foot_slide = 0;
  for (const Seam& seam : splice.seams) {
    pose_gap = std::max(pose_gap, PoseGapCm(seam.leaving, seam.arriving));
    velocity_gap = std::max(velocity_gap, VelocityGapCmps(seam.leaving_before, seam.leaving, seam.arriving,
                                                          seam.arriving_after, splice.motion.rate_hz));
    foot_slide = std::max(foot_slide, FootSlideCmps(splice.motion, seam.frame));
  }
  result.Measure("pose_gap_cm", pose_gap);
  result.Measure("velocity_gap_cmps", velocity_gap);
  if (outcome.matched) {
    result.Measure("false_smooth", IsFalselySmooth(pose_gap) ? 1 : 0);
  } else {
    result.Missing("false_smooth", "this choice matches no frames");
  }
  result.Measure("foot_slide_cmps", foot_slide);
  const Cut second = Around(splice, 1);
  const auto arc = SpectralArcLength(MeanJointSpeed(splice.motion, second.first, second.last), splice.motion.rate_hz);
  result.MeasureOr("sparc", arc, "nothing moves around the seam");
  result.Measure("wait_s", WaitSeconds(StaysOf(outcome.record), splice.motion.rate_hz));
  result.Measure("fuzzy_distance", WorstMeeting(outcome.record).value);
}

std::vector<std::string> TransitionMetrics() { return {kMetricIds.begin(), kMetricIds.end()}; }

std::optional<double> SwitchFailureValue(std::string_view metric) {
  return metric == "natural_share" ? std::optional(0.0) : std::nullopt;
}

void MeasureNoWay(CellResult& result) {
  for (const char* id : kMetricIds) {
    const std::optional<double> value = SwitchFailureValue(id);
    value ? result.Measure(id, *value) : result.Missing(id, "no way was found");
  }
}

Series SeamSeries(const SwitchOutcome& outcome) {
  const Cut cut = Around(outcome.splice, 1);
  const std::vector<double> all = SecondDifferencesCm(outcome.splice.motion);
  return {"second_difference_cm", "frame", {all.begin() + cut.first, all.begin() + cut.last + 1}};
}

Recording RecordSwitch(const SwitchOutcome& outcome, const Stage& stage) {
  constexpr double kSeconds = 2.5;
  const Cut cut = Around(outcome.splice, kSeconds);
  const std::vector<BodyPose>& all = outcome.splice.motion.poses;
  Track coach{"coach", {outcome.splice.motion.rate_hz, {all.begin() + cut.first, all.begin() + cut.last + 1}}};

  const SwitchRecord& record = outcome.record;
  const FuzzyDistance& distance = WorstMeeting(record);
  nlohmann::ordered_json facts;
  facts["seam_frame"] = outcome.splice.seams.front().frame - cut.first;
  facts["seam_frames"] = nlohmann::json::array();
  for (const Seam& seam : outcome.splice.seams) facts["seam_frames"].push_back(seam.frame - cut.first);
  facts["from"] = NameOf(record.legs.front(), stage);
  facts["to"] = NameOf(record.legs.back(), stage);
  facts["branch"] = BranchName(record.branch);
  facts["distance"] = distance.value;
  facts["partials"] = Partials(distance);
  facts["request_frame"] = record.request_frame - cut.first;  // negative: before this recording begins
  facts["wait_s"] = record.wait_s;
  facts["pairs_seen"] = record.pairs_seen;
  facts["switches"] = nlohmann::json::array();
  for (std::size_t i = 0; i < record.meetings.size(); ++i) {
    const Leg &old = record.legs[i], &next = record.legs[i + 1];
    nlohmann::ordered_json entry;
    entry["from"] = NameOf(old, stage);
    entry["from_frame"] = old.last;
    entry["to"] = NameOf(next, stage);
    entry["to_frame"] = next.first;
    entry["distance"] = record.meetings[i].value;
    facts["switches"].push_back(std::move(entry));
  }
  return {{std::move(coach)}, facts.dump()};
}

}  // namespace etude

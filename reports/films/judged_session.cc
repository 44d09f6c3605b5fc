#include "reports/films/judged_session.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "bench/model/recording.h"
#include "engine/fuzzy/features.h"
#include "engine/recognition/key_pose.h"
#include "reports/words/cell_series.h"

namespace etude {
namespace {

using Facts = JudgedSessionFacts;

TrackingState StateOf(char letter) {
  if (letter == 't') return TrackingState::kTracked;
  return letter == 'i' ? TrackingState::kInferred : TrackingState::kNotTracked;
}

Result<SkeletonStream> StreamOf(const BodyMotion& motion, const std::vector<std::string>& states, const Place& place) {
  if (states.size() < motion.poses.size()) {
    return Fail(place, "its extras are no judged session's: joint_states of {} frames; the motion has {}",
                states.size(), motion.poses.size());
  }
  SkeletonStream stream{.rate_hz = motion.rate_hz, .frames = {}};
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    const std::string& letters = states[frame];
    if (letters.size() < kRoleCount) {
      return Fail(place, "its extras are no judged session's: joint_states[{}] tells of {} joints, not {}", frame,
                  letters.size(), kRoleCount);
    }
    SensedFrame& sensed = stream.frames.emplace_back();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      sensed.joints[j] = {motion.poses[frame].joints[j], StateOf(letters[j])};
    }
    sensed.body_seen = letters.find_first_not_of('n') != std::string::npos;
  }
  return stream;
}

std::map<std::string, std::vector<TaughtPose>> KeyPosesIn(const std::vector<DetectionExtras::Move>& moves) {
  std::map<std::string, std::vector<TaughtPose>> all;
  for (const DetectionExtras::Move& move : moves) {
    for (const auto& targets : move.key_poses) {
      TaughtPose& pose = all[move.name].emplace_back();
      for (const DetectionExtras::Target& target : targets) {
        const Feature* feature = FindFeature(target.feature);
        if (feature != nullptr) pose.targets.push_back({*feature, target.degrees, target.tolerance_deg});
      }
    }
  }
  return all;
}

std::vector<Facts::Performance> PerformancesIn(const DetectionExtras& extras, const SeenStream& seen) {
  const auto poses = KeyPosesIn(extras.moves);
  const int frames = static_cast<int>(seen.frames.size());
  std::vector<Facts::Performance> performances;
  for (const DetectionExtras::Event& event : extras.events) {
    Facts::Performance& performance = performances.emplace_back();
    performance.move = event.move;
    performance.truth = event.truth;
    performance.fault = event.fault;
    performance.begin_frame = std::clamp(event.begin_frame, 0, frames);
    performance.end_frame = std::clamp(event.end_frame, performance.begin_frame, frames);
    if (const auto known = poses.find(performance.move); known != poses.end()) performance.poses = known->second;
    const auto window = std::span(seen.frames)
                            .subspan(static_cast<std::size_t>(performance.begin_frame),
                                     static_cast<std::size_t>(performance.end_frame - performance.begin_frame));
    performance.reached = WhenReached(performance.poses, window, {}, {});
    for (auto& when : performance.reached) {
      if (when) *when += performance.begin_frame;
    }
  }
  return performances;
}

Facts::Judge JudgeIn(const DetectionExtras& extras, const std::string& method) {
  Facts::Judge judge{.method = method, .called_right = {}, .alarms = extras.alarms};
  for (const DetectionExtras::Event& event : extras.events) judge.called_right.push_back(event.called_frame);
  return judge;
}

Result<DetectionExtras> ExtrasOf(const Recording& recording, const Place& place) {
  auto extras = ReadDetectionExtras(recording.extras_json);
  if (!extras) return Fail(place, "its extras are no judged session's: {}", extras.error().message);
  return extras;
}

/// Adds the other methods in the same world, as many as the timeline has rows for.
Result<void> AddOtherJudges(const RunData& run, const CastCell& cell, Facts& facts) {
  constexpr std::size_t kMostJudges = 2;
  for (const auto& [row, recorded] : RecordedRows(run)) {
    if (facts.judges.size() == kMostJudges) return {};
    const bool same_world = row->scenario == cell.row->scenario && row->condition == cell.row->condition &&
                            row->trial == cell.row->trial && row->method != cell.row->method;
    if (!same_world) continue;
    ASSIGN_OR_RETURN(const auto extras, ExtrasOf(recorded->recording, {.file = "recording " + recorded->cell}));
    Facts::Judge other = JudgeIn(extras, row->method);
    if (other.called_right.size() == facts.performances.size()) facts.judges.push_back(std::move(other));
  }
  return {};
}

}  // namespace

Result<JudgedSessionFacts> ReadJudgedSession(const RunData& run, const CastCell& cell) {
  const Place place{.file = "recording " + cell.row->Id()};
  const BodyMotion* truth = FindTrack(*cell.recording, "truth");
  const BodyMotion* sensed = FindTrack(*cell.recording, "sensed");
  if (truth == nullptr || sensed == nullptr || sensed->poses.empty()) {
    return Fail(place, "has no tracks 'truth' and 'sensed'");
  }
  if (truth->poses.size() != sensed->poses.size()) return Fail(place, "its tracks are not of one length");
  ASSIGN_OR_RETURN(const auto extras, ExtrasOf(*cell.recording, place));
  ASSIGN_OR_RETURN(const auto stream, StreamOf(*sensed, extras.joint_states, place));
  JudgedSessionFacts facts;
  facts.truth = *truth;
  facts.seen = SeeStream(stream, {});
  facts.threshold = extras.threshold;
  facts.performances = PerformancesIn(extras, facts.seen);
  facts.judges.push_back(JudgeIn(extras, cell.row->method));
  RETURN_IF_ERROR(AddOtherJudges(run, cell, facts));
  if (facts.performances.empty()) return Fail(place, "nothing was asked for");
  const Series* score = FindSeries(run, *cell.row, "score");
  if (score != nullptr && score->values.size() == sensed->poses.size()) facts.evidence = score->values;
  return facts;
}

}  // namespace etude

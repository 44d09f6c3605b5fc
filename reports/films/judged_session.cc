#include "reports/films/judged_session.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/model/recording.h"
#include "engine/fuzzy/features.h"
#include "engine/recognition/key_pose.h"

namespace etude {
namespace {

using SessionJson = nlohmann::json;
using Facts = JudgedSessionFacts;

TrackingState StateOf(char letter) {
  if (letter == 't') return TrackingState::kTracked;
  return letter == 'i' ? TrackingState::kInferred : TrackingState::kNotTracked;
}

SkeletonStream StreamOf(const BodyMotion& motion, const SessionJson& states) {
  SkeletonStream stream{.rate_hz = motion.rate_hz, .frames = {}};
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    const auto letters = states.at(frame).get<std::string>();
    SensedFrame& sensed = stream.frames.emplace_back();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      sensed.joints[j] = {motion.poses[frame].joints[j], StateOf(letters.at(j))};
    }
    sensed.body_seen = letters.find_first_not_of('n') != std::string::npos;
  }
  return stream;
}

std::map<std::string, std::vector<TaughtPose>> KeyPosesIn(const SessionJson& moves) {
  std::map<std::string, std::vector<TaughtPose>> all;
  for (const SessionJson& move : moves) {
    std::vector<TaughtPose>& poses = all[move.at("name").get<std::string>()];
    for (const SessionJson& told : move.at("key_poses")) {
      TaughtPose& pose = poses.emplace_back();
      for (const SessionJson& target : told) {
        const Feature* feature = FindFeature(target.at("feature").get<std::string>());
        if (feature == nullptr) continue;
        pose.targets.push_back(
            {*feature, target.at("degrees").get<double>(), target.at("tolerance_deg").get<double>()});
      }
    }
  }
  return all;
}

/// By paper A's crisp rule, in their order: the first frame at which the poses so far were all passed.
std::vector<std::optional<int>> WhenReached(const Facts::Performance& performance, const SeenStream& seen) {
  constexpr double kMet = 0.5;
  const KeyPoseOptions options;
  std::vector<std::optional<int>> reached;
  for (std::size_t count = 1; count <= performance.poses.size(); ++count) {
    PoseSequence sequence(count, options.hold_frames, 0);
    sequence.Open();
    auto& when = reached.emplace_back();
    for (int frame = performance.begin_frame; frame < performance.end_frame && !when; ++frame) {
      const FeatureFrame& features = seen.frames[static_cast<std::size_t>(frame)];
      std::vector<double> matches;
      for (std::size_t k = 0; k < count && features.body_seen; ++k) {
        matches.push_back(MatchOf(features, performance.poses[k], {}, options));
      }
      sequence.Update(matches);
      if (sequence.Asked() >= kMet) when = frame;
    }
  }
  return reached;
}

std::vector<Facts::Performance> PerformancesIn(const SessionJson& extras, const SeenStream& seen) {
  const auto poses = KeyPosesIn(extras.at("moves"));
  const int frames = static_cast<int>(seen.frames.size());
  std::vector<Facts::Performance> performances;
  for (const SessionJson& event : extras.at("events")) {
    Facts::Performance& performance = performances.emplace_back();
    performance.move = event.at("move").get<std::string>();
    performance.truth = event.at("truth").get<std::string>();
    performance.fault = event.at("fault").get<std::string>();
    performance.begin_frame = std::clamp(event.at("begin_frame").get<int>(), 0, frames);
    performance.end_frame = std::clamp(event.at("end_frame").get<int>(), performance.begin_frame, frames);
    if (const auto known = poses.find(performance.move); known != poses.end()) performance.poses = known->second;
    performance.reached = WhenReached(performance, seen);
  }
  return performances;
}

Facts::Judge JudgeIn(const SessionJson& extras, const std::string& method) {
  Facts::Judge judge{.method = method, .called_right = {}, .alarms = {}};
  for (const SessionJson& event : extras.at("events")) {
    auto& called = judge.called_right.emplace_back();
    if (event.contains("called_frame")) called = event.at("called_frame").get<int>();
  }
  for (const SessionJson& alarm : extras.at("alarms")) {
    judge.alarms.push_back({alarm.at("move").get<std::string>(), alarm.at("frame").get<int>()});
  }
  return judge;
}

void Fill(const RunData& run, const CastCell& cell, const BodyMotion& sensed, Facts& facts) {
  const SessionJson extras = SessionJson::parse(cell.recording->extras_json);
  facts.seen = SeeStream(StreamOf(sensed, extras.at("joint_states")), {});
  facts.performances = PerformancesIn(extras, facts.seen);
  facts.judges.push_back(JudgeIn(extras, cell.row->method));
  if (extras.contains("threshold")) facts.threshold = extras.at("threshold").get<double>();
  constexpr std::size_t kMostJudges = 2;  // as many as the timeline has rows for
  for (const CellRecording& recorded : run.recordings) {
    const auto row = std::ranges::find_if(run.rows, [&](const Row& each) { return each.Id() == recorded.cell; });
    if (row == run.rows.end() || facts.judges.size() == kMostJudges) continue;
    const bool same_world = row->scenario == cell.row->scenario && row->condition == cell.row->condition &&
                            row->trial == cell.row->trial && row->method != cell.row->method;
    if (!same_world) continue;
    Facts::Judge other = JudgeIn(SessionJson::parse(recorded.recording.extras_json), row->method);
    if (other.called_right.size() == facts.performances.size()) facts.judges.push_back(std::move(other));
  }
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
  JudgedSessionFacts facts;
  facts.truth = *truth;
  try {
    Fill(run, cell, *sensed, facts);
  } catch (const SessionJson::exception& error) {
    return Fail(place, "its extras are no judged session's: {}", error.what());
  } catch (const std::out_of_range&) {
    return Fail(place, "its extras are no judged session's: a frame tells too few joints");
  }
  if (facts.performances.empty()) return Fail(place, "nothing was asked for");
  const Series* score = FindSeries(run, *cell.row, "score");
  if (score != nullptr && score->values.size() == sensed->poses.size()) facts.evidence = score->values;
  return facts;
}

}  // namespace etude

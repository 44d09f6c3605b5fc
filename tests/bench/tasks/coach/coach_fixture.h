#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// Returns the stage of a song, for sessions with scripted players instead of learners.
inline const CoachStage& StageOf(std::string_view song) {
  static std::map<std::string, CoachStage, std::less<>> stages;
  auto found = stages.find(song);
  if (found == stages.end()) found = stages.emplace(song, *SetCoachStage(std::string(song))).first;
  return found->second;
}

inline CoachCondition ConditionOf(const std::string& song, double seconds, double noise) {
  CoachCondition condition{.song = song, .session_s = seconds};
  condition.sight.noise = noise;
  return condition;
}

inline CoachWorld WorldOf(const CoachCondition& condition, int trial = 0) {
  return MakeCoachWorld(condition, {1, "coach-test", trial});
}

inline std::vector<ReadyCoach> CoachesOf(const CoachStage& stage, std::vector<CoachMethod> methods) {
  return *MakeReady(std::move(methods), stage);
}

inline CoachMethod MethodOf(const std::string& policy, const std::string& recogniser = "key-pose") {
  CoachMethod method{.name = policy};
  method.policy.policy = FindPolicy(policy);
  method.sight.recogniser.kind = FindRecogniser(recogniser);
  method.transition.way = DefaultWay();
  return method;
}

/// Copies the coach at the same moment, but stands still in the named repetitions.
class Mimic final : public Player {
 public:
  explicit Mimic(const CoachStage& stage, std::vector<int> skipped = {})
      : stage_(stage), skipped_(std::move(skipped)) {}

  BodyPose Next(const CoachOutput& shown) override {
    const auto& poses = stage_.dance().motion.poses;
    if (shown.mode != CoachMode::kDance || shown.clip != "dance") return poses.front();
    const double frame = shown.clip_frame + 1 + static_cast<double>(SkeletonSensor::kAhead);
    if (Skips(stage_.library->RepetitionAt(frame))) return poses.front();
    return poses[std::min(poses.size() - 1, static_cast<std::size_t>(frame))];
  }
  std::optional<PlayedPerformance> PerformanceOf(int repetition) const override {
    if (Skips(repetition)) return PlayedPerformance{PerformanceTruth::kWrong, "skipped"};
    return PlayedPerformance{};
  }
  bool HasGivenUp() const override { return false; }
  std::vector<double> TakeTest(int) override { return {1}; }

 private:
  bool Skips(int repetition) const { return std::ranges::find(skipped_, repetition) != skipped_.end(); }

  const CoachStage& stage_;
  std::vector<int> skipped_;
};

inline std::vector<int> EveryRepetition(const CoachStage& stage) {
  std::vector<int> all;
  for (std::size_t i = 0; i < stage.dance().repetitions.size(); ++i) all.push_back(static_cast<int>(i));
  return all;
}

inline SessionLog SessionWith(const ReadyCoach& ready, const CoachWorld& world, Player& player,
                              MomentSource* moments = nullptr) {
  const SessionParts parts{*ready.coach, *ready.recogniser, ready.method.sight.filter, ready.method.sight.sees_truth,
                           ready.method.sight.Capture()};
  return *RunSession(parts, world, player, moments);
}

inline CorrectionTally TallyOf(const SessionLog& log) {
  CoachedSession session{.rate_hz = kJudgedRateHz, .frames = log.Frames(), .performances = {}, .corrections = {}};
  for (const LoggedPerformance& performance : log.performances) session.performances.push_back(performance.judged);
  session.corrections = log.corrections;
  return TallyCorrections(session);
}

}  // namespace etude

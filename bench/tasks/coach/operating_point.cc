#include "bench/tasks/coach/operating_point.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/recognition/sight.h"

namespace etude {

Result<ReadyCoach> MakeWatching(const CoachStage& stage) {
  CoachMethod method;
  method.name = "watching";
  method.policy.policy = FindPolicy("never");
  // No evidence exceeds 1, so with this threshold no performance counts as right before its window has closed.
  constexpr double kNever = 2;
  method.sight.threshold = kNever;
  std::vector<CoachMethod> methods;
  methods.push_back(std::move(method));
  ASSIGN_OR_RETURN(auto ready, MakeReady(std::move(methods), stage));
  return std::move(ready.front());
}

void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double)>& judged) {
  LiveSight sight(filter, kJudgedRateHz);
  const auto follower = recogniser.Follow(kJudgedRateHz);
  auto next = log.performances.begin();
  const LoggedPerformance* open = nullptr;
  for (int frame = 0; frame < log.Frames(); ++frame) {
    if (next != log.performances.end() && frame == next->judged.begin_frame) {
      open = &*next++;
      follower->Ask(static_cast<std::size_t>(open->move));
    }
    const double evidence = follower->Update(sight.Update(log.sensed.frames[static_cast<std::size_t>(frame)])).asked;
    if (open == nullptr || frame != open->judged.end_frame) continue;
    judged(*open, evidence);
    follower->Ask(std::nullopt);
    open = nullptr;
  }
}

namespace {

bool IsSet(const CoachMethod& method) {
  return method.sight.threshold || method.policy.policy->asks_truth || method.seat == Seat::kRecogniser;
}

}  // namespace

double ThresholdOf(std::vector<double> right, double minutes, double needless_per_min) {
  std::ranges::sort(right);
  const auto allowed = static_cast<std::size_t>(std::floor(needless_per_min * minutes));
  return allowed < right.size() ? right[allowed] : 1.0;
}

Result<void> SetThresholds(const CoachCondition& condition, const CoachStage& stage, const WorldKey& key,
                           std::vector<CoachMethod>& methods) {
  if (!condition.operating_point || std::ranges::all_of(methods, IsSet)) return {};
  std::vector<std::unique_ptr<Recogniser>> recognisers;
  for (const CoachMethod& method : methods) {
    ASSIGN_OR_RETURN(auto recogniser, MakeRecogniser(method.sight.recogniser, stage.taught));
    recognisers.push_back(std::move(recogniser));
  }
  // Record sessions of other people, and collect the evidence for their right performances.
  ASSIGN_OR_RETURN(const ReadyCoach watching, MakeWatching(stage));
  const std::string others = std::string(key.scenario) + "/operating-point";
  std::vector<std::vector<double>> right(methods.size());
  double minutes = 0;
  for (int session = 0; session < condition.operating_point->sessions; ++session) {
    const CoachWorld world = MakeCoachWorld(condition, {key.suite_seed, others, session});
    ASSIGN_OR_RETURN(SessionLog log, RunMethod(watching, condition, stage, world, nullptr));
    minutes += log.Frames() / kJudgedRateHz / 60;
    const SkeletonStream sensed = log.sensed, danced = StreamOf(log.learner);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (IsSet(methods[m])) continue;
      log.sensed = methods[m].sight.sees_truth ? danced : sensed;
      FollowPerformances(log, *recognisers[m], methods[m].sight.filter,
                         [&](const LoggedPerformance& performance, double evidence) {
                           if (performance.judged.truth == PerformanceTruth::kRight) right[m].push_back(evidence);
                         });
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (IsSet(methods[m])) continue;
    methods[m].sight.threshold = ThresholdOf(std::move(right[m]), minutes, condition.operating_point->needless_per_min);
  }
  return {};
}

}  // namespace etude

#include "bench/tasks/coach/followed_session.h"

#include <utility>

#include "engine/recognition/sight.h"

namespace etude {

Result<ReadyCoach> MakeWatching(const CoachStage& stage) {
  CoachMethod method;
  method.name = "watching";
  method.policy.policy = FindPolicy("never");
  constexpr double kNever = 2;  // evidence ends at 1: no performance counts as right before its window has closed
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

}  // namespace etude

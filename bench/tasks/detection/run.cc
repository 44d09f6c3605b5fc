#include "bench/tasks/detection/run.h"

namespace etude {

SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method) {
  return SeeStream(method.sees_truth ? StreamOf(world.session.motion) : world.stream, method.filter);
}

Result<SessionVerdict> JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                                    const Recogniser& recogniser, const DecisionOptions& decision) {
  std::vector<AskedMove> asked;
  for (const SessionEvent& event : world.session.events) {
    asked.push_back({repertoire.IndexOf(event.move), WindowOf(event, world.stream)});
  }
  ASSIGN_OR_RETURN(const EvidenceTrace trace, FollowStream(recogniser, repertoire.taught.size(), seen, asked));
  SessionVerdict verdict{.filtered = seen.filtered, .events = {}, .alarms = {}};
  for (const AskedMove& move : asked) {
    verdict.events.push_back(JudgeWindow(trace, move.window, decision.threshold));
  }
  verdict.alarms = FindMoves(trace, seen.filtered.rate_hz, decision);
  std::erase_if(verdict.alarms, [&](const Detection& detection) {
    return IsPerformance(repertoire.taught[detection.move].name, detection.frame, world);
  });
  return verdict;
}

}  // namespace etude

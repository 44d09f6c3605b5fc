#include "bench/tasks/detection/run.h"

#include <cassert>

namespace etude {

SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method) {
  return SeeStream(method.sees_truth ? StreamOf(world.session.motion) : world.stream, method.filter);
}

EvidenceTrace FollowSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                            const Recogniser& recogniser) {
  std::vector<AskedMove> asked;
  for (const SessionEvent& event : world.session.events) {
    asked.push_back({repertoire.IndexOf(event.move), WindowOf(event, world.stream)});
  }
  auto trace = FollowStream(recogniser, repertoire.taught.size(), seen, asked);
  assert(trace);  // a session's windows lie within it and never overlap
  return *std::move(trace);
}

SessionVerdict JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                            const Recogniser& recogniser, const DecisionOptions& decision) {
  const EvidenceTrace trace = FollowSession(world, seen, repertoire, recogniser);
  SessionVerdict verdict{.filtered = seen.filtered, .events = {}, .alarms = {}};
  for (const SessionEvent& event : world.session.events) {
    verdict.events.push_back(JudgeWindow(trace, WindowOf(event, world.stream), decision.threshold));
  }
  verdict.alarms = FindMoves(trace, seen.filtered.rate_hz, decision);
  std::erase_if(verdict.alarms, [&](const Detection& detection) {
    return IsPerformance(repertoire.taught[detection.move].name, detection.frame, world);
  });
  return verdict;
}

}  // namespace etude

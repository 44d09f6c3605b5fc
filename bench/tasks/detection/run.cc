#include "bench/tasks/detection/run.h"

namespace etude {

SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method) {
  return SeeStream(method.sees_truth ? StreamOf(world.session.motion) : world.stream, method.filter);
}

Result<SessionVerdict> JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                                    const DetectionMethod& method) {
  std::vector<AskedMove> asked;
  for (const SessionEvent& event : world.session.events) asked.push_back({event.move, WindowOf(event, world.stream)});
  ASSIGN_OR_RETURN(Recognition recognition,
                   Recognise({.seen = seen, .asked = asked, .taught = repertoire.taught}, method.recogniser));
  std::erase_if(recognition.detections,
                [&](const Detection& detection) { return IsPerformance(detection.move, detection.frame, world); });
  return SessionVerdict{seen.filtered, std::move(recognition.judgements), std::move(recognition.detections)};
}

}  // namespace etude

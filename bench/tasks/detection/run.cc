#include "bench/tasks/detection/run.h"

#include <cassert>

#include "bench/tasks/sensing/camera_stream.h"

namespace etude {

SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method) {
  if (method.sees_truth) return SeeStream(StreamOf(world.session.motion), method.filter);
  if (world.cameras == nullptr) return SeeStream(world.stream, method.filter);
  const Result<SkeletonStream>& captured = world.cameras->See(method.Capture());
  return SeeStream(captured ? *captured : world.stream, method.filter);
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

namespace {

/// The move with the most evidence of any frame in the window; the first on a tie.
std::optional<std::size_t> MoveNamedIn(const FrameInterval& window, const EvidenceTrace& trace) {
  std::optional<std::size_t> named;
  double most = 0;
  for (int frame = window.begin; frame < window.end; ++frame) {
    const auto spotted = trace.SpottedAt(static_cast<std::size_t>(frame));
    for (std::size_t move = 0; move < spotted.size(); ++move) {
      if (spotted[move] > most || (spotted[move] == most && named && move < *named)) {
        most = spotted[move];
        named = move;
      }
    }
  }
  return named;
}

}  // namespace

SessionVerdict JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                            const Recogniser& recogniser, const DecisionOptions& decision) {
  const EvidenceTrace trace = FollowSession(world, seen, repertoire, recogniser);
  SessionVerdict verdict{.filtered = seen.filtered, .events = {}, .alarms = {}};
  for (const SessionEvent& event : world.session.events) {
    const FrameInterval window = WindowOf(event, world.stream);
    verdict.events.push_back(JudgeWindow(trace, window, decision.threshold));
    verdict.named.push_back(MoveNamedIn(window, trace));
  }
  verdict.alarms = FindMoves(trace, seen.filtered.rate_hz, decision);
  std::erase_if(verdict.alarms, [&](const Detection& detection) {
    return IsPerformance(repertoire.taught[detection.move].name, detection.frame, world);
  });
  return verdict;
}

}  // namespace etude

#include "bench/tasks/detection/judge.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

bool IsPerformance(const std::string& move, int frame, const DetectionWorld& world) {
  return std::any_of(world.session.events.begin(), world.session.events.end(), [&](const SessionEvent& event) {
    const Window window = WindowOf(event, world.stream);
    return (event.move == move || event.danced == move) && frame >= window.begin && frame < window.end;
  });
}

}  // namespace

Window WindowOf(const SessionEvent& event, const SkeletonStream& stream) {
  const int count = static_cast<int>(stream.frames.size());
  const int begin = std::clamp(static_cast<int>(std::floor(event.start_s * stream.rate_hz)), 0, count);
  const int end = std::clamp(static_cast<int>(std::ceil(event.WindowEnd() * stream.rate_hz)), begin, count);
  return {begin, end};
}

SessionVerdict JudgeSession(const DetectionWorld& world, const Repertoire& repertoire, const DetectionMethod& method) {
  SessionVerdict verdict;
  verdict.filtered = Smooth(world.stream, method.filter);
  const std::vector<FeatureFrame> frames = SeeFeatures(verdict.filtered, EstimateStandingHipHeight(verdict.filtered));
  const std::span<const FeatureFrame> all(frames);

  for (const SessionEvent& event : world.session.events) {
    const Window window = WindowOf(event, world.stream);
    verdict.events.push_back(JudgeWindow(all.subspan(window.begin, window.end - window.begin),
                                         repertoire.taught.at(event.move), method.recogniser));
  }
  for (const auto& [move, taught] : repertoire.taught) {
    for (int frame : FindMove(all, taught, method.recogniser, repertoire.span_frames.at(move))) {
      if (!IsPerformance(move, frame, world)) verdict.alarms.push_back({move, frame});
    }
  }
  return verdict;
}

}  // namespace etude

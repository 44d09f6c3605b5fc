#include "bench/tasks/detection/run.h"

#include <algorithm>
#include <cmath>

#include "bench/metrics/detection.h"

namespace etude {
namespace {

/// A sensor without errors.
SkeletonStream TrueStream(const BodyMotion& motion) {
  SkeletonStream stream{.rate_hz = motion.rate_hz, .frames = {}};
  for (const BodyPose& pose : motion.poses) {
    SensedFrame& frame = stream.frames.emplace_back();
    frame.body_seen = true;
    for (std::size_t i = 0; i < kRoleCount; ++i) frame.joints[i] = {pose.joints[i], TrackingState::kTracked};
  }
  return stream;
}

}  // namespace

Window WindowOf(const SessionEvent& event, const SkeletonStream& stream) {
  const int count = static_cast<int>(stream.frames.size());
  const int begin = std::clamp(static_cast<int>(std::floor(event.start_s * stream.rate_hz)), 0, count);
  const int end = std::clamp(static_cast<int>(std::ceil(event.WindowEnd() * stream.rate_hz)), begin, count);
  return {begin, end};
}

bool IsPerformance(const std::string& move, int frame, const DetectionWorld& world) {
  std::vector<MoveWindow> windows;
  for (const SessionEvent& event : world.session.events) {
    const Window window = WindowOf(event, world.stream);
    windows.push_back({event.move, event.danced, window.begin, window.end});
  }
  return !IsFalseAlarm(move, frame, windows);
}

SeenSession SeeSession(const DetectionWorld& world, const DetectionMethod& method) {
  SeenSession seen;
  seen.filtered = Smooth(method.sees_truth ? TrueStream(world.session.motion) : world.stream, method.filter);
  seen.frames = SeeFeatures(seen.filtered, EstimateStandingHipHeight(seen.filtered));
  return seen;
}

SessionVerdict JudgeSession(const DetectionWorld& world, const SeenSession& seen, const Repertoire& repertoire,
                            const DetectionMethod& method) {
  SessionVerdict verdict;
  verdict.filtered = seen.filtered;
  const std::span<const FeatureFrame> all(seen.frames);
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

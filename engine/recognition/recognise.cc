#include "engine/recognition/recognise.h"

#include <algorithm>
#include <cmath>

#include "engine/base/named.h"
#include "engine/base/names.h"

namespace etude {
namespace {

Result<void> CheckOptions(const KeyPoseOptions& options) {
  if (!(options.threshold > 0 && options.threshold <= 1)) {
    return Fail({}, "threshold {}; allowed: above 0, up to 1", options.threshold);
  }
  if (options.hold_frames < 1) return Fail({}, "hold_frames {}; allowed: 1 or more", options.hold_frames);
  return {};
}

Result<void> CheckTaught(const TaughtMove& move) {
  if (move.poses.empty()) return Fail({}, "move '{}' has no key pose", move.name);
  for (const TaughtPose& pose : move.poses) {
    const auto is_usable = [](const PoseTarget& target) { return target.tolerance_deg > 0; };
    if (pose.targets.empty()) return Fail({}, "a key pose of move '{}' has no target", move.name);
    if (!std::ranges::all_of(pose.targets, is_usable)) {
      return Fail({}, "a target of move '{}' has no tolerance above 0", move.name);
    }
  }
  return {};
}

Result<void> CheckAsked(const AskedMove& asked, const RecognitionInput& input) {
  if (FindByName(input.taught, asked.name) == nullptr) {
    return Fail({}, "{}", UnknownName("move", asked.name, NamesOf(input.taught)));
  }
  const int frames = static_cast<int>(input.seen.frames.size());
  const auto [begin, end] = asked.window;
  if (begin < 0 || end < begin || end > frames) {
    return Fail({}, "move '{}' is asked for in frames {} to {}; the stream has {}", asked.name, begin, end, frames);
  }
  return {};
}

Result<void> Check(const RecognitionInput& input, const KeyPoseOptions& options) {
  RETURN_IF_ERROR(CheckOptions(options));
  for (const TaughtMove& move : input.taught) RETURN_IF_ERROR(CheckTaught(move));
  for (const AskedMove& asked : input.asked) RETURN_IF_ERROR(CheckAsked(asked, input));
  return {};
}

}  // namespace

FrameInterval FramesBetween(double start_s, double end_s, const SkeletonStream& stream) {
  const int count = static_cast<int>(stream.frames.size());
  const int begin = std::clamp(static_cast<int>(std::floor(start_s * stream.rate_hz)), 0, count);
  const int end = std::clamp(static_cast<int>(std::ceil(end_s * stream.rate_hz)), begin, count);
  return {begin, end};
}

SeenStream SeeStream(const SkeletonStream& stream, const FilterOptions& filter) {
  SeenStream seen{.filtered = Smooth(stream, filter), .frames = {}};
  seen.frames = SeeFeatures(seen.filtered, EstimateStandingHipHeight(seen.filtered));
  return seen;
}

Result<Recognition> Recognise(const RecognitionInput& input, const KeyPoseOptions& options) {
  RETURN_IF_ERROR(Check(input, options));
  Recognition recognition;
  const std::span<const FeatureFrame> all(input.seen.frames);
  for (const auto& [name, window] : input.asked) {
    const auto frames = all.subspan(window.begin, window.end - window.begin);
    recognition.judgements.push_back(JudgeWindow(frames, *FindByName(input.taught, name), options));
  }
  for (const TaughtMove& move : input.taught) {
    for (int frame : FindMove(all, move, options)) recognition.detections.push_back({move.name, frame});
  }
  return recognition;
}

}  // namespace etude

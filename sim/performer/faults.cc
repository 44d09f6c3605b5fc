#include "sim/performer/faults.h"

#include <functional>

#include "sim/choreography/canonical_body.h"
#include "sim/choreography/reach.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

/// The key poses with tolerances so wide that a learner's own deviations cannot matter.
std::vector<KeyPose> Widened(std::vector<KeyPose> key_poses) {
  constexpr double kClearlyDeg = 8;
  for (KeyPose& key_pose : key_poses) {
    for (KeyPose::Target& target : key_pose.targets) target.tolerance_deg += kClearlyDeg;
  }
  return key_poses;
}

bool Shows(const BodyMotion& motion, const Move& asked) {
  return FirstReached(Widened(asked.key_poses), motion, 0, motion.DurationSeconds()).has_value();
}

BodyMotion Changed(const Move& move, const std::function<Controls(const Controls&)>& change) {
  BodyMotion motion;
  const std::size_t frames = move.motion.poses.size();
  for (std::size_t i = 0; i < frames; ++i) {
    const double beat = move.beats * static_cast<double>(i) / static_cast<double>(frames);
    motion.poses.push_back(PoseOf(change(move.curves.At(beat))));
  }
  return motion;
}

}  // namespace

std::string_view FaultName(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kHalfAmplitude:
      return "half_amplitude";
    case Fault::kWrongSide:
      return "wrong_side";
    case Fault::kWrongMove:
      return "wrong_move";
    case Fault::kSkipped:
      return "skipped";
  }
  return "";
}

std::vector<Fault> ShowableFaults(const Move& asked, std::span<const Move> moves) {
  std::vector<Fault> faults;
  const Controls ready = ReadyStance();
  const auto mirrored = [](const Controls& controls) { return Mirrored(controls); };
  const auto halved = [&](const Controls& controls) { return Exaggerated(controls, ready, kHalfAmplitude); };
  if (!Shows(Changed(asked, halved), asked)) faults.push_back(Fault::kHalfAmplitude);
  if (!Shows(Changed(asked, mirrored), asked)) faults.push_back(Fault::kWrongSide);
  if (!WrongMoves(asked, moves).empty()) faults.push_back(Fault::kWrongMove);
  faults.push_back(Fault::kSkipped);
  return faults;
}

std::vector<std::string> WrongMoves(const Move& asked, std::span<const Move> moves) {
  std::vector<std::string> names;
  for (const Move& move : moves) {
    if (move.name != asked.name && !Shows(move.motion, asked)) names.push_back(move.name);
  }
  return names;
}

}  // namespace etude

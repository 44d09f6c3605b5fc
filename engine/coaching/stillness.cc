#include "engine/coaching/stillness.h"

namespace etude {
namespace {

/// A body at rest wanders by millimetres, a guessed limb by decimetres: what counts is the mean over the joints that
/// are seen. Ours.
constexpr double kMovingMetres = 0.025;
/// Per frame towards where the joint is now: a time constant of half a second.
constexpr double kFollowing = 1.0 / 15;

}  // namespace

bool SeeMotion(const SensedFrame& frame, StillnessState& state) {
  ++state.frames;
  if (!frame.body_seen) {
    state.started = false;
    return false;
  }
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const SensedJoint& joint = frame.joints[i];
    if (!state.started) state.rest[i] = joint.position;
    if (joint.state != TrackingState::kTracked) continue;
    const glm::dvec3 off = joint.position - state.rest[i];
    sum += glm::length(off);
    ++count;
    state.rest[i] += kFollowing * off;
  }
  state.started = true;
  ++state.seen;
  const bool moves = count > 0 && sum > kMovingMetres * count;
  if (moves) ++state.moving;
  return moves;
}

void CountAnew(StillnessState& state) { state.seen = state.moving = state.frames = 0; }

}  // namespace etude

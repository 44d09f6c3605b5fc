#include "engine/coaching/senses.h"

#include <glm/glm.hpp>

namespace etude {
namespace {

/// Distances of the hand tips, metres. Ours: a Kinect's hands are some 5 cm off while they move, and palms are thick.
constexpr double kTogether = 0.15, kApart = 0.4;
constexpr int kTogetherFrames = 2, kSwingFrames = 15;

}  // namespace

bool SeeClap(const SensedFrame& frame, ClapState& state) {
  using enum Role;
  const auto is_seen = [&](Role role) { return frame[role].state == TrackingState::kTracked; };
  if (!frame.body_seen || !is_seen(kLeftHand) || !is_seen(kRightHand)) {
    state = {};
    return false;
  }
  const glm::dvec3 left = frame[kLeftHand].position, right = frame[kRightHand].position;
  const double gap = glm::distance(left, right);
  if (gap > kApart) {
    state = {.since_apart = 0, .together = 0};
    return false;
  }
  if (state.since_apart < ClapState::kLongAgo) ++state.since_apart;
  const double hips = frame[kHipCentre].position.y;
  state.together = gap < kTogether && left.y > hips && right.y > hips ? state.together + 1 : 0;
  return state.together == kTogetherFrames && state.since_apart <= kSwingFrames;
}

namespace {

/// A body at rest wanders by millimetres, a guessed limb by decimetres: what counts is the mean over the joints that
/// are seen. Ours.
constexpr double kMovingMetres = 0.025;
/// The share of the way to where the joint is now, per frame: a time constant of half a second.
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

void ResetCounts(StillnessState& state) { state.seen = state.moving = state.frames = 0; }

}  // namespace etude

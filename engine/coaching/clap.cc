#include "engine/coaching/clap.h"

#include <glm/glm.hpp>

namespace etude {
namespace {

/// Of the hand tips. Ours: a Kinect's hands are some 5 cm off while they move, and palms are thick.
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

}  // namespace etude

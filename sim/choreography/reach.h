#pragma once

#include <optional>
#include <span>

#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

/// Whether the frame shows the key pose: every target's feature (engine/fuzzy) within its tolerance.
bool ShowsKeyPose(const KeyPose& key_pose, const BodyPose& pose, double standing_hip_height);

/// The first time, seconds from the motion's first frame, by which every key pose has been shown in
/// frames of [from_s, to_s], in whatever order; nothing when one of them never is. This is the truth
/// that recognisers are judged by.
std::optional<double> FirstReached(std::span<const KeyPose> key_poses, const BodyMotion& motion, double from_s,
                                   double to_s);

}  // namespace etude

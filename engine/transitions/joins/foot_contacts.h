#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// When a foot stands. Two thresholds each, so that a foot near one of them does not flicker. Heights are of the toe
/// tips above the floor (y = 0), metres; speeds are theirs, metres per second. Ours.
struct ContactRules {
  double plant_height = 0.04, plant_speed = 0.25;  ///< it stands from the frame on where it is below both
  double lift_height = 0.06, lift_speed = 0.45;    ///< until it is above one of these
};

/// By side (Side's order), frame by frame: whether that foot stands. Speeds are from a frame to the next, the last
/// frame's to the one before it.
using FootContacts = std::array<std::vector<bool>, 2>;
FootContacts FindFootContacts(std::span<const BodyPose> poses, double rate_hz, const ContactRules& rules = {});

/// The joints of a leg, from the hip down.
struct LegRoles {
  Role hip, knee, ankle, foot;
};
/// By side.
constexpr std::array<LegRoles, 2> kLegs = {
    LegRoles{Role::kLeftHip, Role::kLeftKnee, Role::kLeftAnkle, Role::kLeftFoot},
    LegRoles{Role::kRightHip, Role::kRightKnee, Role::kRightAnkle, Role::kRightFoot}};

}  // namespace etude

#pragma once

#include <array>
#include <span>

#include "engine/motion/body.h"

namespace etude {

/// A limb of the canonical body.
struct Limb {
  std::array<Role, 3> roles;  ///< from the trunk outwards
  Role tip;
  Side side;
  bool is_arm;
};

inline constexpr std::array<Limb, 4> kLimbs = {{
    {{Role::kLeftShoulder, Role::kLeftElbow, Role::kLeftWrist}, Role::kLeftHand, Side::kLeft, true},
    {{Role::kRightShoulder, Role::kRightElbow, Role::kRightWrist}, Role::kRightHand, Side::kRight, true},
    {{Role::kLeftHip, Role::kLeftKnee, Role::kLeftAnkle}, Role::kLeftFoot, Side::kLeft, false},
    {{Role::kRightHip, Role::kRightKnee, Role::kRightAnkle}, Role::kRightFoot, Side::kRight, false},
}};
inline constexpr std::span<const Limb, 2> kLegs = std::span(kLimbs).last<2>();

}  // namespace etude

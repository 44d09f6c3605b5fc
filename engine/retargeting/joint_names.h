#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The names that one naming scheme gives to the three joints of a limb, without the side.
struct LimbNames {
  std::array<std::string_view, 3> joints;  ///< from the trunk outwards
};

/// Arms: shoulder, elbow, wrist. A scheme counts only when it names all three, since one word means
/// different joints in different schemes: MotionBuilder's "LeftShoulder" is the collar bone.
std::span<const LimbNames> ArmSchemes();
/// Legs: hip, knee, ankle.
std::span<const LimbNames> LegSchemes();
/// The base of the neck, most specific name first.
std::span<const std::string_view> NeckNames();
std::span<const std::string_view> HeadNames();

/// The joint of that name, or −1. Compared without case, blanks and signs, and without what stands in
/// front of a colon or of the first underscore: "mixamorig:LeftArm" and "Character1_LeftArm" are
/// "leftarm". End sites are not looked at.
int FindJoint(const Skeleton& skeleton, std::string_view name);
/// The same with a side, written "LeftArm", "L_Arm" or "Arm_L".
int FindJoint(const Skeleton& skeleton, std::string_view name, Side side);

}  // namespace etude

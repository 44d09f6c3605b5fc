#pragma once

#include <string>
#include <string_view>

#include "engine/motion/clip.h"

namespace etude {

/// A joint's name with its first word for a side changed: "LeftArm" ↔ "RightArm", "upperarm.l" ↔ "upperarm.r",
/// "L_Elbow", "lShldr", "Bip01 L Thigh", "mixamorig:LeftArm". Words end at signs, blanks and where capitals begin; what
/// stands in front of a colon is not looked at. Other names come back as they are: "Collar", "lowerback", "L5".
std::string OtherSide(std::string_view name);

/// Every joint under its OtherSide. A side glued to the name ("lfemur", "leftarm", "L5") is one only when the skeleton
/// has the other name too: else it is a word that begins alike, or a vertebra. Twice is the skeleton itself.
Skeleton WithSidesSwapped(Skeleton skeleton);

}  // namespace etude

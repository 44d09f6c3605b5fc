#pragma once

#include <array>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The joint that plays a role or is proposed for this role, and the reason for the choice.
struct RoleOnSheet {
  enum class By { kNobody, kName, kComposed, kAnatomy, kProposed };
  int joint = -1;
  By by = By::kNobody;
};

/// Draws the skeleton of a clip in its first frame (at rest if the clip has no frames). Every joint has its name and,
/// in another colour, the role that it plays; roles without a joint are listed below. The view is from the front if
/// both shoulders or both hips are known, else along the skeleton's thinnest axis. Returns the bytes of a PNG file.
/// Fails if all joints of the skeleton coincide, or if it has so many joints that the sheet would exceed kMaxSheetSide.
Result<std::string> DrawRoleSheet(const Clip& clip, const std::array<RoleOnSheet, kRoleCount>& roles);

}  // namespace etude

#pragma once

#include <array>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The joint of a skeleton that plays a role, or may.
struct RoleOnSheet {
  enum class By { kNobody, kName, kComposed, kAnatomy, kProposed };
  int joint = -1;
  By by = By::kNobody;
};

/// Draws the skeleton of a clip as its first frame has it (at rest where it has none), every joint with its name and,
/// in another colour, the role that it plays; roles that nobody plays are listed below. It is seen from the front where
/// both shoulders or hips are known, else along the file's thinnest axis. Gives the bytes of a PNG file. Refused: a
/// skeleton of no size, one of so many joints that the sheet would be larger than kLargestSheet.
Result<std::string> DrawRoleSheet(const Clip& clip, const std::array<RoleOnSheet, kRoleCount>& roles);

}  // namespace etude

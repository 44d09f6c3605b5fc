#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "engine/retargeting/joint_names.h"
#include "engine/retargeting/skeleton_tree.h"

namespace etude {

/// What the names say about a limb: from the trunk outwards, −1 where a joint is missing.
struct FoundLimb {
  std::array<int, 3> joints{-1, -1, -1};
  std::string prefix;                 ///< common to the joints' names
  const LimbNames* scheme = nullptr;  ///< that names the most joints; null when none names any
};

/// Finds a limb by the first scheme that names three joints, under one prefix, which hang from each other. Control rigs
/// keep feet apart from the legs: if need be, the third may hang from neither of the others. When no scheme does,
/// gives the joints of the scheme that names the most. Joints of `taught` that are not −1 are taken as they are.
FoundLimb FindLimb(const JointNames& names, const SkeletonTree& tree, std::span<const LimbNames> schemes, Side side,
                   const std::array<int, 3>& taught);

}  // namespace etude

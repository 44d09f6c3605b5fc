#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/retargeting/limb_finder.h"

namespace etude {

/// The limbs that a skeleton's build proposes, whatever its joints are called.
struct AnatomyProposal {
  /// Shoulders, elbows, wrists, hips, knees and ankles, by Index(role); −1 of all others, and of all where no two pairs
  /// of limbs were found.
  std::array<int, kRoleCount> joints;
  double confidence = 0;  ///< 0 to 1
};

/// A proposal may be used unasked from this confidence on.
constexpr double kSureAnatomy = 0.9;

/// Proposes the limbs by the shape of the tree and the rest pose (ours). Legs and arms are two pairs of brothers with
/// equally long chains of bones below them; the trunk leads from the legs to the arms, and legs lead the other way. In
/// each chain the three joints are those whose bones have the proportions of people's. Left is where up × forward
/// points, forward where the toes do; without toes the sides are as in a body that faces +Z, at little confidence.
/// The confidence is the product of how well each of these is met: 1 within the range of adults, falling off beyond.
AnatomyProposal ProposeByAnatomy(const SkeletonTree& tree);

}  // namespace etude

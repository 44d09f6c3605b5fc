#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "engine/motion/body.h"
#include "engine/motion/tree_motion.h"

namespace etude {

/// A window of a motion, of which some frames are hidden.
struct HiddenWindow {
  TreeMotion motion;
  int first = 0, last = 0;  ///< the hidden frames, both inclusive; three or more frames are on either side
  std::array<int, kRoleCount> roles = RawMotion::NoRoles();  ///< the joint of each role; −1: none
  double floor_m = 0;                                        ///< FloorOf the whole file
  std::vector<glm::dvec3> deviations;  ///< of each joint in training, metres, by which L2P divides; empty: unknown
};

/// Returns the ids of all metrics, in the order in which they are measured.
std::vector<std::string> InbetweenMetrics();

/// Returns the height of the floor, metres: the 5th percentile, over the frames, of the lowest joint's height. Joints
/// with the role of a hand do not count.
double FloorOf(const HiddenWindow& whole);

/// Measures a window whose hidden frames are replaced by `filled`, one for each. With `keeps_motion`, the result's
/// recording holds this window and the true one.
CellResult ScoreFilling(const HiddenWindow& hidden, std::span<const TreePose> filled, bool keeps_motion);

}  // namespace etude

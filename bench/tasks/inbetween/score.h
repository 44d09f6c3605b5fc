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
  int first = 0, last = 0;  ///< the hidden frames; three or more stand at either side
  std::array<int, kRoleCount> roles = RawMotion::NoRoles();
  double floor_m = 0;
  std::vector<glm::dvec3> deviations;  ///< of each joint, by which L2P is divided; empty: unknown
};

/// Returns the ids of all metrics, in the order in which they are measured.
std::vector<std::string> InbetweenMetrics();

/// Returns the height at which the lowest joint of a body rests: the 5th percentile over the frames, finger tips left
/// out.
double FloorOf(const HiddenWindow& whole);

/// Measures the frames in the place of the hidden ones, as many as those. A recording holds both windows.
CellResult ScoreFilling(const HiddenWindow& hidden, std::span<const TreePose> filled, bool keeps_motion);

}  // namespace etude

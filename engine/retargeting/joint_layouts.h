#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// The order of the joints in an array.
struct JointLayout {
  std::string_view name;
  std::vector<std::string_view> joints;  ///< joint names; FindMarkerBodies ignores those that no marker set contains
};

/// Lists the known layouts.
const std::vector<JointLayout>& JointLayouts();

/// Returns the names of the layouts, listed here with their numbers of joints: "etude" (20), "smpl" (22 or 24), "h36m"
/// (17), "coco" (17), "body_25", "halpe_26", "mhr70" and "mhr" (127).
std::vector<std::string> JointLayoutNames();

/// Returns the names of a layout's joints in its order; a joint that plays a role has the role's name. `joints` selects
/// among layouts of the same name. Returns an empty list if there is no such layout.
std::vector<std::string> JointsOfLayout(std::string_view layout, std::size_t joints);

}  // namespace etude

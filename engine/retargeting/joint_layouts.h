#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// The order of the joints in an array.
struct JointLayout {
  std::string_view name;
  std::vector<std::string_view> joints;  ///< joint names; FindMarkerBodies ignores those that no marker set contains
  bool is_usual = true;  ///< false: another layout has as many joints, and is taken if the user names none
};

/// Lists the known layouts.
const std::vector<JointLayout>& JointLayouts();

/// Returns the names of the layouts, listed here with their numbers of joints: "etude" (20), "smpl" (22 or 24), "h36m"
/// (17), "coco" (17), "body_25", "halpe_26", "mhr70", "mhr" (127), "kinect_v2" (25), "lafan1" (22), "smpl_humanoid"
/// (24) and "smplx" (24: without fingers, with jaw and left eye).
std::vector<std::string> JointLayoutNames();

/// Returns the names of a layout's joints in its order; a joint that plays a role has the role's name. `joints` selects
/// among layouts of the same name. Returns an empty list if there is no such layout.
std::vector<std::string> JointsOfLayout(std::string_view layout, std::size_t joints);

/// Returns the layout of as many joints that fits positions (frames × joints; NaN: not seen) far better than `used`, if
/// `used` does not fit; otherwise null. In a layout that fits, left and right limbs have about the same median length,
/// and so have the two parts of a limb. A layout does not fit if such lengths differ by a factor of 1.65 or more, which
/// noise and the errors of detectors hardly cause.
const JointLayout* FindBetterLayout(std::span<const glm::dvec3> positions, const JointLayout& used);

}  // namespace etude

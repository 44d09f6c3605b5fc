#include "engine/formats/joint_csv.h"

#include <fmt/format.h>

#include <iterator>

namespace etude {

std::string WriteJointCsv(const BodyMotion& motion) {
  std::string text = "frame,time_s";
  const auto out = std::back_inserter(text);
  for (const Role role : AllRoles()) {
    for (const char axis : {'x', 'y', 'z'}) fmt::format_to(out, ",{}_{}_m", RoleName(role), axis);
  }
  text += '\n';
  for (std::size_t k = 0; k < motion.poses.size(); ++k) {
    fmt::format_to(out, "{},{}", k, static_cast<double>(k) / motion.rate_hz);
    for (const glm::dvec3& joint : motion.poses[k].joints) fmt::format_to(out, ",{},{},{}", joint.x, joint.y, joint.z);
    text += '\n';
  }
  return text;
}

}  // namespace etude

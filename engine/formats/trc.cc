#include "engine/formats/trc.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace etude {

std::string WriteTrc(const BodyMotion& motion, std::string name) {
  // It stands in a table of lines and tabs.
  std::ranges::replace_if(
      name, [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '_');
  constexpr double kMillimetres = 1000;
  const std::size_t frames = motion.poses.size();
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "PathFileType\t4\t(X/Y/Z)\t{}.trc\n", name);
  fmt::format_to(out,
                 "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
                 "OrigNumFrames\n");
  fmt::format_to(out, "{0}\t{0}\t{1}\t{2}\tmm\t{0}\t1\t{1}\n", motion.rate_hz, frames, kRoleCount);
  // A marker's name stands over the first of its three columns.
  text += "Frame#\tTime";
  for (const Role role : AllRoles()) fmt::format_to(out, "\t{}\t\t", RoleName(role));
  text += "\n\t";
  for (std::size_t i = 1; i <= kRoleCount; ++i) fmt::format_to(out, "\tX{0}\tY{0}\tZ{0}", i);
  text += "\n\n";
  for (std::size_t k = 0; k < frames; ++k) {
    fmt::format_to(out, "{}\t{:.6f}", k + 1, static_cast<double>(k) / motion.rate_hz);
    for (const glm::dvec3& joint : motion.poses[k].joints) {
      for (int axis = 0; axis < 3; ++axis) fmt::format_to(out, "\t{:.5f}", kMillimetres * joint[axis]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace etude

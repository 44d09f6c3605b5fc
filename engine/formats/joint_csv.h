#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

/// Writes a motion as comma-separated values with one line of headings: `frame` (from 0), `time_s`, then
/// `hip_centre_x_m`, `hip_centre_y_m`, … of every role. Metres, Y up, every digit kept.
std::string WriteJointCsv(const BodyMotion& motion);

/// What such a file holds: its own joints may be fewer, and a joint may be missing in some frames.
struct JointCsv {
  std::optional<double> rate_hz;  ///< by the middle step of `time_s`, where that is there and grows
  std::vector<double> times_s;    ///< of each frame; NaN where the file does not tell it
  std::vector<int> lines;         ///< where each frame stands in the text, from 1
  std::vector<std::array<std::optional<glm::dvec3>, kRoleCount>> frames;
};
/// Reads what `WriteJointCsv` wrote, or any file with some of its columns, in any order. Refused, with the line: what
/// `ReadNumberRows` refuses, unknown headings, a joint without all three coordinates.
Result<JointCsv> ReadJointCsv(std::string_view text, const std::string& file);

}  // namespace etude

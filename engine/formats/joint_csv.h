#pragma once

#include <array>
#include <cstddef>
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

/// The columns of such a file, as its headings name them.
struct JointCsvColumns {
  std::size_t count = 0;
  std::optional<std::size_t> time = {};
  std::array<std::array<std::optional<std::size_t>, 3>, kRoleCount> joints = {};  ///< x, y, z; none: not in the file
};

/// The contents of such a file: it may have fewer joints, and a joint may be missing in some frames.
struct JointCsv {
  JointCsvColumns columns;
  std::optional<double> rate_hz;  ///< by the middle step of `time_s`, where that is there and grows
  std::vector<double> times_s;    ///< of each frame; NaN where the file does not tell it
  std::vector<int> lines;         ///< where each frame stands in the text, from 1
  std::vector<std::array<std::optional<glm::dvec3>, kRoleCount>> frames;
};
/// Reads what `WriteJointCsv` wrote, or any file with some of its columns, in any order. Refused, with the line: what
/// `ReadNumberRows` refuses, unknown headings, a joint without all three coordinates.
Result<JointCsv> ReadJointCsv(std::string_view text, const std::string& file);

/// One row of such a file.
struct JointCsvRow {
  double time_s = 0;  ///< NaN where the row does not tell it
  std::array<std::optional<glm::dvec3>, kRoleCount> places = {};
};
/// Reads one more row of a file whose columns are known. Refused: what `ReadNumberRows` refuses, another number of
/// values than of columns.
Result<JointCsvRow> ReadJointCsvRow(std::string_view row, const JointCsvColumns& columns, const std::string& file);

}  // namespace etude

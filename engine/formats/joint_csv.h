#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/time_scale.h"
#include "engine/motion/body.h"

namespace etude {

/// Writes a motion as comma-separated values below one line of headings: `frame` (from 0), `time_s`, then
/// `hip_centre_x_m`, `hip_centre_y_m`, … for every role. Values are in metres, Y up, with all digits. Times count from
/// `start_s`.
std::string WriteJointCsv(const BodyMotion& motion, double start_s = 0);

/// Returns true if the first line of headings names joints as WriteJointCsv does, perhaps with typing errors, which
/// ReadJointCsv reports, and no other points.
bool IsJointCsv(std::string_view text);

/// The columns of a joint CSV file, found by their headings.
struct JointCsvColumns {
  std::string heading;  ///< the line of headings, which also determines the separator of values
  std::size_t count = 0;
  std::optional<std::size_t> time = {}, number = {};
  bool counts_minutes = false;  ///< true if the heading of the column of times names minutes
  /// The columns of x, y and z for each joint; nullopt if the file lacks the joint.
  std::array<std::array<std::optional<std::size_t>, 3>, kRoleCount> joints = {};
  std::vector<std::size_t> texts = {};  ///< the columns of text, which are left out
};

/// The contents of a joint CSV file. It may lack joints, and a joint may be missing in some frames.
struct JointCsv {
  JointCsvColumns columns;
  std::optional<double> rate_hz;  ///< rate from the median of the positive time steps; nullopt if no step is positive
  TimeScale scale;                ///< unit and origin of the column `time_s`
  std::vector<double> times_s;    ///< time of each frame, in seconds, converted by `scale`; NaN if unknown
  std::vector<double> numbers;    ///< value of each frame in the column `frame`; empty if the file lacks this column
  std::vector<int> lines;         ///< line of each frame in the text, from 1
  std::vector<std::array<std::optional<glm::dvec3>, kRoleCount>> frames;
  std::string remark;  ///< message for the user about assumptions and ignored columns
};
/// Reads a file of `WriteJointCsv`, or any file with some of its columns in any order. Columns of text with other
/// headings are left out. Returns an error with the line for anything that `ReadNumberRows` refuses, columns of numbers
/// with unknown headings, a joint without all three coordinates, positions beyond ±10⁹, decreasing times, and more than
/// a million rows.
Result<JointCsv> ReadJointCsv(std::string_view text, const std::string& file);

/// One row of a joint CSV file.
struct JointCsvRow {
  double time_s = 0;  ///< time in the file's own unit and origin; NaN if unknown
  std::array<std::optional<glm::dvec3>, kRoleCount> places = {};
};
/// Reads one more row of a file with known columns. Returns an error for anything that `ReadJointCsv` refuses in a row.
Result<JointCsvRow> ReadJointCsvRow(std::string_view row, const JointCsvColumns& columns, const std::string& file);

}  // namespace etude

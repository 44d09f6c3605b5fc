#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

/// Writes a motion as a TRC file (Track Row Column, Motion Analysis), which OpenSim and others read as marker
/// trajectories: one marker per role, millimetres, Y up, five decimals. Frames count from 1, times from 0 s. `name` is
/// written to the file's first line, with '_' for tabs and line ends.
std::string WriteTrc(const BodyMotion& motion, std::string name);

/// Trajectories of any markers.
struct MarkerMotion {
  double rate_hz = 30;
  std::vector<std::string> names;
  /// The markers' positions in each frame, in metres; nullopt if a marker was not seen.
  std::vector<std::vector<std::optional<glm::dvec3>>> frames;
  std::string remark = "";                     ///< a message for the user about the file
  double metres_per_unit = 1;                  ///< metres per unit of the file; the positions here are in metres
  std::map<std::string, double> sizes_m = {};  ///< body sizes by the file's names ("LKNEEWIDTH"), metres
  std::optional<double> start_s = {};          ///< the first frame's time by the file's own clock, if it states one
};

/// Returns a body's joints as markers, one per role; `start_s` is the first frame's time.
MarkerMotion JointMarkers(const BodyMotion& motion, double start_s);

/// Writes markers as a TRC file whose times begin at `start_s`. The cells of a marker that was not seen are empty, as
/// OpenSim expects.
std::string WriteTrc(const MarkerMotion& motion, std::string name);

struct MarkerRows;

/// Reads a TRC file in m, cm, mm, in or ft (`Units`), without changing its axes. A marker counts as not seen if a cell
/// is empty, "nan" or beyond ±10⁶ m. The rows are placed on frames (`LayOnClock`) by the times in the column Time or,
/// if it is empty, by the numbers in Frame#, as in OpenSim; the remark says what was changed. Returns an error with the
/// line if there is no header, the number of frames or columns is wrong, a marker's axes are not in the order X, Y, Z,
/// a cell is not a number, or there are more than 1,000 markers, 64 MiB of text or 1 GB of frames; also returns the
/// errors of GridOfRows.
Result<MarkerMotion> ReadTrc(std::string_view text, const std::string& file);
/// Reads a TRC file like ReadTrc, but keeps the rows as they are in the file, without placing them on frames.
Result<MarkerRows> ReadTrcRows(std::string_view text, const std::string& file);

}  // namespace etude

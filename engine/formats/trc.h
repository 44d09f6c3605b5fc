#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

/// Writes a motion as a TRC file (Track Row Column, Motion Analysis), which OpenSim and others read as marker
/// trajectories: one marker per role, millimetres, Y up, five decimals; frames count from 1, time from 0 s. `name` is
/// told in the file's first line, with '_' for tabs and line ends.
std::string WriteTrc(const BodyMotion& motion, std::string name);

/// Trajectories of any markers.
struct MarkerMotion {
  double rate_hz = 30;
  std::vector<std::string> names;
  /// The places of markers in each frame, metres; nothing where one was not seen.
  std::vector<std::vector<std::optional<glm::dvec3>>> frames;
  std::string remark = "";  ///< what the reader found to say, in plain words
};

/// Writes such a file of markers; what was not seen stays empty between its tabs, as OpenSim reads it.
std::string WriteTrc(const MarkerMotion& motion, std::string name);

/// Reads a TRC file in metres or millimetres (`Units`; also cm), its axes as they are. An empty place, "nan", or one
/// beyond ±10⁶ m is a marker not seen. Where its column Time runs at another rate than DataRate (by over 5 %, over at
/// least half a second), Time counts, as for OpenSim, and the remark says so. Fails with the line: no header, another
/// number of frames or columns than announced, words for numbers, over 1,000 markers or 64 MiB.
Result<MarkerMotion> ReadTrc(std::string_view text, const std::string& file);

}  // namespace etude

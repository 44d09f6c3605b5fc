#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/dlt.h"

namespace etude {

/// The point pairs that one camera is calibrated with.
struct CameraPairs {
  std::string name;
  int width = 0, height = 0;  ///< of its picture; 0: the file does not tell
  std::vector<PointPair> pairs;
};

/// Reads points measured in the world (metres, Y up) and the pixels that show them (OpenCV's: the centre of the first
/// one at (0, 0)), per camera, from either
/// - CSV with the heading `camera,x,y,z,u,v`, a line a pair, cameras by name in any order; or
/// - YAML: `left: {size: [1920, 1080], pairs: [[x, y, z, u, v], …]}` for each camera.
/// Fails with line and what is allowed; over 64 cameras or 1 MiB are refused.
Result<std::vector<CameraPairs>> ReadPointPairs(std::string_view text, const std::string& file);

}  // namespace etude

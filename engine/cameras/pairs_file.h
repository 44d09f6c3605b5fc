#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/dlt.h"

namespace etude {

/// The offset of our pixel coordinates from those of the file, which are OpenCV's: the centre of our first pixel is
/// (0.5, 0.5).
inline constexpr double kFromOpenCv = 0.5;

/// The point pairs for calibrating one camera.
struct CameraPairs {
  std::string name;
  int width = 0, height = 0;  ///< size of the camera's picture, pixels; 0 if the file does not state it
  std::vector<PointPair> pairs;
};

/// Reads point pairs for each camera: a point measured in the world (x, y, z; metres, Y up) and its pixel (u, v; in the
/// file, the centre of the first pixel is at (0, 0), as in OpenCV). The file is either
/// - CSV with the heading `camera,x,y,z,u,v` and one pair per line, which begins with the camera's name; or
/// - YAML: `left: {size: [1920, 1080], pairs: [[x, y, z, u, v], …]}` for each camera.
/// Fails, naming the line and what is allowed; refuses more than 64 cameras or 1 MiB.
Result<std::vector<CameraPairs>> ReadPointPairs(std::string_view text, const std::string& file);

}  // namespace etude

#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/drawing/sensor_sheet.h"
#include "sim/render/renderer.h"
#include "tools/clips/clip_film.h"

namespace etude {

struct SheetOptions {
  Viewpoint from = Viewpoint::kThreeQuarter;
  int width = 200;  ///< of one picture, pixels
  int height = 260;
  int frames = 12;   ///< pictures of each clip
  int columns = 12;  ///< pictures beside each other
};

/// The largest side of a sheet, pixels; larger sheets are refused.
constexpr int kLargestSheet = 16'000;

/// Draws clips below each other, each as pictures evenly spread over its time, all at one scale. Gives the bytes of a
/// PNG file.
Result<std::string> DrawContactSheet(std::vector<ClipActor> actors, const SheetOptions& options, Renderer& renderer);

/// Draws what sensors see, row below row, all pictures at one width. Gives the bytes of a PNG file. Fails for a sheet
/// that is too large or has nothing to show.
Result<std::string> DrawSensorSheet(const SensorSheet& sheet);

}  // namespace etude

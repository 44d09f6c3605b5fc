#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "sim/render/renderer.h"
#include "tools/clips/clip_film.h"

namespace etude {

struct SheetOptions {
  Viewpoint from = Viewpoint::kThreeQuarter;
  int width = 200;  ///< width of each picture, pixels
  int height = 260;
  int frames = 12;   ///< number of pictures of each clip
  int columns = 12;  ///< maximum number of pictures in a row
};

/// The maximum width and height of a sheet, pixels; a larger sheet is refused.
constexpr int kMaxSheetSide = 16'000;

/// Draws each clip as a block of pictures, evenly spread over the clip's time. The blocks are placed one below the
/// other, all at one scale. Returns the bytes of a PNG file. Fails if the sheet is too large.
Result<std::string> DrawContactSheet(std::vector<ClipActor> actors, const SheetOptions& options, Renderer& renderer);

}  // namespace etude

#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// A line that is drawn over a picture, in its pixels; a dot if both ends are equal.
struct SheetMark {
  glm::dvec2 a{0}, b{0};
  Rgb8 colour;
};

struct SheetPicture {
  std::string caption;
  ColourImage picture;
  std::vector<SheetMark> marks;
};

/// Pictures in one row, with a title.
struct SheetRow {
  std::string title;
  std::vector<SheetPicture> pictures;
};

/// The pictures of all sensors of a world, for visual inspection.
struct SensorSheet {
  std::string title;
  std::vector<SheetRow> rows;
};

}  // namespace etude

#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// A line drawn over a picture, in its pixels; a dot where both ends are one.
struct SheetMark {
  glm::dvec2 a{0}, b{0};
  Rgb8 colour;
};

struct SheetPicture {
  std::string caption;
  ColourImage picture;
  std::vector<SheetMark> marks;
};

/// Pictures beside each other, and what they show.
struct SheetRow {
  std::string title;
  std::vector<SheetPicture> pictures;
};

/// The pictures of all sensors of a world, for people to look at.
struct SensorSheet {
  std::string title;
  std::vector<SheetRow> rows;
};

}  // namespace etude

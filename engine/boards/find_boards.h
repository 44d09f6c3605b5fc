#pragma once

#include <span>
#include <vector>

#include "engine/base/image.h"
#include "engine/boards/board.h"

namespace etude {

/// A corner of a board in a picture.
struct SeenCorner {
  std::size_t board = 0;
  BoardCorner corner;
  glm::dvec2 pixel{0};
};

/// Finds the corners of `boards` in a picture, sorted by board and then by rows. A corner is identified only if at
/// least three codes around it agree about the board; one module of a code may be misread. Codes need squares of about
/// 24 pixels or more (4 per module) at less than about 60° from the front. The boards must not share codes.
std::vector<SeenCorner> FindBoards(const ColourImage& picture, std::span<const Board> boards);

}  // namespace etude

#pragma once

#include <span>
#include <vector>

#include "engine/base/image.h"
#include "engine/boards/board.h"

namespace etude {

/// A corner of a board in a picture.
struct SeenCorner {
  std::size_t board = 0;  ///< which of the boards
  BoardCorner corner;
  glm::dvec2 pixel{0};
};

/// Finds the corners of `boards` that the picture shows, by board and then in rows. A corner is named only where at
/// least three codes agree about the board around it; one module of a code may be misread. Squares of about 24 pixels
/// or more are needed for the codes (4 a module), seen from less than about 60° aside. Boards have no code in common.
std::vector<SeenCorner> FindBoards(const ColourImage& picture, std::span<const Board> boards);

}  // namespace etude

#pragma once

#include <span>
#include <vector>

#include "engine/boards/board.h"
#include "engine/boards/find_boards.h"
#include "engine/cameras/dlt.h"
#include "sim/render/scene.h"

namespace etude {

/// The pose of a board in the world W: the board's top left corner and axes, as seen from the board's front.
struct PlacedBoard {
  Board board;
  glm::dvec3 p_WO{0};           ///< the top left corner
  glm::dvec3 right_W{1, 0, 0};  ///< unit vector
  glm::dvec3 down_W{0, -1, 0};  ///< unit vector, perpendicular to `right_W`

  glm::dvec3 At(const glm::dvec2& point) const { return p_WO + point.x * right_W + point.y * down_W; }
};

/// Returns the boards on a cube of 1.2 m that stands on a stand: one on each of the four sides and one on the top.
/// Every camera around the cube sees at least two faces, that is "different planes" (paper B, section 2.2). No code
/// appears on two boards.
std::vector<PlacedBoard> CalibrationTarget(const glm::dvec3& middle);

/// Returns these boards as surfaces for the renderer.
std::vector<Surface> SurfacesOf(std::span<const PlacedBoard> boards);

/// Returns the pixel and the position in the world of each seen corner.
std::vector<PointPair> PairsOf(std::span<const PlacedBoard> boards, std::span<const SeenCorner> seen);

}  // namespace etude

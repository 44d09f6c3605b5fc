#pragma once

#include <span>
#include <vector>

#include "engine/boards/board.h"
#include "engine/boards/find_boards.h"
#include "engine/cameras/dlt.h"
#include "sim/render/scene.h"

namespace etude {

/// A board in the world W: its top left corner and its axes, as one sees it from its front.
struct PlacedBoard {
  Board board;
  glm::dvec3 p_WO{0};           ///< the top left corner
  glm::dvec3 right_W{1, 0, 0};  ///< unit
  glm::dvec3 down_W{0, -1, 0};  ///< unit, at a right angle to `right_W`

  glm::dvec3 At(const glm::dvec2& place) const { return p_WO + place.x * right_W + place.y * down_W; }
};

/// Returns the boards of a cube of 1.2 m on a stand, with a board on each of its four sides and on its top: every
/// camera about it sees two sides or more, which are "different planes" (paper B, section 2.2). No two boards share a
/// code.
std::vector<PlacedBoard> CalibrationTarget(const glm::dvec3& middle);

/// Returns the surfaces that the renderer draws of boards.
std::vector<Surface> SurfacesOf(std::span<const PlacedBoard> boards);

/// A dark disc on a bright plane, to be pointed at.
struct PlacedDisc {
  glm::dvec3 middle_W{0};
  glm::dvec3 outwards_W{0};  ///< unit, out of the plane
};

/// That cube with a disc of 5 cm in the middle of every square: paper B's "marks on different planes".
struct MarkedCube {
  std::vector<PlacedDisc> discs;
  std::vector<Surface> surfaces;  ///< what the renderer draws of them and of the planes
};
MarkedCube MakeMarkedCube(const glm::dvec3& middle);

/// Returns the corners that were seen, each with its place in the world.
std::vector<PointPair> PairsOf(std::span<const PlacedBoard> boards, std::span<const SeenCorner> seen);

}  // namespace etude

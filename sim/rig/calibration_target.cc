#include "sim/rig/calibration_target.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kCube = 1.2;   // side, metres
constexpr double kStand = 0.3;  // height, metres
constexpr int kSquares = 5;     // squares along a board's side

constexpr Rgb8 kBlack{25, 25, 25};
constexpr Rgb8 kWhite{225, 225, 225};

void AddRectangle(const PlacedBoard& placed, const glm::dvec2& low, const glm::dvec2& high, Surface& surface) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  const glm::dvec3 normal = glm::cross(placed.down_W, placed.right_W);
  for (const glm::dvec2& point : {low, glm::dvec2(low.x, high.y), high, glm::dvec2(high.x, low.y)}) {
    surface.positions.push_back(placed.At(point));
    surface.normals.push_back(normal);
  }
  for (const std::uint32_t second : {1u, 2u}) {
    surface.triangles.push_back({first, first + second, first + second + 1});
    surface.parts.push_back(Part::kBackground);
  }
}

void AddDisc(const PlacedDisc& disc, const glm::dvec3& right, const glm::dvec3& down, Surface& surface) {
  constexpr double kRadius = 0.025;  // metres
  constexpr int kCorners = 32;
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * kPi * i / kCorners;
    surface.positions.push_back(disc.middle_W + kRadius * (std::cos(angle) * right + std::sin(angle) * down));
    surface.normals.push_back(disc.outwards_W);
  }
  for (std::uint32_t i = 2; i < kCorners; ++i) {
    surface.triangles.push_back({first, first + i, first + i - 1});  // counter-clockwise: down is clockwise of right
    surface.parts.push_back(Part::kBackground);
  }
}

// Adds a board to two surfaces of one colour each: a black square as one rectangle, a white square module by module.
void AddBoard(const PlacedBoard& placed, Surface& black, Surface& white) {
  const Board& board = placed.board;
  const double module = board.square / kModules;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const glm::dvec2 corner = board.square * glm::dvec2(column, row);
      if (IsBlackSquare(column, row)) {
        AddRectangle(placed, corner, corner + board.square, black);
        continue;
      }
      for (int m = 0; m < kModules * kModules; ++m) {
        const glm::dvec2 low = corner + module * glm::dvec2(m % kModules, m / kModules);
        AddRectangle(placed, low, low + module, IsBlackAt(board, low + 0.5 * module) ? black : white);
      }
    }
  }
}

}  // namespace

std::vector<PlacedBoard> CalibrationTarget(const glm::dvec3& middle) {
  const glm::dvec3 up(0, 1, 0), centre = middle + (kStand + kCube / 2) * up;
  std::vector<PlacedBoard> boards;
  const auto add = [&](const glm::dvec3& outwards, const glm::dvec3& right, const glm::dvec3& down) {
    const Board board{
        .columns = kSquares,
        .rows = kSquares,
        .square = kCube / kSquares,
        .first_code = static_cast<int>(boards.size()) * CountCodes({.columns = kSquares, .rows = kSquares})};
    boards.push_back({board, centre + kCube / 2 * (outwards - right - down), right, down});
  };
  for (const glm::dvec3& side : {glm::dvec3(0, 0, 1), {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}}) {
    add(side, glm::cross(up, side), -up);
  }
  add(up, {1, 0, 0}, {0, 0, 1});
  return boards;
}

std::vector<Surface> SurfacesOf(std::span<const PlacedBoard> boards) {
  std::vector<Surface> surfaces(2);
  surfaces[0].colour = kBlack;
  surfaces[1].colour = kWhite;
  for (const PlacedBoard& placed : boards) AddBoard(placed, surfaces[0], surfaces[1]);
  return surfaces;
}

MarkedCube MakeMarkedCube(const glm::dvec3& middle) {
  constexpr double kThickness =
      0.001;  // metres between a disc and its plane, so that the disc is drawn in front of the plane
  MarkedCube cube;
  cube.surfaces.resize(2);
  Surface &black = cube.surfaces[0], &white = cube.surfaces[1];
  black.colour = kBlack;
  white.colour = kWhite;
  for (const PlacedBoard& placed : CalibrationTarget(middle)) {
    AddRectangle(placed, glm::dvec2(0), glm::dvec2(kCube), white);
    const glm::dvec3 outwards = glm::cross(placed.down_W, placed.right_W);
    for (int square = 0; square < kSquares * kSquares; ++square) {
      const glm::dvec2 point = placed.board.square * glm::dvec2(square % kSquares + 0.5, square / kSquares + 0.5);
      cube.discs.push_back({placed.At(point) + kThickness * outwards, outwards});
      AddDisc(cube.discs.back(), placed.right_W, placed.down_W, black);
    }
  }
  return cube;
}

std::vector<PointPair> PairsOf(std::span<const PlacedBoard> boards, std::span<const SeenCorner> seen) {
  std::vector<PointPair> pairs;
  for (const SeenCorner& corner : seen) {
    const PlacedBoard& placed = boards[corner.board];
    pairs.push_back({placed.At(PlaceOf(placed.board, corner.corner)), corner.pixel});
  }
  return pairs;
}

}  // namespace etude

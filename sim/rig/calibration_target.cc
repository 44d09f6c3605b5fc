#include "sim/rig/calibration_target.h"

namespace etude {
namespace {

constexpr double kCube = 1.2;   // side of the cube, metres
constexpr double kStand = 0.3;  // height of the stand, metres
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

// Adds a board as rectangles of one colour: a black square is one rectangle, a white square is one rectangle per
// module.
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

std::vector<PointPair> PairsOf(std::span<const PlacedBoard> boards, std::span<const SeenCorner> seen) {
  std::vector<PointPair> pairs;
  for (const SeenCorner& corner : seen) {
    const PlacedBoard& placed = boards[corner.board];
    pairs.push_back({placed.At(PlaceOf(placed.board, corner.corner)), corner.pixel});
  }
  return pairs;
}

}  // namespace etude

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace etude {

/// A flat calibration board: a chessboard whose top left square is black. Each white square carries a unique code, so a
/// picture of any part of the board identifies this part (like OpenCV's ChArUco boards; codes and detection are ours).
/// Codes are numbered row by row through the white squares, from `first_code`.
struct Board {
  int columns = 8;  ///< number of squares; at most kMaxSquares per side
  int rows = 8;
  double square = 0.2;  ///< side of a square, metres
  int first_code = 0;   ///< number of the first code; boards that are seen together must have different codes
};

constexpr int kMaxSquares = 16;
/// A code consists of kCodeSide × kCodeSide modules, black (1) or white (0), in a margin of one white module.
constexpr int kCodeSide = 4;
constexpr int kModules = kCodeSide + 2;
/// The number of codes. Two codes differ in at least kCodeDistance modules, however each code is rotated. A code
/// differs in at least as many modules from each of its own rotations by quarter turns.
constexpr int kCodeCount = 120;
constexpr int kCodeDistance = 4;

/// Returns the modules of code `number` (0 ≤ `number` < kCodeCount), row by row from the top. The first module is the
/// highest bit.
std::uint16_t CodeOf(int number);
/// Returns the code rotated by 90° clockwise.
std::uint16_t Turned(std::uint16_t code);

/// Returns the number of codes on the board.
int CountCodes(const Board& board);
constexpr bool IsBlackSquare(int column, int row) { return (column + row) % 2 == 0; }
/// Returns the `number` (as in CodeOf) of the code on a white square.
int CodeNumberOf(const Board& board, int column, int row);

/// Returns true if the board is black at a point of its plane, metres from its top left corner, x to the right, y down.
bool IsBlackAt(const Board& board, const glm::dvec2& point);

/// An inner corner: the lower right corner of the square (column, row); 0 ≤ column < columns − 1, likewise for rows.
struct BoardCorner {
  int column = 0;
  int row = 0;
};
/// Returns the position of a corner in the plane of the board, metres from the top left corner.
inline glm::dvec2 PlaceOf(const Board& board, const BoardCorner& corner) {
  return board.square * glm::dvec2(corner.column + 1, corner.row + 1);
}

}  // namespace etude

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace etude {

/// A flat calibration board: black and white squares in turn, the one at the top left black, and in every white square
/// a code of its own, so that a picture of any part of the board tells which part it is (after OpenCV's ChArUco boards;
/// codes and detection are ours). Codes are numbered through the white squares in rows, from `first_code`.
struct Board {
  int columns = 8;  ///< squares; at most kMostSquares a side
  int rows = 8;
  double square = 0.2;  ///< side of a square, metres
  int first_code = 0;   ///< boards that are seen together need codes of their own
};

constexpr int kMostSquares = 16;
/// A code is kCodeSide × kCodeSide modules, black for 1; around it a margin of one white module on every side.
constexpr int kCodeSide = 4;
constexpr int kModules = kCodeSide + 2;
/// The number of codes. Any two, and any two turns of one, differ in at least kCodeDistance modules.
constexpr int kCodeCount = 120;
constexpr int kCodeDistance = 4;

/// Returns the modules of a code in rows from the top, the first one in the highest bit. 0 ≤ `number` < kCodeCount.
std::uint16_t CodeOf(int number);
/// Returns the code turned a quarter clockwise.
std::uint16_t Turned(std::uint16_t code);

/// Returns how many codes the board uses.
int CountCodes(const Board& board);
constexpr bool IsBlackSquare(int column, int row) { return (column + row) % 2 == 0; }
/// Returns the number of a white square's code.
int CodeNumberOf(const Board& board, int column, int row);

/// Returns whether the board is black at a point of its plane, metres from its top left corner: x to the right, y down.
bool IsBlackAt(const Board& board, const glm::dvec2& point);

/// A corner between four squares: the lower right one of the square (column, row); 0 ≤ column < columns − 1.
struct BoardCorner {
  int column = 0;
  int row = 0;
};
inline glm::dvec2 PlaceOf(const Board& board, const BoardCorner& corner) {
  return board.square * glm::dvec2(corner.column + 1, corner.row + 1);
}

}  // namespace etude

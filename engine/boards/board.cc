#include "engine/boards/board.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

using Turns = std::array<std::uint16_t, 4>;

Turns TurnsOf(std::uint16_t code) {
  Turns turns{code};
  for (std::size_t i = 1; i < turns.size(); ++i) turns[i] = Turned(turns[i - 1]);
  return turns;
}

int Difference(std::uint16_t a, std::uint16_t b) { return std::popcount(static_cast<std::uint16_t>(a ^ b)); }

/// Returns true if the code and each of its rotations by quarter turns differ in at least kCodeDistance modules.
bool DiffersFromItsTurns(const Turns& turns) {
  return std::all_of(turns.begin() + 1, turns.end(),
                     [&](std::uint16_t turn) { return Difference(turns[0], turn) >= kCodeDistance; });
}

/// Selects codes greedily from a pseudo-random sequence of all 16-bit words: a word is kept if it is far enough from
/// every rotation of the codes kept before.
std::vector<std::uint16_t> MakeCodes() {
  std::vector<std::uint16_t> codes;
  std::uint16_t word = 0;
  for (int i = 0; i < 1 << 16 && codes.size() < kCodeCount; ++i) {
    word = static_cast<std::uint16_t>(word * 25173 + 13849);  // a linear congruential generator of full period
    const Turns turns = TurnsOf(word);
    const bool is_free = std::all_of(codes.begin(), codes.end(), [&](std::uint16_t other) {
      return std::all_of(turns.begin(), turns.end(),
                         [&](std::uint16_t turn) { return Difference(turn, other) >= kCodeDistance; });
    });
    if (is_free && DiffersFromItsTurns(turns)) codes.push_back(word);
  }
  assert(codes.size() == kCodeCount);
  return codes;
}

}  // namespace

std::uint16_t CodeOf(int number) {
  static const std::vector<std::uint16_t> kCodes = MakeCodes();
  return kCodes[static_cast<std::size_t>(number)];
}

std::uint16_t Turned(std::uint16_t code) {
  std::uint16_t turned = 0;
  for (int row = 0; row < kCodeSide; ++row) {
    for (int column = 0; column < kCodeSide; ++column) {
      // The module at (row, column) of the rotated code comes from row `last - column`, column `row` of the original.
      const int from = (kCodeSide - 1 - column) * kCodeSide + row, to = row * kCodeSide + column;
      const int bit = code >> (15 - from) & 1;
      turned = static_cast<std::uint16_t>(turned | bit << (15 - to));
    }
  }
  return turned;
}

int CountCodes(const Board& board) { return board.columns * board.rows / 2; }

int CodeNumberOf(const Board& board, int column, int row) {
  // Even rows begin with a black square, so half of the squares before this one, rounded down, are white.
  return board.first_code + (row * board.columns + column) / 2;
}

bool IsBlackAt(const Board& board, const glm::dvec2& point) {
  const int column = static_cast<int>(std::floor(point.x / board.square));
  const int row = static_cast<int>(std::floor(point.y / board.square));
  if (column < 0 || row < 0 || column >= board.columns || row >= board.rows) return false;
  if (IsBlackSquare(column, row)) return true;
  // Find the module of the code at this point; the margin is white.
  const double module = board.square / kModules;
  const int x = static_cast<int>(std::floor((point.x - column * board.square) / module)) - 1;
  const int y = static_cast<int>(std::floor((point.y - row * board.square) / module)) - 1;
  if (x < 0 || y < 0 || x >= kCodeSide || y >= kCodeSide) return false;
  return CodeOf(CodeNumberOf(board, column, row)) >> (15 - (y * kCodeSide + x)) & 1;
}

}  // namespace etude

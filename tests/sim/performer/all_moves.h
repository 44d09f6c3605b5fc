#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/choreography/move.h"

namespace etude {

/// Returns every built-in move.
inline const std::vector<Move>& AllMoves() {
  static const std::vector<Move> moves = [] {
    std::vector<Move> loaded;
    for (const std::string& name : BuiltinMoveNames()) loaded.push_back(LoadBuiltinMove(name).value());
    return loaded;
  }();
  return moves;
}

}  // namespace etude

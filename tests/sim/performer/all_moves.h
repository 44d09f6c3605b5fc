#pragma once

#include <string>
#include <vector>

#include "sim/choreography/move.h"

namespace etude {

inline const std::vector<Move>& AllMoves() {
  static const std::vector<Move> moves = [] {
    std::vector<Move> loaded;
    for (const std::string& name : BuiltinMoveNames()) loaded.push_back(LoadBuiltinMove(name).value());
    return loaded;
  }();
  return moves;
}

/// Returns the built-in moves with these names in sequence, as one motion.
inline BodyMotion AfterEachOther(const std::vector<std::string>& names) {
  BodyMotion motion;
  for (const std::string& name : names) {
    const BodyMotion next = LoadBuiltinMove(name).value().motion;
    motion.poses.insert(motion.poses.end(), next.poses.begin(), next.poses.end());
  }
  return motion;
}

}  // namespace etude

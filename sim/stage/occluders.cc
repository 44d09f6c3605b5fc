#include "sim/stage/occluders.h"

namespace etude {

std::vector<Cuboid> BoxesOf(const Interior& interior) {
  std::vector<Cuboid> boxes;
  for (const FurnitureBox& piece : interior.furniture) boxes.push_back({piece.centre, piece.half_size, piece.heading});
  return boxes;
}

}  // namespace etude

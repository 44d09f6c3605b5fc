#include "sim/stage/occluders.h"

namespace etude {

std::vector<Box> BoxesOf(const Interior& interior) {
  std::vector<Box> boxes;
  for (const FurnitureBox& piece : interior.furniture) boxes.push_back({piece.centre, piece.half_size, piece.heading});
  return boxes;
}

}  // namespace etude

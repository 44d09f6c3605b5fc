#pragma once

#include <algorithm>

#include "engine/base/image.h"

namespace etude {

/// A pixel this close to the extracted person still counts as on it: extraction frays edges by a pixel or two.
constexpr int kFrayedEdgePx = 3;

/// Whether a pixel lies on the person, or at most `margin_px` beside it (in u and in v).
inline bool IsNearPerson(const Mask& person, int x, int y, int margin_px) {
  if (person.At(x, y) != 0) return true;
  for (int v = std::max(0, y - margin_px); v <= std::min(person.height - 1, y + margin_px); ++v) {
    for (int u = std::max(0, x - margin_px); u <= std::min(person.width - 1, x + margin_px); ++u) {
      if (person.At(u, v) != 0) return true;
    }
  }
  return false;
}

}  // namespace etude

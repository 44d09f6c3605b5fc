#pragma once

#include <cstddef>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// The neighbours that are connected: the four that share an edge, or also the four that share a corner.
enum class Connectivity { kFour, kEight };

/// The connected components of a mask, as the runs of pixels that they consist of.
struct Components {
  /// The pixels begin ≤ x < end of one row.
  struct Run {
    int row = 0;
    int begin = 0;
    int end = 0;
    std::size_t piece = 0;  ///< index into `pieces`
  };
  struct Piece {
    bool set = false;  ///< true for a component of 1s, false for one of 0s
    int size = 0;      ///< pixels
    bool touches_border = false;
  };

  std::vector<Run> runs;      ///< in scan order; together every pixel of the mask
  std::vector<Piece> pieces;  ///< in order of their first pixel in scan order
};

/// Labels the components of 1s by `connectivity`; the 0s are labelled by the other connectivity, so that a closed
/// 8-connected outline separates inside from outside.
Components LabelComponents(const Mask& mask, Connectivity connectivity = Connectivity::kEight);

/// Returns only the largest 8-connected component of 1s; among equals the first in scan order; empty if no pixel is
/// set.
Mask LargestComponent(const Mask& mask);

/// Returns the largest 8-connected component of 1s, and all others of at least `smallest` pixels whose bounding boxes
/// are within `reach` pixels of its box.
Mask LargeComponents(const Mask& mask, int smallest, int reach);

/// Sets the holes (4-connected components of 0s that do not touch the border) of at most `max_hole_px` pixels.
Mask FillHoles(const Mask& mask, int max_hole_px);

/// Computes FillHoles(LargestComponent(mask), max_hole_px) in place, reading the pixels once. Set pixels must be 1.
void KeepPerson(Mask& mask, int max_hole_px);

}  // namespace etude

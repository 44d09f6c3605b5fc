#pragma once

#include <cstddef>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// The neighbours that are connected to a pixel: the four neighbours across an edge, or also the four neighbours across
/// a corner.
enum class Connectivity { kFour, kEight };

/// The connected components of a mask, stored as runs of pixels.
struct Components {
  /// The pixels begin ≤ x < end of one row.
  struct Run {
    int row = 0;
    int begin = 0;
    int end = 0;
    std::size_t piece = 0;  ///< index of the run's component in `pieces`
  };
  struct Piece {
    bool set = false;  ///< true for a component of 1s, false for a component of 0s
    int size = 0;      ///< pixels
    bool touches_border = false;
  };

  std::vector<Run> runs;      ///< all pixels of the mask, in scan order
  std::vector<Piece> pieces;  ///< the components, in the scan order of their first pixels
};

/// Labels the components of 1s by `connectivity`. The 0s are labelled by the other connectivity, so a closed
/// 8-connected outline separates inside from outside.
Components LabelComponents(const Mask& mask, Connectivity connectivity = Connectivity::kEight);

/// Returns the mask of the largest 8-connected component of 1s; of equally large components, the first in scan order.
/// Returns an empty mask if no pixel is set.
Mask LargestComponent(const Mask& mask);

/// Returns the mask of the largest 8-connected component of 1s and of every other component that has at least
/// `smallest` pixels and whose bounding box is within `reach` pixels of the largest component's box.
Mask LargeComponents(const Mask& mask, int smallest, int reach);

/// Sets all holes of at most `max_hole_px` pixels. A hole is a 4-connected component of 0s that does not touch the
/// border.
Mask FillHoles(const Mask& mask, int max_hole_px);

/// Computes FillHoles(LargestComponent(mask), max_hole_px) in place, and reads the pixels only once. Set pixels must be
/// 1.
void KeepPerson(Mask& mask, int max_hole_px);

}  // namespace etude

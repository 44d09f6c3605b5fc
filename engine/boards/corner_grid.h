#pragma once

#include <map>
#include <utility>
#include <vector>

#include "engine/boards/saddles.h"

namespace etude {

/// Column and row of a corner in a grid of its own: i to the right, j down, as the picture shows them, from the corner
/// that it was begun with.
using GridPlace = std::pair<int, int>;
/// Corners that form a chessboard, as numbers of saddles.
using CornerGrid = std::map<GridPlace, std::size_t>;

/// The chessboard around saddle `seed`, grown from corner to corner along the edges; the square below right of (0, 0)
/// is bright. Saddles that are `taken` belong to other boards. It may be wrong, or the seed alone: codes tell.
CornerGrid GrowGrid(const GreyImage& picture, const std::vector<Saddle>& saddles, std::size_t seed,
                    const std::vector<bool>& taken);

}  // namespace etude

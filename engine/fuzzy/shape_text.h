#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/document/node.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// Reads `{triangular: [20, 90, 180]}`, `{trapezoidal: [0, 0, 20, 90]}`, `{gaussian: [90, 25]}` or `{singleton: 90}`.
/// Refused: breakpoints out of order, sigma that is not positive, and a shape whose top no input of `universe` reaches.
Result<Shape> ReadShape(const Node& node, const Universe& universe);

/// Writes a shape as ReadShape reads it back, to the last bit.
std::string WriteShape(const Shape& shape);

}  // namespace etude

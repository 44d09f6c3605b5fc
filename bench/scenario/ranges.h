#pragma once

#include <vector>

#include "engine/document/node.h"

namespace etude {

/// The values of a swept parameter: those of a list, or of a range: `{from: 5, to: 20, step: 5}`,
/// `{from: 1, to: 100, count: 5, scale: log}`. A range's values are written with at most 12 digits, so that
/// 0.1 + 2 × 0.1 reads 0.3; all stand where the range stands. At least one, at most `most`.
Result<std::vector<Node>> SweptValues(const Node::Entry& swept, std::size_t most);

}  // namespace etude

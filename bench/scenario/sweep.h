#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// How many values the mappings of a file's scenarios and of their conditions may hold: each is a copy.
constexpr std::size_t kMostValues = 300'000;
constexpr std::size_t kMostConditions = 1000;

/// Reads `sweep`: the product of its axes, the last one varying fastest. An axis is a swept parameter, or
/// several that are stepped through `together`. Complaints stay in `fields`.
std::vector<Condition> ReadSweep(Fields& fields, const TaskKind& kind);

}  // namespace etude

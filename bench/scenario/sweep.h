#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/keys/field_table.h"
#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"
#include "engine/document/node.h"

namespace etude {

/// Returns the values of a swept parameter, from a list or a range: `{from: 5, to: 20, step: 5}`, `{from: 1, to: 100,
/// count: 5, scale: log}`. A range's values are written with at most 12 digits, so that 0.1 + 2 × 0.1 reads 0.3; their
/// position, for complaints, is that of the range. At least one value, at most `most`.
Result<std::vector<Node>> SweptValues(const Node::Entry& swept, std::size_t most);

struct RangeWords {
  double from = 0, to = 0;
  std::optional<double> step;
  std::optional<std::uint64_t> count;
  bool is_logarithmic = false;
};
/// The keys of a range of at most `most` values.
FieldTable<RangeWords> RangeFields(std::size_t most);

/// The largest number of values in all mappings of a file: those of its scenarios and those of their conditions, each
/// of which is a copy.
constexpr std::size_t kMaxFileValues = 300'000;
constexpr std::size_t kMaxConditions = 1000;

/// Reads `sweep`: the product of its axes, the last one varying fastest. An axis is one swept parameter, or several
/// that are stepped in parallel (`together`). Complaints stay in `fields`.
std::vector<Condition> ReadSweep(Fields& fields, const TaskKind& kind);

}  // namespace etude

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
/// count: 5, scale: log}`. A range's values are written with at most 12 digits, so 0.1 + 2 × 0.1 reads 0.3. An error
/// message about such a value names the line and column of the range. Fails if there is no value or more than `most`.
Result<std::vector<Node>> SweptValues(const Node::Entry& swept, std::size_t most);

struct RangeWords {
  double from = 0, to = 0;
  std::optional<double> step;
  std::optional<std::uint64_t> count;
  bool is_logarithmic = false;
};
/// Returns the keys of a range with at most `most` values.
FieldTable<RangeWords> RangeFields(std::size_t most);

/// The largest total number of values in the mappings of a file's scenarios and conditions. Each condition has a copy
/// of its scenario's mapping.
constexpr std::size_t kMaxFileValues = 300'000;
constexpr std::size_t kMaxConditions = 1000;

/// Reads `sweep` and returns a condition for each combination of the axes' values; the last axis varies fastest. An
/// axis is one swept parameter, or several parameters that change their values together (`together`). Errors are
/// collected in `fields`.
std::vector<Condition> ReadSweep(Fields& fields, const TaskKind& kind);

}  // namespace etude

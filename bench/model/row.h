#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/model/cell_result.h"

namespace etude {

/// A swept parameter and its value in one condition, both as the scenario wrote them.
struct SweptValue {
  std::string key;
  std::string value;
  bool operator==(const SweptValue&) const = default;
};

/// One line of cells.jsonl: a cell's identity and what came of it.
struct Row {
  std::string scenario;
  std::string task;
  std::vector<SweptValue> condition;  ///< empty when nothing is swept
  int trial = 0;
  std::string clip;                ///< "" for tasks without clips
  std::vector<std::string> units;  ///< that the world was drawn from (Study::unit); empty = it is its own
  std::string method;
  CellResult result;  ///< `series` and `recording` live in files of their own

  /// "scenario/key=value,key=value/trial/method", unique in a run; a condition without sweep is "-".
  std::string Id() const;
};

/// A row's value of a metric; nothing when it is missing or was not measured.
std::optional<double> ValueOf(const Row& row, std::string_view metric);

/// For people: "key=value, key=value", or "" when nothing is swept.
std::string ConditionLabel(const std::vector<SweptValue>& condition);
/// For identities: "key=value,key=value", or "-".
std::string CompactLabel(const std::vector<SweptValue>& condition);

}  // namespace etude

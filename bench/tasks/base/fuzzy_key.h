#pragma once

#include "bench/keys/field_table.h"
#include "bench/tasks/base/task.h"
#include "engine/fuzzy/open_fuzzy_system.h"

namespace etude {

constexpr const char* kFuzzyKey = "fuzzy";

/// Returns the key `fuzzy` of a task that grades poses. Its value is `builtin:NAME` or a file.
KeyInfo FuzzyKey();
template <typename Options>
Field<Options> FuzzyField() {
  return {FuzzyKey(), [](Fields& condition, Options&) { condition.Raw(kFuzzyKey); }};
}

/// Returns the fuzzy system that the condition names; if it names none, the fuzzy system of paper A.
Result<FuzzySystem> FuzzySystemOf(const TaskInput& input);

}  // namespace etude

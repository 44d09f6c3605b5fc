#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "bench/tasks/base/task.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

constexpr const char* kFuzzyKey = "fuzzy";

/// The key `fuzzy`, for the condition_keys of a task that grades poses. Whoever makes the task opens what it names.
KeyInfo FuzzyKey();
/// What such a task grades by: marks the key as read.
const FuzzySystem& FuzzyOf(TaskInput& input);

/// Whether a reference names a file, and not `builtin:NAME`.
bool IsFuzzyFile(std::string_view reference);

/// Gives the text of a file that `fuzzy` names.
using FuzzyTextOf = std::function<Result<std::string>(const std::string& file)>;

/// Opens `builtin:NAME` or a file; `asked_at` is where the reference stands.
Result<FuzzySystem> OpenFuzzySystem(const std::string& reference, const Place& asked_at, const FuzzyTextOf& text_of);

}  // namespace etude

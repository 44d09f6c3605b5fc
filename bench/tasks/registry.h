#pragma once

#include <span>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// Returns all kinds of tasks: transition, detection, ik, tracking, capture, pose-distance, coach,
/// evaluation.
std::span<const TaskKind> AllTaskKinds();
/// Returns the task of that name; null if there is none.
const TaskKind* FindTaskKind(std::string_view name);

}  // namespace etude

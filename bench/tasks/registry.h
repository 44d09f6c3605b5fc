#pragma once

#include <span>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// Returns all kinds of tasks: transition, detection, ik, tracking, capture, pose-distance, coach, evaluation,
/// plausibility, inbetween.
std::span<const TaskKind> AllTaskKinds();
/// Returns the kind of task with this name; null if there is none.
const TaskKind* FindTaskKind(std::string_view name);

}  // namespace etude

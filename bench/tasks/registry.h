#pragma once

#include <span>
#include <string_view>

#include "bench/tasks/base/task.h"

namespace etude {

/// Every kind of question: transition, detection, ik, tracking, capture, search, pose-distance, coach.
std::span<const TaskKind> AllTaskKinds();
/// Null when there is no such task.
const TaskKind* FindTaskKind(std::string_view name);

}  // namespace etude

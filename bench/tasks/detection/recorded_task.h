#pragma once

#include <memory>
#include <vector>

#include "bench/streams/load.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/options.h"

namespace etude {

/// A task whose worlds are recorded people, a trial each by their names' order: judged by what the file of taught moves
/// says that the condition names, else by what all others did. The task keeps the set's address.
Result<std::unique_ptr<Task>> MakeRecordedTask(TaskInput& input, const DetectionOptions& options,
                                               std::vector<DetectionMethod> methods);

}  // namespace etude

#pragma once

#include <memory>
#include <string>

#include "bench/tasks/base/task.h"
#include "io/clips/clip_library.h"

namespace etude {

/// Makes a task from the keys of a condition, "{…}", and a list of methods, "[…]".
inline Result<std::unique_ptr<Task>> MakeTask(const TaskKind& kind, const std::string& condition,
                                              const std::string& methods = "[]", const ClipLibrary& clips = {}) {
  ASSIGN_OR_RETURN(const auto keys, ParseYaml(condition, "test.yaml"));
  ASSIGN_OR_RETURN(const auto list, ParseYaml(methods, "methods.yaml"));
  Fields fields(keys, "a scenario");
  TaskInput input{fields, list.items, clips};
  return kind.make(input);
}

}  // namespace etude

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/clips/clip_library.h"
#include "bench/tasks/base/task.h"

namespace etude {

/// A small world of a task, made to be put to a method outside.
struct SpecimenProblem {
  std::string id;
  std::unique_ptr<TaskWorld> world;
  Payload problem;  ///< empty where programs take a seat
};

/// Problems that share a setting.
struct Specimen {
  std::string setting_id;
  std::unique_ptr<ClipLibrary> clips;  ///< outlive the task
  std::unique_ptr<Task> task;
  Payload setting;
  std::vector<SpecimenProblem> problems;
};

/// Two settings of a task with three problems each; the same every time. Fails when there is no such task, its worlds
/// cannot be made here (no renderer), or `seat` is none of its seats ("" where it has none).
Result<std::vector<Specimen>> MakeSpecimens(const std::string& task, const std::string& seat);

}  // namespace etude

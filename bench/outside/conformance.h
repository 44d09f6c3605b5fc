#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/outside/outside_method.h"
#include "bench/tasks/base/task.h"

namespace etude {

/// A small world of a task, for testing an outside method.
struct SpecimenProblem {
  std::string id;
  std::unique_ptr<TaskWorld> world;
  Payload problem;  ///< empty for tasks with seats
};

/// Problems that share a setting.
struct Specimen {
  std::string setting_id;
  std::unique_ptr<ClipLibrary> clips;  ///< outlive the task
  std::unique_ptr<Task> task;
  Payload setting;
  std::vector<SpecimenProblem> problems;
  bool has_plain_method = false;  ///< method 0 of the worlds is a plain built-in one that solves them
};

/// Makes two settings of a task with three problems each, always the same. Fails if there is no such task, its worlds
/// cannot be made here (no renderer), or `seat` is not one of its seats ("" for a task without seats).
Result<std::vector<Specimen>> MakeSpecimens(const std::string& task, const std::string& seat);

/// One requirement for an outside method, and its result.
struct ConformanceCheck {
  std::string name;  ///< a sentence that is true of a method that passes
  bool passed = false;
  std::string found;  ///< what was observed, passed or not
};

/// Sends small worlds of the method's task to it and reports every check as it is done: that it answers the handshake,
/// that its answers can be scored, that they depend on the problem alone (not on earlier problems or settings), that it
/// accepts long lines, and that it ends when its input ends. Stops early if no problem is answered, or none is solved
/// although a plain built-in method solves some; it then reports if the angles seem to be in radians. Returns true if
/// all checks passed. Fails if the task does not exist, its worlds cannot be made, `seat` is not one of its seats (""
/// for a task without seats), or the program cannot be found.
Result<bool> CheckConformance(const OutsideOptions& options, const std::string& seat,
                              const std::function<void(const ConformanceCheck&)>& report);

}  // namespace etude

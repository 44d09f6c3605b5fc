#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/outside/outside_method.h"
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
  bool has_plain_method = false;  ///< the worlds' method 0 is a plain built-in one that solves them
};

/// Makes two settings of a task with three problems each, the same every time. Fails when there is no such task, its
/// worlds cannot be made here (no renderer), or `seat` is none of its seats ("" where it has none).
Result<std::vector<Specimen>> MakeSpecimens(const std::string& task, const std::string& seat);

/// One thing that a method outside must do, and how it did it.
struct ConformanceCheck {
  std::string name;  ///< a sentence about a method that passes
  bool passed = false;
  std::string found;  ///< what was seen, either way
};

/// Puts small worlds of the method's task to it and reports every check as it is done: that it greets, that its
/// answers can be scored, that they depend on the problem alone (not on what was asked before, nor on the setting
/// before), that it takes long lines, and that it ends with its input. Ends early when no problem is answered, or none
/// is solved where a plain built-in method solves some; then it says whether angles were told in radians. Whether all
/// were passed; fails when the task does not exist, its worlds cannot be made, `seat` is none of its seats
/// ("" where it has none), or the program cannot be found.
Result<bool> CheckConformance(const OutsideOptions& options, const std::string& seat,
                              const std::function<void(const ConformanceCheck&)>& report);

}  // namespace etude

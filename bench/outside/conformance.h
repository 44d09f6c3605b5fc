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
  std::string setting_id;
  /// The setting: the data that all problems of the specimen share, or those of this world alone
  /// (Task::HasOwnSettings).
  std::shared_ptr<const Payload> setting;
  std::unique_ptr<TaskWorld> world;
  Payload problem;  ///< the problem; empty if the tested program takes a seat
};

struct Specimen {
  std::unique_ptr<ClipLibrary> clips;  ///< the clips, which must outlive the task
  std::unique_ptr<Task> task;
  std::vector<SpecimenProblem> problems;
  bool has_plain_method = false;  ///< true: method 0 is a built-in method that solves some of the specimen's worlds
};

/// Makes two specimens of a task, each with another condition and with three problems. The specimens are the same in
/// every call. With `recordings`, both specimens have the same condition, and one problem for each of the first three
/// recorded people; only task detection has such worlds. `recordings` must outlive the result. Fails if there is no
/// such task, if its worlds cannot be made on this machine (no renderer), or if `seat` is not one of the task's seats
/// ("" if the task has no seats).
Result<std::vector<Specimen>> MakeSpecimens(const std::string& task, const std::string& seat,
                                            const LabelledStreams* recordings = nullptr);

/// One requirement for an outside method, and the result of its check.
struct ConformanceCheck {
  std::string name;  ///< what a method that passes does, e.g. "ends when its input ends"
  bool passed = false;
  std::string found;  ///< what was observed, also if the method passed
};

/// Sends the sample problems of the method's task (MakeSpecimens) to the method and calls `report` after every check.
/// The checks are: the method answers the handshake; its answers can be scored; they depend on the problem alone, not
/// on earlier problems or settings; it accepts long lines; it answers every question once; it ends when its input ends;
/// and it solves some problems if a plain built-in method solves some (if not, the report says whether the answered
/// angles seem to be in radians). Stops after a failed handshake or an answer that cannot be scored. Returns true if
/// all checks passed. Fails if MakeSpecimens fails, or if the program cannot be started or ends at the first problem.
Result<bool> CheckConformance(const OutsideOptions& options, const std::string& seat,
                              const std::function<void(const ConformanceCheck&)>& report,
                              const LabelledStreams* recordings = nullptr);

}  // namespace etude

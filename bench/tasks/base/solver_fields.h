#pragma once

#include "bench/tasks/base/task.h"
#include "engine/document/fields.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

/// Reads a method's `solver` (gauss-newton by default) and what that solver can be set by (`weights`, `refresh`,
/// `memory`, …) into `options`. Settings of another solver are a mistake worth telling. Complaints stay in `fields`.
const IkSolver* ReadIkSolver(Fields& fields, IkOptions& options);

/// Reads a condition's `stop_at` (practical by default) into the goals of `options`.
void ReadIkGoals(Fields& condition, IkOptions& options);

/// What the functions above read, for the reference page.
std::vector<KeyInfo> IkSolverKeys();
KeyInfo IkGoalsKey();

}  // namespace etude

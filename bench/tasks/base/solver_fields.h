#pragma once

#include "bench/tasks/base/task.h"
#include "engine/document/fields.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

/// Reads a method's `solver` (ccd by default) and what that solver can be set by (`weights`, `refresh`, `memory`, …)
/// into `options`. Settings of another solver are a mistake worth telling. Complaints stay in `fields`.
const IkSolver* ReadIkSolver(Fields& fields, IkOptions& options);

/// What the function above reads, for the reference page.
std::vector<KeyInfo> IkSolverKeys();

}  // namespace etude

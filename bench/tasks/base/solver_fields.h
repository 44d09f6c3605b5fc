#pragma once

#include "engine/document/fields.h"
#include "engine/kinematics/solvers.h"

namespace etude {

/// Reads a method's `solver` (ccd by default) and, where that solver uses them, `weights` and `refresh` into `options`.
/// Weights for a solver that has none are a mistake worth telling. Complaints stay in `fields`.
const IkSolver* ReadIkSolver(Fields& fields, IkOptions& options);

}  // namespace etude

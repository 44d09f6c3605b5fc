#pragma once

namespace etude {

/// Prints the solvers of inverse kinematics, a line each.
void PrintSolvers();

}  // namespace etude

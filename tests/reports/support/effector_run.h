#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// ExampleRun with what the cells of `ik-weights` keep of single effectors and joints. Every figure tells where it
/// comes from, so that a table which takes it from elsewhere shows.
RunData EffectorRun();

/// The figures of EffectorRun. `axis`: 0…2; `effector`, `dof`: in the tree's order.
double StartPositionError(int trial, int effector, int axis);
double PositionError(int method, int trial, int effector, int axis);
double OrientationError(int method, int trial, int effector, int axis);
double AngleChange(int method, int trial, int dof);

}  // namespace etude

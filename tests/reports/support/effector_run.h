#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// Returns ExampleRun with errors of single effectors and joints in the cells of `ik-weights`. Every figure encodes its
/// origin, so that a test detects a figure from the wrong place.
RunData EffectorRun();

/// Return the figures of EffectorRun. `axis` is 0…2; `effector` and `dof` are in the tree's order.
double StartPositionError(int trial, int effector, int axis);
double PositionError(int method, int trial, int effector, int axis);
double OrientationError(int method, int trial, int effector, int axis);
double AngleChange(int method, int trial, int dof);

}  // namespace etude

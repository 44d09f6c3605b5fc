#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/batch_sweep.h"

namespace etude {

/// When a pose that lanes have measured meets its goals. In between, it must be measured once more.
struct LaneGoals {
  double squared_distance_met = 0, squared_distance_missed = 0;
  double squared_chord_met = 0, squared_chord_missed = 0;
};

LaneGoals GoalsFor(const IkOptions& options, Precision precision);

}  // namespace etude

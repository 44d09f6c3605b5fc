#pragma once

#include "bench/tasks/ik/ik_options.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// One trial (after paper B's chapter 5): a true pose, and the problem of finding back
/// from a disturbed one to the places and axes of its end effectors.
struct IkWorld {
  TreeState truth;
  IkProblem problem;
};

/// Truth and noise come from `key` alone; `options` only scales them.
IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key);

}  // namespace etude

#pragma once

#include <string>

#include "bench/tasks/ik/options.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// One trial (after paper B's chapter 5): a true pose, and the problem of finding from another one to the places and
/// axes of its end effectors. The truth solves it, unless the options disturb targets or pull one out of reach.
struct IkWorld {
  TreeState truth;
  IkProblem problem;
};

/// Poses are within the limits of `tree`, which are the problem's. Dice come from `key` alone; `options` only scales
/// what they say.
IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key);

std::string DigestOf(const IkWorld& world);

}  // namespace etude

#pragma once

#include <span>
#include <vector>

#include "engine/base/digest.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// Targets that `state` meets exactly: the places and axes of its end effectors.
std::vector<EffectorTarget> TargetsMetBy(const KinematicTree& tree, const TreeState& state);

/// Adds the places and axes of targets to the fingerprint of a world.
void AddTo(Digest& digest, std::span<const EffectorTarget> targets);

/// The errors of targets: their distance from where the body's ends really are.
struct TargetNoise {
  double position_cm = 0;      ///< standard deviation along each of the world's axes
  double orientation_deg = 0;  ///< standard deviation of the rotation vector, likewise
};

/// Moves and turns every target by dice of its own: six numbers per target whatever the strengths, so that these
/// change nothing else.
void Disturb(std::vector<EffectorTarget>& targets, const TargetNoise& noise, RandomStream& dice);

}  // namespace etude

#pragma once

#include <span>
#include <vector>

#include "engine/base/digest.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns the targets that `state` reaches exactly: the positions and axes of the end effectors.
std::vector<EffectorTarget> TargetsMetBy(const KinematicTree& tree, const TreeState& state);

/// Adds the positions and axes of targets to the digest of a world.
void AddTo(Digest& digest, std::span<const EffectorTarget> targets);

/// The measurement noise of targets of inverse kinematics.
struct TargetNoise {
  double position_cm = 0;      ///< standard deviation along each axis of the world
  double orientation_deg = 0;  ///< standard deviation of each component of the rotation vector
};

/// Moves and turns every target by random noise. Always draws six numbers per target, so that the noise strength has no
/// effect on later draws from `dice`.
void Disturb(std::vector<EffectorTarget>& targets, const TargetNoise& noise, RandomStream& dice);

}  // namespace etude

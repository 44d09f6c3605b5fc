#pragma once

#include <glm/glm.hpp>
#include <span>

#include "engine/kinematics/tree.h"

namespace etude {

/// The coordinates of a free root before those of the angles: three of its place, three of its turn.
constexpr int kRootDofs = 6;

/// Returns the rotation about `turn` by its length, radians (Rodrigues).
glm::dmat3 RotationBy(const glm::dvec3& turn);

/// Returns the rotation vector of a rotation, shorter than half a turn; of half a turn, nothing is promised but its
/// length being π or 0.
glm::dvec3 TurnOf(const glm::dmat3& rotation);

/// Moves every coordinate of `state` by so much: by[0…2] is added to the root's place, by[3…5] turns it (a rotation
/// vector in the world), the rest is added to the angles, which stay within their limits.
TreeState Moved(const KinematicTree& tree, const TreeState& state, std::span<const double> by);

/// Returns the mean of two poses, half-way also in the root's turn.
TreeState MeanState(const TreeState& a, const TreeState& b);

/// Extrapolates a motion: returns `last` moved on by `share` of the way from `before` to it.
TreeState Extrapolated(const TreeState& before, const TreeState& last, double share);

}  // namespace etude

#pragma once

#include <glm/glm.hpp>
#include <span>

#include "engine/kinematics/tree.h"

namespace etude {

/// The number of coordinates of a free root, which precede the angles: three of its position, three of its rotation.
constexpr int kRootDofs = 6;

/// Returns the rotation about the vector `turn` by its length, radians (Rodrigues).
glm::dmat3 RotationBy(const glm::dvec3& turn);

/// Returns the rotation vector of a rotation of less than half a turn. For half a turn the vector's direction is
/// unspecified and its length is π or 0.
glm::dvec3 TurnOf(const glm::dmat3& rotation);

/// Changes every coordinate of `state`: by[0…2] is added to the root's position, by[3…5] rotates it (a rotation vector
/// in the world), the rest is added to the angles, which are clamped to their limits.
TreeState Moved(const KinematicTree& tree, const TreeState& state, std::span<const double> by);

/// Returns the mean of two poses; the root's rotation is half-way between theirs.
TreeState MeanState(const TreeState& a, const TreeState& b);

/// Extrapolates a motion: adds `share` of the change from `before` to `last` to `last`.
TreeState Extrapolated(const TreeState& before, const TreeState& last, double share);

}  // namespace etude

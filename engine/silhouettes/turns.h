#pragma once

#include <glm/glm.hpp>
#include <span>

#include "engine/kinematics/tree.h"

namespace etude {

/// The number of coordinates of a free root: three of its position, three of its rotation. The angles are the
/// coordinates after these six.
constexpr int kRootDofs = 6;

/// Returns the rotation about the direction of `turn` by the length of `turn`, radians (Rodrigues' formula).
glm::dmat3 RotationBy(const glm::dvec3& turn);

/// Returns the rotation vector of a rotation by less than half a turn. For half a turn, the direction is unspecified
/// and the length is π or 0.
glm::dvec3 TurnOf(const glm::dmat3& rotation);

/// Changes the coordinates of `state`: by[0…2] is added to the root's position, by[3…5] rotates the root (a rotation
/// vector in the world), and the rest is added to the angles, which are clamped to their limits.
TreeState Moved(const KinematicTree& tree, const TreeState& state, std::span<const double> by);

/// Returns the mean of two poses; the mean's root rotation is half-way between the rotations of the two roots.
TreeState MeanState(const TreeState& a, const TreeState& b);

/// Extrapolates a motion: adds to `last` the fraction `share` of the change from `before` to `last`.
TreeState Extrapolated(const TreeState& before, const TreeState& last, double share);

}  // namespace etude

#pragma once

#include <glm/glm.hpp>

namespace etude {

/// A turn as axis × angle, radians: its length is the angle. Bodies are joints without frames of their own, so the turn
/// of a limb is the smallest one between two directions.
using LimbTurn = glm::dvec3;

/// The smallest turn from one direction to another, any lengths; none when either vector is zero. Opposite directions
/// turn about an axis across `from` that is always the same one.
LimbTurn TurnBetween(const glm::dvec3& from, const glm::dvec3& to);

/// `v` after a turn; its length stays.
glm::dvec3 Turned(const glm::dvec3& v, const LimbTurn& turn);

}  // namespace etude

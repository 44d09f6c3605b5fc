#pragma once

#include <glm/glm.hpp>

namespace etude {

/// A turn as axis × angle, radians: its length is the angle. Bodies are joints without frames of their own, so the turn
/// of a limb is the smallest one between two directions.
using LimbTurn = glm::dvec3;

/// Returns the smallest turn from one direction to another, any lengths; none when either vector is zero. Opposite
/// directions turn about an axis across `from` that is always the same one.
LimbTurn TurnBetween(const glm::dvec3& from, const glm::dvec3& to);

/// Returns `v` after a turn; its length stays.
glm::dvec3 Turned(const glm::dvec3& v, const LimbTurn& turn);

/// A knee's place in a leg: across the line from hip to ankle, metres. Its direction is where the knee points, its
/// length how far it is bent out of that line.
glm::dvec3 KneeOffset(const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle);

/// Returns `offset`, a KneeOffset of a leg along `from`, carried to a leg along `to` by the smallest turn between the
/// two.
glm::dvec3 CarriedOffset(const glm::dvec3& offset, const glm::dvec3& from, const glm::dvec3& to);

/// A leg of two limbs whose lengths stay exact.
struct Leg {
  glm::dvec3 knee{0}, ankle{0};
};

/// The leg from `hip` to `ankle`, or as near to it along that line as limbs of lengths `thigh` and `shin` reach, the
/// knee on the side of `pole` (any length; only its part across the leg counts).
Leg SolveLeg(const glm::dvec3& hip, const glm::dvec3& ankle, double thigh, double shin, const glm::dvec3& pole);

}  // namespace etude

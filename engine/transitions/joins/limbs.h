#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace etude {

/// A rotation vector: axis × angle, in radians. Bodies are joint positions without local frames, so a limb's rotation
/// is the smallest one between two directions.
using LimbTurn = glm::dvec3;

/// Returns the smallest rotation from one direction to another, for vectors of any lengths; zero if either is zero. For
/// opposite directions the axis is a fixed one that is perpendicular to `from`.
LimbTurn TurnBetween(const glm::dvec3& from, const glm::dvec3& to);

/// Returns the rotated vector `v`, which keeps its length.
glm::dvec3 Turned(const glm::dvec3& v, const LimbTurn& turn);

/// Returns the vector from the hip–ankle line to the knee, perpendicular to that line, in metres. Its direction tells
/// where the knee points, its length how far the leg is bent.
glm::dvec3 KneeOffset(const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle);

/// Returns `offset`, a KneeOffset of a leg along `from`, rotated for a leg along `to` by the smallest rotation between
/// the two.
glm::dvec3 CarriedOffset(const glm::dvec3& offset, const glm::dvec3& from, const glm::dvec3& to);

/// The solution for a leg of two limbs with fixed lengths.
struct Leg {
  glm::dvec3 knee{0}, ankle{0};
};

/// Solves two-bone inverse kinematics for a leg from `hip` to `ankle` with limbs of lengths `thigh` and `shin`. If they
/// cannot reach, the ankle is placed as near as possible on the line. The knee points towards `pole` (of any length;
/// only its component perpendicular to the leg counts).
Leg SolveLeg(const glm::dvec3& hip, const glm::dvec3& ankle, double thigh, double shin, const glm::dvec3& pole);

constexpr double kStill = 0.005;  ///< metres; a foot that travels no farther is not lifted
/// Returns the height of a step in its middle, for a foot that travels this far: at most 5 cm. Metres.
double LiftFor(double travel);
/// Returns how far a hip must be lowered for its leg to reach the ankle, in metres; at most 10 cm.
double HipDrop(const glm::dvec3& hip, const glm::dvec3& ankle, double reach);
/// Returns a smooth curve above `needed`. Near both ends it goes down to 0, so it may be below `needed` there.
std::vector<double> SmoothlyAbove(const std::vector<double>& needed);

}  // namespace etude

#pragma once

#include <glm/glm.hpp>

namespace etude {

/// A knee's place in a leg: across the line from hip to ankle, metres. Its direction is where the knee points, its
/// length how far it is bent out of that line.
glm::dvec3 KneeOffset(const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle);

/// `offset`, a KneeOffset of a leg along `from`, carried to a leg along `to` by the smallest turn between the two.
glm::dvec3 CarriedOffset(const glm::dvec3& offset, const glm::dvec3& from, const glm::dvec3& to);

/// A leg of two limbs whose lengths stay exact.
struct Leg {
  glm::dvec3 knee{0}, ankle{0};
};

/// The leg from `hip` to `ankle`, or as near to it along that line as limbs of lengths `thigh` and `shin` reach, the
/// knee on the side of `pole` (any length; only its part across the leg counts).
Leg SolveLeg(const glm::dvec3& hip, const glm::dvec3& ankle, double thigh, double shin, const glm::dvec3& pole);

}  // namespace etude

#pragma once

#include <glm/glm.hpp>

#include "engine/kinematics/tree.h"

namespace etude {

/// How well the end effectors below a hinge meet their targets after turning it by φ (paper B, equations 3.10–3.13):
/// g(φ) = k₁(1 − cos φ) + k₂ cos φ + k₃ sin φ, to be maximal. Sums of several effectors are
/// ours. For axes the paper sets out from Σ (u_d · u_c − 1)² and then makes Σ u_d · u_c largest, which is not the same
/// for three of them; the latter is meant here, and makes Σ |u_d − u_c|² least.
struct HingeGain {
  double k1 = 0, k2 = 0, k3 = 0;

  /// Adds one pair of vectors, current and desired, both from the joint: a position of the effector
  /// or one of its axes. All in one frame; `axis` is the hinge's, of unit length.
  void Add(double weight, const glm::dvec3& current, const glm::dvec3& desired, const glm::dvec3& axis) {
    k1 += weight * (glm::dot(desired, axis) * glm::dot(current, axis));
    k2 += weight * glm::dot(desired, current);
    k3 += weight * glm::dot(axis, glm::cross(current, desired));
  }

  double At(double phi) const;

  /// The φ in (−π, π] where g is maximal; 0 when g is flat.
  double Optimum() const;

  /// The best φ within `range`, which holds 0 (so a turn by nothing is always allowed). The optimum counts modulo 2π;
  /// when it is outside, the end of the range with the larger g, the lower one on a tie.
  double OptimumWithin(const AngleRange& range) const;
};

}  // namespace etude

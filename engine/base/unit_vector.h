#pragma once

#include <glm/glm.hpp>

namespace etude {

/// `v` at length 1; `otherwise` where it has no direction to speak of (shorter than 1e-9).
inline glm::dvec3 UnitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  constexpr double kNoLength = 1e-9;
  const double length = glm::length(v);
  return length < kNoLength ? otherwise : v / length;
}

}  // namespace etude

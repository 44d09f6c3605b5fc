#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace etude {

/// Right-handed rotations about the axes, radians. The columns are the rotated axes.
inline glm::dmat3 RotationX(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
}
inline glm::dmat3 RotationY(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}
inline glm::dmat3 RotationZ(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// Returns the rotation of an upright part of the body: the part turns left, then bends to the left side, then forward;
/// the bends are in the turned frame.
inline glm::dmat3 TurnSideBend(double turn, double side, double bend) {
  return RotationY(turn) * RotationZ(-side) * RotationX(bend);
}

}  // namespace etude

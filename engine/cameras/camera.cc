#include "engine/cameras/camera.h"

#include <cassert>

namespace etude {

Camera LookAt(const Intrinsics& intrinsics, const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 right = glm::cross(forward, glm::dvec3(0, 1, 0));
  [[maybe_unused]] constexpr double kVertical = 1e-9;
  assert(glm::length(right) > kVertical && "a vertical view has no upright picture");
  const glm::dvec3 x = glm::normalize(right);
  const glm::dvec3 y = glm::cross(forward, x);
  // The rows of R_CW are the camera's axes in the world.
  return {intrinsics, glm::transpose(glm::dmat3(x, y, forward)), eye};
}

ProjectionMatrix MatrixOf(const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3 K = glm::transpose(glm::dmat3(in.fx, in.skew, in.cx, 0, in.fy, in.cy, 0, 0, 1));
  const glm::dmat3 M = K * camera.R_CW;
  const glm::dvec3 last = -(M * camera.p_WC);
  ProjectionMatrix matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix.h[row][column] = M[column][row];
    matrix.h[row][3] = last[row];
  }
  return matrix;
}

std::optional<glm::dvec2> Project(const ProjectionMatrix& matrix, const glm::dvec3& point) {
  glm::dvec3 p;
  for (int row = 0; row < 3; ++row) {
    const auto& h = matrix.h[row];
    p[row] = h[0] * point.x + h[1] * point.y + h[2] * point.z + h[3];
  }
  constexpr double kOnThePlane = 1e-9;
  if (!(p.z > kOnThePlane)) return std::nullopt;
  return glm::dvec2(p.x / p.z, p.y / p.z);
}

}  // namespace etude

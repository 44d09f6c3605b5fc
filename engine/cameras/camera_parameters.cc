#include "engine/cameras/camera_parameters.h"

#include <cmath>

#include "engine/base/euler.h"

namespace etude {
namespace {

void SetAngles(const glm::dmat3& R_CW, CameraParameters& p) {
  const glm::dvec3 angles = AnglesXyz(R_CW);
  p.omega = angles.x;
  p.phi = angles.y;
  p.kappa = angles.z;
}

}  // namespace

Result<CameraParameters> Decompose(const ProjectionMatrix& matrix) {
  double sum = 0;
  for (const auto& row : matrix.h) {
    for (const double value : row) sum += std::abs(value);
  }
  if (!std::isfinite(sum)) return Fail({}, "the camera matrix has a number that is not finite");
  // Normalise so that the third row is the viewing axis.
  const auto row = [&](int i) { return glm::dvec3(matrix.h[i][0], matrix.h[i][1], matrix.h[i][2]); };
  const double scale = glm::length(row(2));
  if (!(scale > 0))
    return Fail({}, "the camera matrix places the camera at infinity: its third row begins with three zeros");
  const glm::dvec3 a1 = row(0) / scale, a2 = row(1) / scale, a3 = row(2) / scale;
  const glm::dvec3 n1 = glm::cross(a1, a3), n2 = glm::cross(a2, a3);
  constexpr double kParallel = 1e-12;
  if (!(glm::length(n1) > kParallel * glm::length(a1)) || !(glm::length(n2) > kParallel * glm::length(a2)) ||
      !(glm::length(glm::cross(n1, n2)) > kParallel * glm::length(n1) * glm::length(n2))) {
    return Fail({}, "the camera matrix projects all points onto one line");
  }
  if (!(glm::dot(a1, glm::cross(a2, a3)) > 0)) {
    return Fail({}, "the camera matrix mirrors the picture; a world axis or a pixel axis may be reversed");
  }
  // Compute intrinsics and rotation from dot and cross products of the rows.
  CameraParameters p;
  p.principal_u = glm::dot(a1, a3);
  p.principal_v = glm::dot(a2, a3);
  p.skew = std::atan2(glm::length(glm::cross(n1, n2)), -glm::dot(n1, n2));
  const double sine = std::sin(p.skew);
  p.focal_length = glm::length(n2) * sine;  // f in pixel heights, because δv = 1
  p.delta_u = p.focal_length / (glm::length(n1) * sine);
  const glm::dvec3 r1 = n2 / glm::length(n2), r2 = glm::cross(a3, r1);
  SetAngles(glm::transpose(glm::dmat3(r1, r2, a3)), p);
  // Solve K t = (last column of the normalised H) for t.
  const double fx = p.focal_length / p.delta_u, fy = p.focal_length / sine;
  p.t.z = matrix.h[2][3] / scale;
  p.t.y = (matrix.h[1][3] / scale - p.principal_v * p.t.z) / fy;
  p.t.x = (matrix.h[0][3] / scale - p.principal_u * p.t.z + fx * std::cos(p.skew) / sine * p.t.y) / fx;
  return p;
}

Camera ToCamera(const CameraParameters& p, int width, int height) {
  Camera camera;
  const double fx = p.focal_length / p.delta_u, sine = std::sin(p.skew);
  camera.intrinsics = {.width = width,
                       .height = height,
                       .fx = fx,
                       .fy = p.focal_length / (p.delta_v * sine),
                       .cx = p.principal_u,
                       .cy = p.principal_v,
                       .skew = -fx * std::cos(p.skew) / sine};
  camera.R_CW = RotationXyz({p.omega, p.phi, p.kappa});
  camera.p_WC = -(glm::transpose(camera.R_CW) * p.t);
  return camera;
}

CameraParameters ParametersIn(const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  CameraParameters p;
  p.principal_u = in.cx;
  p.principal_v = in.cy;
  p.skew = std::atan2(in.fx, -in.skew);
  p.focal_length = in.fy * std::sin(p.skew);
  p.delta_u = p.focal_length / in.fx;
  SetAngles(camera.R_CW, p);
  p.t = -(camera.R_CW * camera.p_WC);
  return p;
}

}  // namespace etude

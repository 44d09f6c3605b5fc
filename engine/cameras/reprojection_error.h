#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <type_traits>

#include "engine/cameras/angle_axis.h"
#include "engine/cameras/camera.h"

namespace etude {

/// The intrinsics of a camera, in the order of the parameter block.
enum Intrinsic { kFx, kFy, kCx, kCy, kSkew, kK1, kK2, kP1, kP2, kK3, kIntrinsicsCount };

/// Distorts a ray by any lens. T is double or Ceres's Jet; for a Jet, the derivatives of `Distort` are computed by
/// central differences.
template <typename T>
std::array<T, 2> DistortByAny(const Distortion& lens, const T& x, const T& y) {
  if constexpr (std::is_same_v<T, double>) {
    const glm::dvec2 shown = Distort(lens, {x, y});
    return {shown.x, shown.y};
  } else {
    constexpr double kStep = 1e-6;
    const glm::dvec2 ray(x.a, y.a), shown = Distort(lens, ray);
    const auto slope = [&](const glm::dvec2& step) {
      return (Distort(lens, ray + step) - Distort(lens, ray - step)) / (2 * kStep);
    };
    const glm::dvec2 by_x = slope({kStep, 0}), by_y = slope({0, kStep});
    std::array<T, 2> distorted;
    for (int i = 0; i < 2; ++i) {
      distorted[i].a = shown[i];
      distorted[i].v = by_x[i] * x.v + by_y[i] * y.v;
    }
    return distorted;
  }
}

/// The reprojection error of a point. The five-coefficient distortion of camera.h is repeated here, because Ceres
/// differentiates it; any other lens is held fixed.
struct ReprojectionError {
  glm::dvec3 p_TQ;
  glm::dvec2 pixel;
  std::optional<Distortion> fixed_lens;

  template <typename T>
  bool operator()(const T* intrinsics, const T* camera, const T* target, T* residual) const {
    // Transform the point from the target to the world, then to the camera.
    std::array<T, 3> in_world = RotateByAngleAxis(target, std::array<T, 3>{T(p_TQ.x), T(p_TQ.y), T(p_TQ.z)});
    for (int i = 0; i < 3; ++i) in_world[i] += target[3 + i];
    std::array<T, 3> in_camera = RotateByAngleAxis(camera, in_world);
    for (int i = 0; i < 3; ++i) in_camera[i] += camera[3 + i];
    if (!(in_camera[2] > T(1e-9))) return false;
    // Apply the perspective division, the distortion and the intrinsics.
    const T x = in_camera[0] / in_camera[2], y = in_camera[1] / in_camera[2];
    const T r2 = x * x + y * y;
    const T gain = 1.0 + r2 * (intrinsics[kK1] + r2 * (intrinsics[kK2] + r2 * intrinsics[kK3]));
    T xd = x * gain + 2.0 * intrinsics[kP1] * x * y + intrinsics[kP2] * (r2 + 2.0 * x * x);
    T yd = y * gain + intrinsics[kP1] * (r2 + 2.0 * y * y) + 2.0 * intrinsics[kP2] * x * y;
    if (fixed_lens) {
      const auto distorted = DistortByAny(*fixed_lens, x, y);
      xd = distorted[0];
      yd = distorted[1];
    }
    residual[0] = intrinsics[kFx] * xd + intrinsics[kSkew] * yd + intrinsics[kCx] - pixel.x;
    residual[1] = intrinsics[kFy] * yd + intrinsics[kCy] - pixel.y;
    return true;
  }
};

}  // namespace etude

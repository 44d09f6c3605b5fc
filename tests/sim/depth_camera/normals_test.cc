#include "sim/depth_camera/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

Camera ACamera(const Distortion& distortion) {
  Camera camera =
      LookAt({.width = 160, .height = 120, .fx = 150, .fy = 150, .cx = 80, .cy = 60}, {1, 1.5, 4}, {0, 1, 0});
  camera.distortion = distortion;
  return camera;
}

/// Returns a depth image. `distance(ray)` is the t for which the camera's centre + t · ray lies on the surface; rays
/// have z = 1 in the camera's frame, so t is the depth.
template <typename Distance>
DepthImage DepthsOf(const Camera& camera, Distance distance) {
  DepthImage depth(160, 120);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const glm::dvec2 pixel = *UndistortPixel(camera, {x + 0.5, y + 0.5});
      const glm::dvec3 ray_C((pixel.x - 80) / 150, (pixel.y - 60) / 150, 1);
      depth.At(x, y) = static_cast<float>(distance(glm::transpose(camera.R_CW) * ray_C));
    }
  }
  return depth;
}

TEST(Normals, OfAPlaneAreItsOwn) {
  for (const Distortion& distortion : {Distortion{}, Distortion{.k1 = -0.2, .p1 = 0.003}}) {
    const Camera camera = ACamera(distortion);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 0.9));
    const auto to_plane = [&](const glm::dvec3& ray) { return -glm::dot(camera.p_WC, normal) / glm::dot(ray, normal); };
    const NormalImage found = NormalsOf(DepthsOf(camera, to_plane), camera);
    for (const glm::vec3& n : found.pixels) ASSERT_GT(glm::dot(glm::dvec3(n), normal), std::cos(2e-3));
  }
}

TEST(Normals, OfASpherePointAwayFromItsMiddle) {
  const Camera camera = ACamera({});
  const glm::dvec3 middle(0, 1, 0);
  const auto to_sphere = [&](const glm::dvec3& ray) -> double {
    const glm::dvec3 to_eye = camera.p_WC - middle;
    const double a = glm::dot(ray, ray), b = glm::dot(ray, to_eye), c = glm::dot(to_eye, to_eye) - 1;
    const double root = b * b - a * c;
    return root < 0 ? kNothing : (-b - std::sqrt(root)) / a;
  };
  const DepthImage depth = DepthsOf(camera, to_sphere);
  const NormalImage found = NormalsOf(depth, camera);
  int checked = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (!std::isfinite(depth.At(x, y))) {
        ASSERT_EQ(found.At(x, y), glm::vec3(0));
        continue;
      }
      const glm::dvec3 ray_C((x + 0.5 - 80) / 150, (y + 0.5 - 60) / 150, 1);
      const glm::dvec3 out =
          camera.p_WC + static_cast<double>(depth.At(x, y)) * (glm::transpose(camera.R_CW) * ray_C) - middle;
      const glm::dvec3 ray = glm::normalize(glm::transpose(camera.R_CW) * ray_C);
      if (glm::dot(out, ray) > -0.5) continue;  // at grazing angles neighbours are far apart
      ++checked;
      EXPECT_GT(glm::dot(glm::dvec3(found.At(x, y)), out), std::cos(0.05));
    }
  }
  EXPECT_GT(checked, 1000);
}

}  // namespace
}  // namespace etude

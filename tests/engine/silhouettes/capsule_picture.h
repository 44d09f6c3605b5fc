#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "engine/kinematics/tree.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// A value for one angle of a joint.
struct Bend {
  int joint, axis;
  double degrees;
};

/// Returns the standing state of the body with these angles changed.
inline TreeState Bent(const SilhouetteBody& body, const std::vector<Bend>& bends) {
  TreeState state = StandingState(body.tree);
  for (std::size_t i = 0; i < state.angles.size(); ++i) state.angles[i] = body.habits[i].angle;
  for (const auto& [joint, axis, degrees] : bends) {
    state.angles[body.tree.joints[joint].first_dof + axis] = Radians(degrees);
  }
  return state;
}

struct SeenBall {
  glm::dvec3 centre;  ///< from the camera, in the world's axes, metres
  double radius;

  bool IsMetBy(const glm::dvec3& ray) const {
    const double along = glm::dot(centre, ray);
    return along > 0 && glm::dot(centre, centre) - along * along < radius * radius;
  }
};

/// Ray casts the mask of capsules in a pinhole camera: a pixel is set if the ray through its centre passes some
/// capsule's axis at less than its radius. Only the body's description is shared with the tested code.
inline Mask RayCast(const SilhouetteBody& body, const TreeState& state, const Camera& camera, double thickness = 1) {
  const TreeFrames frames = ComputeFrames(body.tree, state);
  struct Limb {
    SeenBall around;                 ///< bounds the whole limb: a ray that misses it misses the limb
    std::array<SeenBall, 13> balls;  ///< balls along the axis
  };
  std::vector<Limb> limbs;
  for (const FleshCapsule& flesh : body.flesh) {
    const auto place = [&](const TreePoint& point) {
      return frames.joints[point.joint].position + frames.joints[point.joint].axes * point.p_LQ - camera.p_WC;
    };
    const glm::dvec3 a = place(flesh.a), b = place(flesh.b);
    Limb& limb = limbs.emplace_back();
    for (std::size_t i = 0; i < limb.balls.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(limb.balls.size() - 1);
      limb.balls[i] = {a + t * (b - a), thickness * (flesh.radius_a + t * (flesh.radius_b - flesh.radius_a))};
    }
    limb.around = {(a + b) / 2.0, glm::distance(a, b) / 2 + thickness * std::max(flesh.radius_a, flesh.radius_b)};
  }
  Mask mask(camera.intrinsics.width, camera.intrinsics.height);
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3 R_WC = glm::transpose(camera.R_CW);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const glm::dvec3 ray = glm::normalize(R_WC * glm::dvec3((x + 0.5 - in.cx) / in.fx, (y + 0.5 - in.cy) / in.fy, 1));
      mask.At(x, y) = std::ranges::any_of(limbs, [&](const Limb& limb) {
        return limb.around.IsMetBy(ray) &&
               std::ranges::any_of(limb.balls, [&](const SeenBall& ball) { return ball.IsMetBy(ray); });
      });
    }
  }
  return mask;
}

/// Returns cameras around the middle of the stage, 3.8 m away, at different heights.
inline std::vector<Camera> CamerasAround(const std::vector<double>& angles_deg) {
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < angles_deg.size(); ++i) {
    const double angle = angles_deg[i] * 3.14159265358979 / 180;
    const glm::dvec3 p_WC(3.8 * std::sin(angle), i % 2 == 0 ? 1.0 : 2.2, 3.8 * std::cos(angle));
    cameras.push_back(
        LookAt({.width = 240, .height = 180, .fx = 225, .fy = 225, .cx = 120, .cy = 90}, p_WC, glm::dvec3(0, 0.95, 0)));
  }
  return cameras;
}

}  // namespace etude

#pragma once

#include <etude/base.h>

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace etude::engine {

/// The twenty joints of the canonical body. "Left" is the person's own: with the person facing +Z, left is +X.
enum class Role {
  kHipCentre,
  kSpine,
  kShoulderCentre,
  kHead,
  kLeftShoulder,
  kLeftElbow,
  kLeftWrist,
  kLeftHand,  ///< finger tips
  kRightShoulder,
  kRightElbow,
  kRightWrist,
  kRightHand,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kLeftFoot,  ///< toe tips
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kRightFoot,
};
inline constexpr std::size_t kRoleCount = 20;

/// Returns "hip_centre", "left_shoulder", …
ETUDE_API std::string_view RoleName(Role role);

/// One frame: where the twenty joints are in the world.
struct Pose {
  std::array<glm::dvec3, kRoleCount> joints{};

  glm::dvec3& operator[](Role role) { return joints[static_cast<std::size_t>(role)]; }
  const glm::dvec3& operator[](Role role) const { return joints[static_cast<std::size_t>(role)]; }
};

/// Frames at a fixed rate.
struct Motion {
  double rate_hz = 30;
  std::vector<Pose> poses;
};

/// Reads a motion file, told by its content (BVH, AMASS .npz, C3D, TRC), as the twenty joints: at `rate_hz`, metres,
/// Y up, feet on the floor. Joints are found by their names, unit and up axis by the body's size and build. `file` is
/// what complaints call it. Throws BadInput for all else, for bodies that lack limbs, and for markers of several
/// people.
ETUDE_API Motion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz = 30);

}  // namespace etude::engine

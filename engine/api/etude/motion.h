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
  /// For a motion read from a file: what was found, and every change of what the file holds (unit, axis, floor, rate,
  /// composed joints), each for people.
  std::vector<std::string> changes = {};
};

/// What a user tells about a motion file.
struct ReadingOptions {
  bool keep_floor = false;         ///< leave the body at the height that the file says
  char up = 0;                     ///< 'y' or 'z' overrules all other evidence; 0: by the file, its format, posture
  double metres_per_unit = 0;      ///< 0: the file's own, or found by the stature
  std::string marker_set = "";     ///< of a file of markers, such as "opencap"; "": the best it holds
};

/// Reads a motion file, told by its content (BVH, AMASS and Etude's own .npz, C3D, TRC, Etude's own CSV, Motive's CSV), as
/// the twenty joints: at `rate_hz`, metres, Y up, feet on the floor unless they shall stay. Joints are found by their
/// names, the unit by the body's size; `changes` says what else was changed. `file` is what complaints call it. Throws
/// BadInput for all else, for bodies that lack limbs, and for markers of several people.
ETUDE_API Motion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz = 30,
                            const ReadingOptions& options = {});

}  // namespace etude::engine

#pragma once

#include <etude/base.h>

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace etude::engine {

/// The twenty joints of the canonical body. "Left" is the person's own left: if the person faces +Z, left is +X.
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

/// One frame: the positions of the twenty joints in the world.
struct Pose {
  std::array<glm::dvec3, kRoleCount> joints{};

  glm::dvec3& operator[](Role role) { return joints[static_cast<std::size_t>(role)]; }
  const glm::dvec3& operator[](Role role) const { return joints[static_cast<std::size_t>(role)]; }
};

/// Frames at a fixed rate.
struct Motion {
  double rate_hz = 30;
  std::vector<Pose> poses;
  /// For a motion from a file, as sentences for users: what was found, and every change that was made (unit, axis,
  /// floor, rate, composed joints).
  std::vector<std::string> changes = {};
};

/// What the user states about a motion file.
struct ReadingOptions {
  bool keep_floor = false;         ///< keep the body at its height in the file
  /// 'y' or 'z' overrules all other evidence; 0: decided by the file, its format and the body's posture.
  char up = 0;
  double metres_per_unit = 0;      ///< 0: the file's own unit, or one derived from the body's height
  std::string marker_set = "";     ///< for marker files: the marker set, such as "opencap"; "": the best one
};

/// Reads a motion file as the twenty joints: at `rate_hz`, in metres, Y up, with the feet on the floor unless
/// `keep_floor` is set. The content decides the format: BVH, AMASS's and Etude's own .npz, C3D, TRC, Etude's own CSV,
/// Motive's CSV. Names identify the joints, the body's size gives the unit; `changes` lists all changes. `file` is its
/// name in complaints. Throws BadInput for other formats, for bodies without some limbs, and for markers of several
/// people.
ETUDE_API Motion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz = 30,
                            const ReadingOptions& options = {});

}  // namespace etude::engine

#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The columns of RawMotion::contacts.
constexpr std::size_t kFootContacts = 4;

/// A motion as its file has it: all joints, the file's own rate and floor. Only its unit and its up axis are converted,
/// to metres and Y up.
struct RawMotion {
  std::string name;  ///< the reference it was read from
  double rate_hz = 30;
  std::optional<double> start_s = {};  ///< the first frame's time by the file's own clock, if it states one
  std::vector<std::string> joints;  ///< names
  /// The joints that the file does not name: BVH's End Sites, and the hip centre that its reader adds.
  std::vector<int> added;
  std::vector<int> parents;         ///< of the joints; −1: a root; empty: the file has points, not a skeleton
  std::array<int, kRoleCount> roles = NoRoles();  ///< the joint that plays each role, by Index(role); −1: none
  std::vector<glm::dvec3> positions;              ///< frames × joints; NaN: not seen
  std::vector<glm::dquat> rotations;  ///< global rotations, frames × joints; empty: the file has points, not rotations
  /// The file's rest pose: each joint's position and global rotation; both are empty if `rotations` is.
  std::vector<glm::dvec3> rest_positions;
  std::vector<glm::dquat> rest_rotations;
  /// What the file says of contacts with the floor, frames × 4: left heel, left toes, right heel, right toes; empty: it
  /// says nothing.
  std::vector<bool> contacts;
  std::vector<std::string> notes;  ///< what its reader converted or guessed, a sentence each

  std::size_t FrameCount() const { return joints.empty() ? 0 : positions.size() / joints.size(); }
  const glm::dvec3& At(std::size_t frame, std::size_t joint) const { return positions[frame * joints.size() + joint]; }
  /// Returns the joint that plays a role of this name, else the joint of that name (case is ignored), else −1.
  int Find(std::string_view joint) const;

  static constexpr std::array<int, kRoleCount> NoRoles() {
    std::array<int, kRoleCount> none{};
    none.fill(-1);
    return none;
  }
};

/// The name of the joint that is added where no joint of a file plays the hip centre.
constexpr const char* kMidwayHips = "(midway between the hips)";

/// Appends a joint midway between the hips, which then plays the hip centre. It gets the orientation of the joint that
/// carries the left hip. Does nothing without both hips.
void AddMidwayHips(RawMotion& motion);
/// Returns true if a joint of the file itself plays the hip centre.
bool HasOwnRoot(const RawMotion& motion);

/// A position that was not seen.
glm::dvec3 NotSeen();
inline bool IsSeen(const glm::dvec3& position) { return position.x == position.x; }

/// Returns `count` frames of a motion at `rate_hz`, the first `start_s` after its first frame; times before the first
/// frame or after the last are not seen. A time within a millionth of a frame of one of the motion's frames takes that
/// frame unchanged. Between frames, positions are interpolated linearly and rotations by slerp, and contacts are those
/// of the nearer frame; a joint that one of the two frames does not show is not seen. No filter is applied, not even
/// where frames are left out.
RawMotion Sampled(const RawMotion& motion, double rate_hz, double start_s, std::size_t count);

}  // namespace etude

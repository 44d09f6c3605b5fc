#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The number of columns of RawMotion::contacts.
constexpr std::size_t kFootContacts = 4;

/// A motion as its file has it: all joints, the file's own rate and floor. Only unit and axes are converted, to metres
/// and Y up.
struct RawMotion {
  std::string name;  ///< the name under which the file was requested
  double rate_hz = 30;
  std::optional<double> start_s = {};  ///< the first frame's time by the file's own clock, if the file states one
  std::vector<std::string> joints;  ///< names of the joints
  /// Indices of joints that the file does not name: BVH's End Sites, and the hip centre that the reader adds.
  std::vector<int> added;
  std::vector<int> parents;         ///< parent of each joint; −1: a root; empty: the file has points, not a skeleton
  std::array<int, kRoleCount> roles = NoRoles();  ///< the joint that plays each role, by Index(role); −1: none
  std::vector<glm::dvec3> positions;              ///< frames × joints; NaN: not seen
  std::vector<glm::dquat> rotations;  ///< global rotations, frames × joints; empty: the file has points, not rotations
  /// The file's rest pose: each joint's position and global rotation; the two lists are empty if `rotations` is.
  std::vector<glm::dvec3> rest_positions;
  std::vector<glm::dquat> rest_rotations;
  /// The file's labels of contacts with the floor, frames × 4: left heel, left toes, right heel, right toes. Empty if
  /// the file has no such labels.
  std::vector<bool> contacts;
  std::vector<std::string> notes;  ///< one sentence for each conversion or guess of the reader
  std::vector<std::string> doubts = {};  ///< the entries of `notes` that state what looks wrong in the file
  bool is_of_camera = false;       ///< true: rotated from a camera's frame, so height 0 is not that of a floor

  /// Appends `text` to `doubts` and, if it is new, to `notes`. Does nothing if `text` is empty or a doubt already.
  void Doubt(const std::string& text);

  std::size_t FrameCount() const { return joints.empty() ? 0 : positions.size() / joints.size(); }
  const glm::dvec3& At(std::size_t frame, std::size_t joint) const { return positions[frame * joints.size() + joint]; }
  /// Returns the index of the joint that plays the role named `joint`; if no role has that name, of the joint with that
  /// name (case is ignored); otherwise −1.
  int Find(std::string_view joint) const;

  static constexpr std::array<int, kRoleCount> NoRoles() {
    std::array<int, kRoleCount> none{};
    none.fill(-1);
    return none;
  }
};

/// The name of the joint that AddMidwayHips adds.
constexpr const char* kMidwayHips = "(midway between the hips)";

/// Appends a joint midway between the hips, which then plays the hip centre. The new joint gets the orientation of the
/// left hip's parent. Does nothing if a hip is missing.
void AddMidwayHips(RawMotion& motion);
/// Returns true if a joint of the file itself plays the hip centre.
bool HasOwnRoot(const RawMotion& motion);

/// Returns the position that stands for "not seen": three NaNs.
glm::dvec3 NotSeen();
inline bool IsSeen(const glm::dvec3& position) { return position.x == position.x; }

/// The interpolation of positions between two frames.
enum class Inbetween {
  kLine,
  kCubic,  ///< a Catmull-Rom cubic through four frames; at an end or a gap, a parabola through three; else a line
};

/// Returns a motion at the given times, which are counted in its frames: 1.5 lies midway between the second and the
/// third frame. A time within a millionth of a frame of an original frame returns that frame unchanged. Between frames,
/// rotations are interpolated by slerp, and contacts are taken from the nearer frame. A joint is not seen if one of the
/// two frames does not show it, or if the time is before the first frame or after the last. No low-pass filter is
/// applied, not even at lower rates. `rate_hz` is the result's rate.
RawMotion AtFrames(const RawMotion& motion, std::span<const double> frames, double rate_hz, Inbetween inbetween);

/// Returns `count` frames of a motion, sampled at `rate_hz` from `start_s` after its first frame (AtFrames, kLine).
RawMotion Sampled(const RawMotion& motion, double rate_hz, double start_s, std::size_t count);

}  // namespace etude

#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// The twenty joints of the canonical body: Kinect v1's, and the meeting point of both papers and of
/// every file format. Parents come before children. "Left" is the person's own left: with the person
/// facing +Z and Y up, left is +X.
enum class Role {
  kHipCentre,  ///< midway between the hips (paper B's navel)
  kSpine,
  kShoulderCentre,  ///< base of the neck
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

constexpr std::size_t kRoleCount = 20;

constexpr std::size_t Index(Role role) { return static_cast<std::size_t>(role); }

/// Lists all roles in order.
std::span<const Role, kRoleCount> AllRoles();
/// Returns "hip_centre", "left_shoulder", …: the names used in every file Etude reads or writes.
std::string_view RoleName(Role role);
std::optional<Role> FindRole(std::string_view name);
/// Returns the joint that it hangs from; the hip centre has none.
std::optional<Role> ParentOf(Role role);
/// A side of the body, the person's own.
enum class Side { kLeft, kRight };

/// Returns the same joint of the other side; a joint of the middle itself.
Role Mirrored(Role role);

/// One frame: where the twenty joints are, metres, in the world (right-handed, Y up).
struct BodyPose {
  std::array<glm::dvec3, kRoleCount> joints{};

  glm::dvec3& operator[](Role role) { return joints[Index(role)]; }
  const glm::dvec3& operator[](Role role) const { return joints[Index(role)]; }
};

/// The rate at which all motions are judged (docs/reference/metrics.md).
constexpr double kJudgedRateHz = 30.0;

/// A sequence of frames at a fixed rate: what sensors see, pipelines produce and metrics judge.
struct BodyMotion {
  double rate_hz = kJudgedRateHz;
  std::vector<BodyPose> poses;

  double DurationSeconds() const { return static_cast<double>(poses.size()) / rate_hz; }
};

/// A limb: the straight line between a joint and its parent.
struct Bone {
  Role parent;
  Role child;
};
/// The nineteen limbs, in the order of their child's role.
std::span<const Bone, kRoleCount - 1> AllBones();

double BoneLength(const BodyPose& pose, const Bone& bone);

/// A rigid move on the floor: turn about the vertical axis, then shift. What may be done to a clip
/// without changing its dance.
struct FloorMove {
  double yaw = 0;  ///< radians about +Y
  double x = 0;    ///< metres
  double z = 0;

  glm::dvec3 Apply(const glm::dvec3& point) const;
  BodyPose Apply(const BodyPose& pose) const;
};

/// The unit horizontal direction the body faces: normal to hips and shoulders, +Z at rest. Falls back
/// to +Z for a degenerate pose (body lying along the vertical plane).
glm::dvec3 Facing(const BodyPose& pose);
/// The angle of `Facing` about +Y from +Z, in (−π, π].
double Heading(const BodyPose& pose);
/// The move that puts `pose` at the origin of the floor (hip centre above it), facing +Z.
FloorMove ToOrigin(const BodyPose& pose);

/// Returns the move on the floor (yaw, x, z) that lays `pose` onto `onto`: same heading, hip centres above each other.
/// Heights and limbs stay as they are.
FloorMove AlignOnFloor(const BodyPose& pose, const BodyPose& onto);

/// Returns the distance of two poses once facing and place on the floor are taken away: that of the worst joint after
/// `AlignOnFloor`, metres.
double PoseGap(const BodyPose& a, const BodyPose& b);

}  // namespace etude

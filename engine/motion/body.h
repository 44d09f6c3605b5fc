#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] etude {

/// The twenty joints of the canonical body: the joints of Kinect v1. The data of both papers and of all file formats
/// are mapped to these joints. Parents come before children. "Left" is the person's own left: if the person faces +Z
/// and Y is up, left is +X.
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
/// Returns "hip_centre", "left_shoulder", …: the names used in every file that Etude reads or writes.
std::string_view RoleName(Role role);
std::optional<Role> FindRole(std::string_view name);
/// Returns the joint's parent; the hip centre has none.
std::optional<Role> ParentOf(Role role);
/// A side of the body: the person's own left or right.
enum class Side { kLeft, kRight };

/// Returns the same joint on the other side; a joint on the body's middle line is returned unchanged.
Role Mirrored(Role role);

/// One frame: the positions of the twenty joints in the world, metres (right-handed, Y up).
struct BodyPose {
  std::array<glm::dvec3, kRoleCount> joints{};

  glm::dvec3& operator[](Role role) { return joints[Index(role)]; }
  const glm::dvec3& operator[](Role role) const { return joints[Index(role)]; }
};

/// The frame rate at which all motions are evaluated (docs/reference/metrics.md).
constexpr double kJudgedRateHz = 30.0;

/// A sequence of frames at a constant rate.
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
/// Lists the nineteen limbs, in the order of the role at each limb's outer end.
std::span<const Bone, kRoleCount - 1> AllBones();
/// Lists the two long bones of each arm and leg, without hands and feet.
std::span<const Bone, 8> ArmAndLegBones();

double BoneLength(const BodyPose& pose, const Bone& bone);

/// A rigid motion on the floor: a rotation about the vertical axis, then a translation. It changes a body's heading and
/// its position on the floor, but not its pose.
struct FloorMove {
  double yaw = 0;  ///< radians about +Y
  double x = 0;    ///< metres
  double z = 0;

  glm::dvec3 Apply(const glm::dvec3& point) const;
  BodyPose Apply(const BodyPose& pose) const;
};

/// Returns the unit horizontal direction that the body faces: perpendicular to the sum of the vectors from right to
/// left hip and from right to left shoulder, +Z at rest. Returns +Z for a degenerate pose (the sum is vertical or
/// zero).
glm::dvec3 Facing(const BodyPose& pose);
/// Returns the heading: the angle of `Facing` about +Y, measured from +Z, in (−π, π].
double Heading(const BodyPose& pose);
/// Returns the move that puts `pose` at the origin of the floor, with the hip centre above it, facing +Z.
FloorMove ToOrigin(const BodyPose& pose);

/// Returns the move on the floor (yaw, x, z) that aligns `pose` with `onto`: equal headings, and hip centres above each
/// other. Heights and limbs do not change.
FloorMove AlignOnFloor(const BodyPose& pose, const BodyPose& onto);

/// Returns the largest distance between the same joints of two poses, metres, after `AlignOnFloor`. The poses' headings
/// and positions on the floor therefore have no effect.
double PoseGap(const BodyPose& a, const BodyPose& b);

}  // namespace etude

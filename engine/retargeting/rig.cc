#include "engine/retargeting/rig.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/limb_finder.h"

namespace etude {
namespace {

/// Sines below this are rounding errors.
constexpr double kDegenerate = 1e-9;

using enum Role;

/// For each limb, in the order of kLimbs, a direction in the middle of the upper bone's range, in the axes of the chest
/// (arms) or of the hips (legs). The joint positions of a straight limb do not determine its twist, so the twist is
/// defined as follows: the limb hangs down, is rotated to this middle direction, and from there to its direction in the
/// pose, both times by the shortest rotation. This twist is discontinuous only where a limb points opposite to its
/// middle direction. No limb can point there: inward through the chest, or backward through the hips.
constexpr std::array<glm::dvec3, kLimbs.size()> kMidDirections = {
    {{0.71, 0, 0.71}, {-0.71, 0, 0.71}, {0, -0.87, 0.5}, {0, -0.87, 0.5}}};

/// Bend angles. Below kStraight, the plane in which an elbow or knee bends is mostly noise; above kBent, this plane
/// alone determines the twist.
constexpr double kStraight = Radians(10);
constexpr double kBent = Radians(60);

glm::dvec3 VectorBetween(const BodyPose& pose, Role from, Role to) { return pose[to] - pose[from]; }

/// The orientations, in the world, of the body parts that depend on several joints.
struct BodyAxes {
  glm::dquat hips, chest;                       ///< X to the left, Y up, Z forward
  std::array<glm::dquat, kLimbs.size()> upper;  ///< X along the upper bone, Y near the hinge axis of elbow or knee
};

glm::dquat HipsOf(const BodyPose& pose) {
  return Orientation(VectorBetween(pose, kRightHip, kLeftHip), VectorBetween(pose, kHipCentre, kSpine));
}

glm::dquat ChestOf(const BodyPose& pose) {
  // The chest's Y axis follows the trunk exactly; the X axis follows the shoulders as far as possible at a right angle
  // to Y, because shoulders rise with the arms. In `HipsOf` the X axis is exact: hips do not rise with the legs.
  const glm::dquat up_first =
      Orientation(VectorBetween(pose, kSpine, kShoulderCentre), VectorBetween(pose, kLeftShoulder, kRightShoulder));
  return up_first * glm::angleAxis(-kPi / 2, glm::dvec3(0, 0, 1));
}

/// Blends `axis` with the normal of two bones; the normal gets the weight `shown`.
glm::dvec3 Towards(const glm::dvec3& axis, const glm::dvec3& normal, double shown) {
  const double length = glm::length(normal);
  return length > 0 && shown > 0 ? glm::mix(axis, normal / length, shown) : axis;
}

glm::dquat UpperOf(const Limb& limb, const glm::dvec3& middle, const glm::dquat& trunk, const BodyPose& pose) {
  const auto [root, hinge, end] = limb.roles;
  const glm::dvec3 upper = VectorBetween(pose, root, hinge), lower = VectorBetween(pose, hinge, end),
                   tip = VectorBetween(pose, end, limb.tip);
  // The cross product of upper and lower bone points to the right for a bent arm, and to the left for a bent leg.
  const glm::dvec3 hanging_axis(limb.is_arm ? -1 : 1, 0, 0);
  const glm::dquat swing = ShortestTurn(trunk * middle, upper) * trunk * ShortestTurn(glm::dvec3(0, -1, 0), middle);
  glm::dvec3 axis = swing * hanging_axis;
  // A knee faces in the direction of the toes, unless the toes point along the leg. For elbows there is no such rule,
  // because hands rotate independently.
  constexpr double kPointed = Radians(20), kAcross = Radians(50);
  if (!limb.is_arm) {
    axis = Towards(axis, glm::cross(tip, lower), Smoothstep(kPointed, kAcross, AngleBetween(lower, tip)));
  }
  axis = Towards(axis, glm::cross(upper, lower), Smoothstep(kStraight, kBent, AngleBetween(upper, lower)));
  return Orientation(upper, axis);
}

BodyAxes AxesOf(const BodyPose& pose) {
  BodyAxes stand{.hips = HipsOf(pose), .chest = ChestOf(pose), .upper = {}};
  for (std::size_t i = 0; i < kLimbs.size(); ++i) {
    stand.upper[i] = UpperOf(kLimbs[i], kMidDirections[i], kLimbs[i].is_arm ? stand.chest : stand.hips, pose);
  }
  return stand;
}

/// Returns each joint's rotation in the world relative to the rest pose.
std::array<glm::dquat, kRoleCount> Turns(const BodyPose& rest, const BodyPose& pose) {
  const BodyAxes from = AxesOf(rest), to = AxesOf(pose);
  std::array<glm::dquat, kRoleCount> turns;
  // Apply the parent's rotation, then the shortest rotation to the limb's direction.
  const auto follow = [&](const glm::dquat& above, Role begin, Role end) {
    return ShortestTurn(above * VectorBetween(rest, begin, end), VectorBetween(pose, begin, end)) * above;
  };
  turns[Index(kHipCentre)] = to.hips * glm::conjugate(from.hips);
  const glm::dquat chest = to.chest * glm::conjugate(from.chest);
  turns[Index(kSpine)] = turns[Index(kShoulderCentre)] = chest;
  // No joint determines the heading of the head, so the head turns with the chest.
  turns[Index(kHead)] = follow(chest, kShoulderCentre, kHead);
  for (std::size_t i = 0; i < kLimbs.size(); ++i) {
    const auto [root, hinge, end] = kLimbs[i].roles;
    const Role tip = kLimbs[i].tip;
    const glm::dquat upper = to.upper[i] * glm::conjugate(from.upper[i]);
    const glm::dquat lower = follow(upper, hinge, end);
    turns[Index(root)] = upper;
    turns[Index(hinge)] = lower;
    turns[Index(end)] = turns[Index(tip)] = follow(lower, end, tip);
  }
  return turns;
}

/// A rotation has two unit quaternions, q and −q. For each joint, chooses the quaternion nearer to the previous
/// frame's, because some programs interpolate the components.
void KeepSign(const LocalPose& before, LocalPose& frame) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (glm::dot(before[i].rotation, frame[i].rotation) < 0) frame[i].rotation = -frame[i].rotation;
  }
}

}  // namespace

glm::dquat ShortestTurn(const glm::dvec3& from, const glm::dvec3& to) {
  const double lengths = glm::length(from) * glm::length(to);
  if (!(lengths > 0)) return {1, 0, 0, 0};
  const glm::dvec3 across = glm::cross(from, to) / lengths;
  const double cosine = glm::dot(from, to) / lengths;
  const double sine = glm::length(across);
  if (sine > kDegenerate || cosine > 0) {
    const double half = 0.5 * std::atan2(sine, cosine);
    const glm::dvec3 axis = sine > 0 ? across / sine : glm::dvec3(0);
    return glm::normalize(glm::dquat(std::cos(half), std::sin(half) * axis));
  }
  const glm::dvec3 some = std::abs(from.x) < 0.5 * glm::length(from) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  return glm::angleAxis(kPi, glm::normalize(glm::cross(from, some)));
}

glm::dquat Orientation(const glm::dvec3& x, const glm::dvec3& y) {
  const glm::dvec3 z = glm::cross(x, y);
  const double sine = glm::length(z);
  if (!(sine > kDegenerate * glm::length(x) * glm::length(y)) || !(sine > 0)) {
    return ShortestTurn({1, 0, 0}, x);
  }
  const glm::dvec3 along = glm::normalize(x), out = z / sine;
  return glm::normalize(glm::quat_cast(glm::dmat3(along, glm::cross(out, along), out)));
}

LocalPose PoseRig(const BodyPose& pose, const BodyPose& rest) {
  const std::array<glm::dquat, kRoleCount> turns = Turns(rest, pose);
  LocalPose local(kRoleCount);
  for (const Role role : AllRoles()) {
    const std::optional<Role> parent = ParentOf(role);
    const glm::dquat back = parent ? glm::conjugate(turns[Index(*parent)]) : glm::dquat(1, 0, 0, 0);
    local[Index(role)] = {.translation = parent ? back * VectorBetween(pose, *parent, role) : pose[role],
                          .rotation = glm::normalize(back * turns[Index(role)])};
  }
  return local;
}

Clip RigClip(const BodyMotion& motion, const BodyPose& rest, std::string name) {
  Clip clip{.name = std::move(name), .skeleton = BodySkeleton(rest), .rate_hz = motion.rate_hz, .frames = {}};
  clip.frames.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) {
    LocalPose frame = PoseRig(pose, rest);
    if (!clip.frames.empty()) KeepSign(clip.frames.back(), frame);
    clip.frames.push_back(std::move(frame));
  }
  return clip;
}

}  // namespace etude

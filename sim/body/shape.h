#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The objects that a pixel or a ray can hit, with their numbers in label images: the parts of the performer's body and
/// everything else.
enum class Part : std::uint32_t {
  kBackground = 0,
  kShadow = 1,
  kTrunk = 2,
  kHead,
  kLeftUpperArm,
  kLeftForearm,
  kLeftHand,
  kRightUpperArm,
  kRightForearm,
  kRightHand,
  kLeftThigh,
  kLeftShank,
  kLeftFoot,
  kRightThigh,
  kRightShank,
  kRightFoot,
  kFurniture = 16,
  kClutter = 17,    ///< moving objects in the room: plants, balls, screens
  kBystander = 18,  ///< a second person, from head to foot
};
constexpr std::uint32_t kFirstBodyPart = 2;
constexpr std::uint32_t kPartCount = 16;

/// Returns true if the label is a part of the performer's body; truth masks contain exactly these.
constexpr bool IsPerformer(std::uint32_t label) {
  return label >= kFirstBodyPart && label <= static_cast<std::uint32_t>(Part::kRightFoot);
}

/// A cylinder with two half-spheres: every point within `radius` of the segment a–b, metres.
struct Capsule {
  Part part;
  glm::dvec3 a;
  glm::dvec3 b;
  double radius;
};

/// Returns the body's shape in a pose as capsules. The renderer, the depth sensor and occlusion all use this shape.
/// Radii scale with the body's own limb lengths.
std::vector<Capsule> BodyCapsules(const BodyPose& pose);

/// Returns the distance along the ray (`direction` is a unit vector) to the capsule's surface, or infinity if the ray
/// misses it. The distance is 0 if the ray starts inside.
double HitDistance(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction);

/// The distances from an eye at which the ray to a joint hits the body; infinity if it hits nothing.
struct JointSight {
  double skin;   ///< of the joint's own skin (the parts that end in it); at most the joint's own distance
  double other;  ///< of the nearest other part
};
/// Computes the distances along the ray from `eye` to the joint of `role`. `body` is `BodyCapsules(pose)`.
JointSight SightOf(const std::vector<Capsule>& body, const BodyPose& pose, Role role, const glm::dvec3& eye);

/// The minimum distance in front of a joint's skin at which another part hides it, metres. A part that touches the
/// joint, as a hand on the hip does, does not hide it.
constexpr double kHidingClearance = 0.02;

/// Returns true if a part other than those ending in `role` hides the joint from `eye`: it is at least kHidingClearance
/// in front of the skin there. `body` is `BodyCapsules(pose)`.
bool IsHidden(const std::vector<Capsule>& body, const BodyPose& pose, Role role, const glm::dvec3& eye);

/// An upright solid box, rotated about the vertical: a piece of furniture as rays and the renderer see it. Metres.
struct Cuboid {
  glm::dvec3 centre{0};
  glm::dvec3 half_size{0.5};  ///< along its own axes, each positive
  double heading = 0;         ///< radians: its own +Z points to (sin heading, 0, cos heading)
};

/// Returns the distance along the ray (`direction` is a unit vector) to the box's surface, or infinity if the ray
/// misses it. The distance is 0 if the ray starts inside.
double HitDistance(const Cuboid& box, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace etude

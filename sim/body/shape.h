#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The things that a pixel or a ray can meet, by their numbers in label images: the parts of the performer's body, and
/// what else is there.
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
  kClutter = 17,    ///< what moves in the room: plants, balls, screens
  kBystander = 18,  ///< a second person, from head to foot
};
constexpr std::uint32_t kFirstBodyPart = 2;
constexpr std::uint32_t kPartCount = 16;

/// Tells whether a number in a label image is a part of the performer's body, which truth masks hold.
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

/// Returns the flesh around a pose: the one shape that the renderer draws, the depth sensor measures and occlusion is
/// decided by. Radii scale with the body's own limb lengths.
std::vector<Capsule> BodyCapsules(const BodyPose& pose);

/// Returns the distance along the ray (unit direction) to the first surface met, or infinity. A ray that starts inside
/// the capsule meets it at 0.
double HitDistance(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction);

/// The distances from an eye at which a ray to a joint meets flesh; infinity where it meets nothing.
struct JointSight {
  double skin;   ///< the joint's own skin: of the parts that end in it, or the joint itself
  double other;  ///< the nearest of the other parts
};
/// Follows the ray from `eye` to the joint of `role`. `body` is `BodyCapsules(pose)`.
JointSight SightOf(const std::vector<Capsule>& body, const BodyPose& pose, Role role, const glm::dvec3& eye);

/// The least distance before a joint's skin at which flesh hides it, metres: what touches hides nothing, as a hand on
/// the hip.
constexpr double kHidingClearance = 0.02;

/// Tells whether a part other than those ending in `role` stands between `eye` and the joint: clearly before the skin
/// that the eye would see there. `body` is `BodyCapsules(pose)`.
bool IsHidden(const std::vector<Capsule>& body, const BodyPose& pose, Role role, const glm::dvec3& eye);

/// A solid box that stands upright, turned about the vertical: furniture, as far as rays and pictures need it. Metres.
struct Cuboid {
  glm::dvec3 centre{0};
  glm::dvec3 half_size{0.5};  ///< along its own axes, each positive
  double heading = 0;         ///< radians: its own +Z points to (sin heading, 0, cos heading)
};

/// Returns the distance along the ray (unit direction) to the box's surface, or infinity. A ray that starts inside
/// meets it at 0.
double HitDistance(const Cuboid& box, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace etude

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The objects that a pixel can show and a ray can hit, with their numbers in label images: the parts of the
/// performer's body, and all other objects.
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

/// Returns true if the label is a part of the performer's body. Truth masks contain exactly these labels.
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
/// Radii are proportional to the body's own limb lengths.
std::vector<Capsule> BodyCapsules(const BodyPose& pose);

/// Returns the distance along the ray to the capsule's surface, or infinity if the ray misses the capsule. `direction`
/// must be a unit vector. The distance is 0 if the ray starts inside.
double HitDistance(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction);

/// A ray runs from an eye to a joint. These are the distances from the eye to the points where the ray hits the body;
/// infinity if it does not hit the body.
struct JointSight {
  double skin;   ///< distance to the skin of the parts that contain the joint; at most the distance to the joint
  double other;  ///< distance to the nearest part that does not contain the joint
};
/// A sphere around a capsule, seen from an eye: the vector from the sphere's centre to the eye, and the squared length
/// of this vector minus the squared radius.
struct BoundingSphere {
  glm::dvec3 from;
  double outside;
};

/// A body in one pose, seen from one eye.
class BodySight {
 public:
  /// `pose` must outlive this object.
  BodySight(const BodyPose& pose, const glm::dvec3& eye);

  /// Computes the distances along the ray from the eye to the joint of `role`.
  JointSight Of(Role role) const;

 private:
  struct SeenCapsule {
    Capsule capsule;
    BoundingSphere sphere;
  };
  const BodyPose& pose_;
  const glm::dvec3 eye_;
  std::vector<SeenCapsule> capsules_;
};

/// Another part hides a joint only if it is at least this far in front of the joint's skin, metres. A part that touches
/// the joint, like a hand on the hip, therefore does not hide it.
constexpr double kHidingClearance = 0.02;

/// Returns true if a part that does not contain the joint of `role` hides this joint from `eye`: the part is more than
/// kHidingClearance in front of the joint's skin.
bool IsHidden(const BodyPose& pose, Role role, const glm::dvec3& eye);

/// An upright solid box, rotated about the vertical, metres. Sensors and the renderer use such boxes as furniture.
struct Cuboid {
  glm::dvec3 centre{0};
  glm::dvec3 half_size{0.5};  ///< half sizes along the box's own axes, each positive
  double heading = 0;         ///< radians: the box's +Z axis points to (sin heading, 0, cos heading)
};

/// Returns the distance along the ray to the box's surface, or infinity if the ray misses the box. `direction` must be
/// a unit vector. The distance is 0 if the ray starts inside.
double HitDistance(const Cuboid& box, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace etude

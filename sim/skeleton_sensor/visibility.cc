#include "sim/skeleton_sensor/visibility.h"

#include <algorithm>
#include <limits>

#include "sim/body/shape.h"

namespace etude {
namespace {

/// How far from `eye` the ray to `joint` meets furniture or the second person.
double NearestOccluder(const std::vector<Cuboid>& furniture, const std::vector<Capsule>& bystander,
                       const glm::dvec3& joint, const glm::dvec3& eye) {
  double nearest = std::numeric_limits<double>::infinity();
  const double distance = glm::distance(joint, eye);
  if (distance == 0) return nearest;
  const glm::dvec3 direction = (joint - eye) / distance;
  for (const Cuboid& box : furniture) nearest = std::min(nearest, HitDistance(box, eye, direction));
  for (const Capsule& capsule : bystander) nearest = std::min(nearest, HitDistance(capsule, eye, direction));
  return nearest;
}

}  // namespace

HiddenJoints FindHidden(const BodyPose& pose, std::size_t frame, const Occluders& occluders, const glm::dvec3& eye) {
  const std::vector<Capsule> flesh = BodyCapsules(pose);
  std::vector<Capsule> bystander;
  if (!occluders.bystander.empty()) {
    bystander = BodyCapsules(occluders.bystander[std::min(frame, occluders.bystander.size() - 1)]);
  }
  HiddenJoints hidden;
  for (const Role role : AllRoles()) {
    const JointSight sight = SightOf(flesh, pose, role, eye);
    const double other = std::min(sight.other, NearestOccluder(occluders.furniture, bystander, pose[role], eye));
    hidden[Index(role)] = other < sight.skin - kHidingClearance;
  }
  return hidden;
}

}  // namespace etude

#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// Returns the shortest rotation from the direction of `from` to the direction of `to`. For opposite directions, the
/// axis is any perpendicular to `from`; for a zero vector, the result is the identity.
glm::dquat ShortestTurn(const glm::dvec3& from, const glm::dvec3& to);

/// Returns the orientation whose X axis points along `x` and whose Y axis lies in the plane of `x` and `y`, on `y`'s
/// side. If `x` and `y` are parallel, or one of them is zero, returns the shortest rotation from X to `x`.
glm::dquat Orientation(const glm::dvec3& x, const glm::dvec3& y);

/// Returns the local transforms that bring BodySkeleton(rest) into `pose`. The orientations of hips and chest follow
/// from their joints. Each limb follows its parent and then takes the shortest rotation to its direction. A bent elbow
/// or knee instead rotates about its hinge axis; this axis determines the twist of the upper limb. A straight leg faces
/// in the direction of its toes; a straight arm is twisted like a hanging arm relative to the chest. The head faces in
/// the chest's direction. Joints are at the positions of `pose`: a change in the length of a limb appears in the
/// translations, not in a scale. The result is continuous over human poses.
LocalPose PoseRig(const BodyPose& pose, const BodyPose& rest);

/// Converts a motion to a clip of BodySkeleton(rest) whose joints rotate, as other programs expect in BVH and glTF.
Clip RigClip(const BodyMotion& motion, const BodyPose& rest, std::string name);

}  // namespace etude

#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The shortest rotation that brings `from`'s direction into `to`'s. Where there is none to choose (opposite
/// directions) it turns about an axis across `from`; no direction at all (a zero vector) turns nothing.
glm::dquat ShortestTurn(const glm::dvec3& from, const glm::dvec3& to);

/// The orientation whose X axis points along `x` and whose Y axis lies in the plane of `x` and `y`, on `y`'s side.
/// Where both are parallel or of no length, X is turned there by the shortest way.
glm::dquat Orientation(const glm::dvec3& x, const glm::dvec3& y);

/// The local transforms that bring BodySkeleton(rest) into `pose`: hips and chest as their joints show them, each limb
/// by the shortest way from where the one before has carried it, elbows and knees about their hinge: that gives the
/// upper limb's twist when they are bent; a straight leg looks where its toes do, a straight arm hangs on the chest.
/// The head faces as the chest does. Joints are where `pose` has them: a limb of another length than at rest shows in
/// the translations, nothing is scaled. Continuous where people move.
LocalPose PoseRig(const BodyPose& pose, const BodyPose& rest);

/// A motion as a clip of BodySkeleton(rest) with turning joints: what other programs expect of BVH and glTF.
Clip RigClip(const BodyMotion& motion, const BodyPose& rest, std::string name);

}  // namespace etude

#pragma once

#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// The axis of a file that points upwards.
enum class UpAxis { kY, kZ };

/// A point of a file in the world: Y up. Z-up files are turned about X, so that right-handed stays right-handed and
/// who faced −Y faces +Z.
glm::dvec3 Upright(const glm::dvec3& point, UpAxis up);
BodyPose Upright(BodyPose pose, UpAxis up);

/// The unit direction from the feet to the head; zero for a body of no size.
glm::dvec3 BodyAxis(const BodyPose& pose);
/// Returns the mean body axis over the poses, which is short where the body turns over.
glm::dvec3 MeanBodyAxis(std::span<const BodyPose> poses);

/// Finds the axis that a body stands along, from its rest pose and from what it does (ours). Both may mislead: some
/// files are folded up at rest, and people lie down. So: a rest pose that stands along Z counts, unless the body moves
/// standing along Y; one that does not stand leaves it to the motion; one that stands along Y while the body
/// moves along Z may be either of somebody who lies or of a Z-up file, and only who stands travels sideways. In doubt,
/// Y.
UpAxis FindUpAxis(const BodyPose& rest, std::span<const BodyPose> poses);

/// Checks that left is left throughout a motion (ours), and returns by how far its knees overstretch on the average,
/// radians; 0 unless by 3° and more. Refused, naming `file`: a left arm on the side of the right leg; feet that point
/// backwards, or, when `map` has composed them forward, arms that bend and reach backwards by a quarter of their length
/// or knees that stand out backwards: straight ones prove nothing. Depth sensors overstretch knees: that is believed up
/// to 35° (three frames of four) while the arms are before the body.
Result<double> CheckSides(std::span<const BodyPose> poses, const JointMap& map, const std::string& file);

}  // namespace etude

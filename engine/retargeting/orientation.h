#pragma once

#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// The axis of a file that points up.
enum class UpAxis { kY, kZ };

/// Rotates a point or a pose from a file's axes into the world with Y up. Files with Z up are rotated about X, so a
/// body that faced −Y faces +Z.
glm::dvec3 Upright(const glm::dvec3& point, UpAxis up);
BodyPose Upright(BodyPose pose, UpAxis up);

/// Returns the unit direction from the feet to the head; zero if feet and head coincide.
glm::dvec3 BodyAxis(const BodyPose& pose);
/// Returns the mean of BodyAxis over the poses; its length is small if the body turns over.
glm::dvec3 MeanBodyAxis(std::span<const BodyPose> poses);

/// Checks that left and right of a body are not exchanged in a motion (ours). Returns the mean angle by which the
/// body's knees are overextended, radians, or 0 if this angle is below 3°. Fails, naming `file`, if the left arm is
/// on the side of the right leg, or if feet point backwards (LegSides). If `map` has made a foot from other joints,
/// this foot points forward by definition. In that case the check fails if arms bend and reach backwards by a
/// quarter of their length, or if knees bend backwards; straight arms and knees are no evidence. Depth sensors show
/// overextended knees, so an overextension is accepted if it is at most 35° in three of four frames and the arms
/// are in front of the body.
Result<double> CheckSides(std::span<const BodyPose> poses, const JointMap& map, const std::string& file);

/// Fails, naming `file` and the limbs, if two or more of the eight limbs between the trunk, wrists and ankles have no
/// length (at most a hundredth of the stature) in the median frame. Such a skeleton has collapsed.
Result<void> CheckLimbs(std::span<const BodyPose> poses, const std::string& file);

}  // namespace etude

#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Returns the left joints that look exchanged with the right ones (ours). A limb crosses where the joints of its two
/// ends fit better if one pair is exchanged: the limbs are then shorter, and their lengths far more constant; or upper
/// arms are much shorter; or thighs, or both limbs of an elbow, are shorter in nearly all frames. Of the two ways to
/// undo all crossings, the one with fewer joints is returned. `frames` have any unit; unseen joints do not count.
std::vector<Role> FindExchangedJoints(std::span<const JointPositions> frames);
/// Returns a message for the user that these left joints look exchanged with the right ones, or "" if the list is
/// empty. `name_of` returns the name of a joint for the message.
std::string DescribeExchangedJoints(std::span<const Role> left, const std::function<std::string(Role)>& name_of);
std::string DescribeExchangedJoints(const BodyMotion& motion);

/// Returns true if the toes of both feet point backwards in nearly all frames: left and right are exchanged, or an axis
/// is mirrored.
bool PointFeetBackwards(std::span<const BodyPose> poses);

}  // namespace etude

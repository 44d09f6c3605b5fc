#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Returns the left joints that look exchanged with the right ones (ours). A left and a right limb cross if an exchange
/// of the two joints at one end makes the two limbs shorter and their lengths far more constant. Upper arms also cross
/// if the exchange makes them much shorter. Thighs also cross if the exchange makes them shorter in nearly all frames;
/// so do upper arms and forearms together. Two sets of joints undo all crossings; the smaller set is returned. `frames`
/// have any unit; unseen joints do not count.
std::vector<Role> FindExchangedJoints(std::span<const JointPositions> frames);
/// Returns a message for the user that these left joints look exchanged with the right ones, or "" if the list is
/// empty. `name_of` returns the name of a joint for the message.
std::string DescribeExchangedJoints(std::span<const Role> left, const std::function<std::string(Role)>& name_of);
std::string DescribeExchangedJoints(const BodyMotion& motion);

/// Returns true if the toes of both feet point backwards in nearly all frames: left and right are exchanged, or an axis
/// is mirrored.
bool PointFeetBackwards(std::span<const BodyPose> poses);

}  // namespace etude

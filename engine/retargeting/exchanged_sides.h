#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/formats/trc.h"
#include "engine/motion/body.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Returns the left joints that look exchanged with the right ones (ours). A left and a right limb cross if an exchange
/// of the two joints at one end makes the two limbs shorter and their lengths far more constant. Upper arms also cross
/// if the exchange makes them much shorter. Thighs also cross if the exchange makes them shorter in nearly all frames.
/// Upper arms and forearms, or thighs and shanks, also cross if such an exchange makes each of the two pairs shorter in
/// nearly all frames. The trunk crosses if hips and shoulders point in opposite directions in nearly all frames. All
/// crossings disappear if one of two complementary sets of joints is exchanged; the smaller set is returned. `frames`
/// have any unit; unseen joints do not count.
std::vector<Role> FindExchangedJoints(std::span<const JointPositions> frames);
/// Two joints that exchange their places between two frames.
struct Exchange {
  Role joint, other;
  std::size_t frame;  ///< the first frame after the exchange
};
/// Finds exchanges within a motion (ours): frames in which each joint of a pair moves to the other joint's place. All
/// pairs of joints are searched, those of left and right first. Let d be the distance that the one joint moves from the
/// frame before, plus the distance that the other joint moves. If the two names are exchanged in this frame, the sum
/// must be less than d / 4. Because crossing arms are not an exchange, the sums of the frame before and of the frame
/// after must also be less than d / 4, each with the names exchanged or not. A joint exchanges its place with one joint
/// only, the one for which the sum is least. Joints nearer than 5 cm to each other and rates below 10 Hz are not
/// judged. Exchanges of three joints are not found. `frames` are in metres.
std::vector<Exchange> FindExchanges(std::span<const JointPositions> frames, double rate_hz);
/// Returns a message for the user about all that FindExchangedJoints and FindExchanges find; "" if that is nothing.
/// `name_of` returns the name of a joint for the message.
std::string DescribeExchangedJoints(std::span<const JointPositions> frames, double rate_hz,
                                    const std::function<std::string(Role)>& name_of);
std::string DescribeExchangedJoints(std::span<const JointPositions> frames, double rate_hz);

/// Returns a message for the user about markers of one name that two people exchange from one frame to the next, by the
/// rule of FindExchanges; "" if there are none. `one` and `other` are the columns of the two people in `markers`.
std::string DescribeExchangedMarkers(const MarkerMotion& markers, const MarkerColumns& one, const MarkerColumns& other);

/// Returns true if the toes of both feet point backwards in nearly all frames: left and right are exchanged, or an axis
/// is mirrored.
bool PointFeetBackwards(std::span<const BodyPose> poses);

}  // namespace etude

#pragma once

#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/displacements.h"
#include "engine/motion/motion_faults.h"

namespace etude {

/// Returns the angle by which a knee is overextended, degrees; negative if it is bent as knees bend. The toes show
/// where the front of the shank is; 0 if they point along it.
double KneeOverextension(const BodyPose& pose, Side side);

/// Returns the smallest distance of two line segments, a–b and c–d (Ericson 2005, "Real-Time Collision
/// Detection", 5.1.9).
double SegmentDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Returns the smallest distance of forearm and hand from the spine without its ends (hands may rest on the thighs),
/// and of the forearm from neck and head (hands may lie on the nape). A hand that is not seen does not count. Metres.
double ArmFromSpine(const BodyPose& pose, Side side, bool sees_hand = true);

/// Appends joints that lie where no body has them, by their distances from their neighbours, and left and right sides
/// that are exchanged (FindMotionFaults states the rules).
void FindTorn(const BodyMotion& motion, std::span<const JointSet> unseen, std::vector<MotionFault>& faults);

/// Appends limbs that change their lengths, knees that bend backwards and arms that pass through the trunk
/// (FindMotionFaults states the rules). Frames near `pops` do not count as changes of length. Sentences are left
/// empty.
void FindLimbFaults(const BodyMotion& motion, const FaultOptions& options, const std::vector<Pop>& pops,
                    std::vector<MotionFault>& faults);

}  // namespace etude

#pragma once

#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/displacements.h"
#include "engine/motion/motion_faults.h"

namespace etude {

/// Returns the angle by which a knee is overextended, degrees; negative if it is bent forwards as usual. The toes show
/// where the front of the shank is; if they point along the shank, the result is 0.
double KneeOverextension(const BodyPose& pose, Side side);

/// Returns the smallest distance between the line segments a–b and c–d (Ericson 2005, "Real-Time Collision Detection",
/// 5.1.9).
double SegmentDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Returns the smallest distance, metres, of forearm and hand from the spine without its ends (hands may rest on the
/// thighs), and of the forearm from neck and head (hands may lie on the nape). Pass `sees_hand` false to ignore the
/// hand.
double ArmFromSpine(const BodyPose& pose, Side side, bool sees_hand = true);

/// Appends a fault for each joint at a wrong distance from its neighbours, and a fault for exchanged left and right
/// sides (FaultRules, "torn").
void FindTorn(const BodyMotion& motion, std::span<const JointSet> unseen, std::vector<MotionFault>& faults);

/// Appends limbs that change their lengths, knees that bend backwards and arms that pass through the trunk (FaultRules
/// states the rules). Lengths are not judged in frames near `pops`. The faults' sentences are left empty.
void FindLimbFaults(const BodyMotion& motion, const FaultOptions& options, const std::vector<Pop>& pops,
                    std::vector<MotionFault>& faults);

}  // namespace etude

#pragma once

#include <optional>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/displacements.h"
#include "engine/motion/motion_faults.h"

namespace etude {

/// Returns a shank's forward direction, found from the toes: a unit vector perpendicular to the shank. Returns nullopt
/// if the foot is pointed, because the toes then lie near the line of the shank and do not show where the front is.
std::optional<glm::dvec3> FrontByToes(const BodyPose& pose, Side side);

/// Returns the angle by which a knee is overextended, degrees; 0 if it is straight or bent forwards. The line of the
/// hips must show that the knee bends backwards, and so must the toes, unless the foot is pointed or `sees_toes` is
/// false.
double KneeOverextension(const BodyPose& pose, Side side, bool sees_toes = true);

/// Returns the smallest distance between the line segments a–b and c–d (Ericson 2005, "Real-Time Collision Detection",
/// 5.1.9).
double SegmentDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Returns the smallest of these distances, metres: of the forearm and of the hand from the spine without its ends
/// (hands may rest on the thighs), and of the forearm from the line between shoulder centre and head (hands may lie
/// on the nape). The hand is ignored if `sees_hand` is false.
double ArmFromSpine(const BodyPose& pose, Side side, bool sees_hand = true);

/// Appends a fault for each joint at a wrong distance from its neighbours, and a fault for exchanged left and right
/// sides (FaultRules, "torn").
void FindTorn(const BodyMotion& motion, std::span<const JointSet> unseen, std::vector<MotionFault>& faults);

/// Appends limbs that change their lengths, knees that bend backwards and arms that pass through the trunk (FaultRules
/// states the rules). Lengths are not judged in frames near `pops`. The faults' sentences are left empty.
void FindLimbFaults(const BodyMotion& motion, const FaultOptions& options, const std::vector<Pop>& pops,
                    std::vector<MotionFault>& faults);

}  // namespace etude

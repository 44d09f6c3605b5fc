#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// Returns the pose of paper B's body (`MakeBodyTree`) whose limbs point as in `joints` (section 3.3); the root stands
/// at the left foot. From the root outwards, every joint takes the angles that point its limb in the desired direction,
/// given the actual pose of the joints before it. If an angle is clipped at its limit, the next joint therefore
/// compensates as far as possible. The positions of a limb's two ends do not define its rotation about its own line.
/// These rules do *(ours)*:
/// - upper arms and the right thigh: the X axis of elbow or knee is normal to the two limbs that meet there, unless
///   these limbs are nearly parallel (3°). In that case, and for the neck, the limb turns by the smallest rotation from
///   its direction at rest (all angles of the joint zero);
/// - the left leg, whose three limbs are joined by hinges with a common X axis: this axis is the mean of the normals at
///   ankle and knee, and the limbs lie in the plane normal to it, as near as possible to their directions. If the whole
///   leg with the foot is straight, the axis is the component of the hip line that is normal to the leg;
/// - the pelvis: its Y axis is as near as possible to the trunk, so that a sitting body bends at the hips and not at
///   the navel. The trunk: its X axis points along the shoulders.
/// If `joints` are a pose of the tree within `limits`, the positions of all joints are reproduced exactly.
/// Returns nullopt if a position is not finite, two neighbouring joints coincide, or the left leg and the hips lie on
/// one line.
std::optional<TreeState> FindStartState(const KinematicTree& body, const BodyPose& joints,
                                        std::span<const AngleRange> limits);

}  // namespace etude

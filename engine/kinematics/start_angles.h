#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// Returns the angles of paper B's body (`MakeBodyTree`) that point its limbs as in `joints` (section 3.3), the root
/// standing at the left foot. From the root outwards every joint takes the angles that bring its limb into the wanted
/// direction, given where the joints before it really went: an angle clipped at its limit is made up for by the next
/// joint as far as that one can. Two positions say nothing about the twist of a limb; these rules do *(ours)*:
/// - upper arms and the right thigh: the X axis of elbow and knee is normal to both limbs, unless they are nearly
///   parallel (3°): then, and for the neck, the smallest rotation from the parent's rest frame;
/// - the left leg, whose three limbs hang on hinges with one common X axis: that axis is the mean of the normals at
///   ankle and knee, and the limbs lie in the plane normal to it, as near as possible to where they point; when the
///   whole leg is one line, toes and all, that axis is the hip line's part across it;
/// - the pelvis: its Y axis is as near as possible to the trunk, so that a sitting body bends at the hips and not at
///   the navel; the trunk: its X axis points along the shoulders.
/// A pose of the tree comes back exactly (all joints' positions) when `limits` allow it.
/// Returns nothing when a position is not finite, or two neighbouring joints coincide, or the left leg and the hips lie
/// in one line.
std::optional<TreeState> FindStartState(const KinematicTree& body, const BodyPose& joints,
                                        std::span<const AngleRange> limits);

}  // namespace etude

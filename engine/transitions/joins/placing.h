#pragma once

#include <span>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"

namespace etude {

/// Returns the floor move that aligns the new motion with the old one so that feet which stand in both motions at the
/// same time stand at the same positions. It is a least-squares fit of toe tips and ankles and, with a lower weight, of
/// the hips and shoulders at the point. If no foot stands in both, only hips and shoulders are used. The feet may
/// rotate the body by at most 30°, which is 190° per second in the shortest join. `old` and `next` hold at least one
/// frame each, from the point on.
FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz);

/// Returns the horizontal shift of a new motion with which the velocity of the body's mass centre changes evenly over a
/// join of `frames` frames: its way is then the mean of both velocities times the join's length. With the length
/// 2·√(height/gravity) a body that comes to a stand stops over its capture point (Pratt et al. 2006). `left` is the old
/// motion's frame at the point, `leaving` two of its successive frames there, `arriving` the new motion's last two
/// frames of the join.
glm::dvec3 CarriedShift(const PosePair& leaving, const BodyPose& left, const PosePair& arriving, int frames);

}  // namespace etude

#pragma once

#include <span>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"

namespace etude {

/// Returns the floor move that aligns the new motion with the old one by the feet: feet that stand in both motions at
/// the same time should stand at the same positions. The move is a least-squares fit of toe tips and ankles and, with a
/// lower weight, of the hips and shoulders at the transition point. If no foot stands in both motions, only hips and
/// shoulders are fitted. The feet may rotate the body by at most 30°, which is at most 190° per second in the shortest
/// join. `old` and `next` contain the frames from the point on, at least one frame.
FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz);

/// Returns the horizontal shift by which a new motion must be moved so that the velocity of the body's centre of mass
/// can change linearly over a join of `frames` frames. The centre of mass then travels the mean of the two motions'
/// velocities times the join's duration. If the join takes 2·√(height/gravity) seconds, a body that comes to rest stops
/// over its capture point (Pratt et al. 2006). `left` is the old motion's frame at the transition point, `leaving` are
/// two successive frames of the old motion there, and `arriving` are the new motion's last two frames of the join.
glm::dvec3 CarriedShift(const PosePair& leaving, const BodyPose& left, const PosePair& arriving, int frames);

}  // namespace etude

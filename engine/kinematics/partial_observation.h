#pragma once

#include <optional>

#include "engine/kinematics/limb_lengths.h"
#include "engine/motion/body.h"

namespace etude {

/// Fills in what an observation lacks, so that `FixLimbLengths` can work with it; what was seen stays as it is, and the
/// observation still says what it lacks. *(Ours; paper B marks every limb in every picture.)*
/// - A limb's direction is that in `like`, turned with the nearest limb towards the trunk that was seen: by the
///   smallest rotation that takes that one from `like` to the observation. Where there is none, it keeps the direction
///   it has there.
/// - An end is where the rest of the body puts it: hips and shoulders stand across as in `like`, and the limbs reach
///   down from there with their lengths and directions. With no foot seen the hips hang from the shoulders by the trunk
///   of `like`, with no hand the shoulders stand on it; with nothing seen at all the hips are where `like` has them.
/// A complete observation comes back as it is.
/// @param like a pose near the one observed: the last one recovered, or a standing body
/// @return nothing when no end was seen at all and `is_placed` is false: `like` stands anywhere then
std::optional<LimbObservation> CompleteObservation(const LimbObservation& seen, const LimbLengths& lengths,
                                                   const BodyPose& like, bool is_placed);

}  // namespace etude

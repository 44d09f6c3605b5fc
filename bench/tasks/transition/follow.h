#pragma once

#include <span>

#include "bench/tasks/transition/exchange.h"
#include "bench/tasks/transition/scoring.h"

namespace etude {

/// Does what a method outside answered, which must have a way: the clips spliced, or its own frames put between them.
/// The distances are by paper A's weights, whatever the method went by.
SwitchOutcome FollowAnswer(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request);

/// Shows `from` up to the frame left, then the frames of `between` as they are (one at least), then what follows the
/// frame entered of `to`, laid on the last of them. Both ends of `between` are seams; for the first, the frame that
/// would stand in the left one's place is what the new motion comes from at a steady speed.
Splice SpliceBetween(const BodyMotion& from, const BodyMotion& to, const Switch& change,
                     std::span<const BodyPose> between);

}  // namespace etude

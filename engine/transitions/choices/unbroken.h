#pragma once

#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// Nature's yardstick, no answer to the request: the playing clip goes on as if nothing had been asked. The record has
/// one seam all the same, where the frame of the request meets itself: every measure of a seam then tells what it makes
/// of motion that was never cut, on the very frames where the others switch. Any join leaves the clip as it is.
///
/// No legs when the request comes at the clip's last frame, after which there is nothing to go on with.
SwitchRecord PlanUnbroken(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

}  // namespace etude

#pragma once

#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// A record of two legs: the playing clip up to `leave_frame`, the wanted one after `enter_frame`. The branch is by
/// half (paper A, section 3.5), the distance by the rules' weights; why is left to the caller.
SwitchRecord DirectSwitch(const MotionLibrary& library, const SwitchRequest& request, int leave_frame, int enter_frame,
                          const SwitchRules& rules);

}  // namespace etude

#pragma once

#include "engine/bridging/library.h"
#include "engine/bridging/links.h"
#include "engine/bridging/switch_record.h"

namespace etude {

/// A record of two legs: the playing clip up to `leave_frame`, the wanted one after `enter_frame`. The branch is by
/// half (paper A, section 3.5), the distance by the rules' weights; why is left to the caller.
SwitchRecord DirectSwitch(const MotionLibrary& library, const SwitchRequest& request, int leave_frame, int enter_frame,
                          const SwitchRules& rules);

}  // namespace etude

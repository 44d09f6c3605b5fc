#pragma once

#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// At once, into the wanted clip's first frame, whatever the poses.
SwitchRecord PlanNow(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

/// After the playing clip's last frame, into the wanted clip's first, whatever the budget: what a player without
/// bridging does (paper A, section 1).
SwitchRecord PlanWaitForEnd(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

}  // namespace etude

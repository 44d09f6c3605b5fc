#pragma once

#include "engine/bridging/library.h"
#include "engine/bridging/links.h"
#include "engine/bridging/switch_record.h"

namespace etude {

/// At once, into the wanted clip's first frame, whatever the poses.
SwitchRecord PlanNow(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

/// After the playing clip's last frame, into the wanted clip's first, whatever the budget: what a player without
/// bridging does (paper A, section 1).
SwitchRecord PlanWaitForEnd(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

}  // namespace etude

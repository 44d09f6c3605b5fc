#pragma once

#include <string>

#include "engine/bridging/library.h"
#include "engine/bridging/links.h"
#include "engine/bridging/switch_record.h"

namespace etude {

/// What a choice does when no pair of frames matches (paper A, section 3.5): the way through an in-between. `why_not`
/// says why there is no direct one; `pairs_seen` were compared to know that.
SwitchRecord ThroughInBetween(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules,
                              const std::string& why_not, std::int64_t pairs_seen);

}  // namespace etude

#pragma once

#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/stage.h"
#include "engine/document/fields.h"

namespace etude {

/// Reads what a condition says of clips, bridge frames and in-betweens. Complaints stay in `condition`.
StageRules ReadStageRules(Fields& condition, const FuzzySystem& fuzzy);

/// What it reads, for the reference page.
std::vector<KeyInfo> StageKeys();

}  // namespace etude

#pragma once

#include "engine/transitions/library/body_proportions.h"

namespace etude {

/// Returns the proportions of the body that performs all clips in the evaluation of transitions. The body's hip height
/// is 0.90 m (docs/reference/metrics.md).
BodyProportions JudgedProportions();

}  // namespace etude

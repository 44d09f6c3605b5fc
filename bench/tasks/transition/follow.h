#pragma once

#include "bench/tasks/transition/exchange.h"
#include "bench/tasks/transition/outcome.h"

namespace etude {

/// Does what a method outside answered, which must have a way: the clips spliced, or its own frames put between them.
/// The distances are by the fixed weights, whatever the method went by.
TransitionOutcome FollowAnswer(const TransitionAnswer& answer, const Stage& stage, const TransitionRequest& request);

}  // namespace etude

#pragma once

#include <vector>

#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/splice.h"

namespace etude {

/// A way to get from clip to clip: a choice of frames × a join, with what they can be set by.
struct TransitionWay {
  const Choice* choice = nullptr;
  const Join* join = nullptr;
  MatchRules rules = {};
  std::vector<double> choice_settings = {},
                      join_settings = {};  ///< one per setting of the choice, of the join; none: defaults
};

/// What a way made of a request.
struct Transition {
  TransitionRecord record;
  Splice splice;  ///< empty when the record has no segments
};

/// From a clip and a frame of it into another clip, within a budget of time. The request's clips and frame must be in
/// the library, and the wanted clip must have two frames.
Transition MakeTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& way);

}  // namespace etude

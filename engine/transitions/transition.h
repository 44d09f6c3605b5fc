#pragma once

#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/splice.h"

namespace etude {

/// A choice of frames × a join, with what both can be set by.
struct SwitchMethod {
  const Choice* choice = nullptr;
  const Join* join = nullptr;
  SwitchRules rules;
  JoinSettings join_settings;
};

/// What a method made of a request.
struct SwitchResult {
  SwitchRecord record;
  Splice splice;  ///< empty when the record found no way
};

/// From a clip and a frame of it into another clip, within a budget of time. The request's clips and frame must be in
/// the library, and the wanted clip must have two frames.
SwitchResult SwitchClips(const MotionLibrary& library, const SwitchRequest& request, const SwitchMethod& method);

}  // namespace etude

#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/bridging/library.h"

namespace etude {

/// Clips to learn from. What is learnt for a switch never saw the two clips that it is judged by.
struct TrainingClips {
  std::vector<std::string> identities;  ///< equal for equal dances: "builtin:clap", or the file
  MotionLibrary library;
};

/// The name of a built-in move's dance.
std::string MoveIdentity(const std::string& move);

/// Every built-in move, and the clips of `library` that are none, by their identities; tagged anew by `rules`.
Result<TrainingClips> GatherTrainingClips(const MotionLibrary& library, const std::vector<std::string>& identities,
                                          const TagRules& rules = {});

}  // namespace etude

#pragma once

#include <optional>
#include <vector>

#include "engine/transitions/choices/planning.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A clip that stands up, or lies down: it can be entered from what is left, and later be left for what is wanted.
struct ThroughClip {
  int clip = 0;            ///< of the library
  std::vector<int> enter;  ///< its frames that may be entered, in rising order, before those of `leave`
  std::vector<int> leave;  ///< its frames from which the wanted clip may be entered, in rising order
};

/// Finds the clip whose way from one stance to the other begins and ends most like the frames that are allowed, by
/// MotionFeatures at both ends. NeedsClip must be true of all pairs of `allowed`. The playing clip, too, may be the one
/// that stands up. None when no clip of the library does, or none within `most_s` seconds.
std::optional<ThroughClip> FindThroughClip(const MotionLibrary& library, const TransitionRequest& request,
                                           const AllowedFrames& allowed, double most_s);

}  // namespace etude

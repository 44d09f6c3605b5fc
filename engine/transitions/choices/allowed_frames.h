#pragma once

#include <cstdint>
#include <vector>

#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// The frames that a choice may take, both in rising order: each of `leave` with each of `enter` is a pair.
struct AllowedFrames {
  std::vector<int> leave;  ///< of the playing clip
  std::vector<int> enter;  ///< of the wanted clip

  std::int64_t Pairs() const { return static_cast<std::int64_t>(leave.size() * enter.size()); }
};

/// The bridge frames within the request's budget, and those of the wanted clip but its last frame.
AllowedFrames AllowedBridgeFrames(const MotionLibrary& library, const TransitionRequest& request);

/// All frames within the budget, and those of the wanted clip that leave `least_play_s` seconds of it to play, or lie
/// in its front half; one pair at least when the wanted clip has two frames.
AllowedFrames AllowedAnyFrames(const MotionLibrary& library, const TransitionRequest& request, double least_play_s);

}  // namespace etude

#include "engine/transitions/choices/allowed_frames.h"

#include <algorithm>
#include <cmath>

#include "engine/transitions/bridge_frames/transition_points.h"

namespace etude {

AllowedFrames AllowedBridgeFrames(const MotionLibrary& library, const TransitionRequest& request) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  return {.leave = BridgeFramesWithin(playing, WaitWindow(playing, request.request_frame, request.budget_s)),
          .enter = BridgeFramesWithin(next, EntryWindow(next))};
}

AllowedFrames AllowedAnyFrames(const MotionLibrary& library, const TransitionRequest& request, double least_play_s) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int frames = next.FrameCount();
  const int least_left = std::max(static_cast<int>(std::ceil(least_play_s * next.rate_hz - 1e-9)), 1);
  const int enter_end = std::max(frames - least_left, std::max(frames / 2, 1));
  return {.leave = FramesWithin(WaitWindow(playing, request.request_frame, request.budget_s)),
          .enter = FramesWithin({0, enter_end - 1})};
}

}  // namespace etude

#include "engine/transitions/choices/pair_rows.h"

#include <algorithm>
#include <cmath>

namespace etude {

PairRange AllowedPairs(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int frames = next.FrameCount();
  const int least_left = std::max(static_cast<int>(std::ceil(rules.least_play_s * next.rate_hz - 1e-9)), 1);
  return {.leave = WaitWindow(playing, request.request_frame, request.budget_s),
          .enter_end = std::max(frames - least_left, std::max(frames / 2, 1))};
}

}  // namespace etude

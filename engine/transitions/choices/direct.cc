#include "engine/transitions/choices/direct.h"

namespace etude {

SwitchRecord DirectSwitch(const MotionLibrary& library, const SwitchRequest& request, int leave_frame, int enter_frame,
                          const SwitchRules& rules) {
  const TaggedClip &from = library.tagged[request.from], &to = library.tagged[request.to];
  SwitchRecord record;
  record.branch = to.InFrontHalf(enter_frame) ? Branch::kFrontHalf : Branch::kRearHalf;
  record.request_frame = request.request_frame;
  record.legs = {{.clip = request.from, .first = request.request_frame, .last = leave_frame, .own = {}},
                 {.clip = request.to, .first = enter_frame, .last = to.FrameCount() - 1, .own = {}}};
  record.meetings = {ComputeDistance(from.grades[leave_frame], to.grades[enter_frame], rules.weights)};
  record.wait_s = WaitOf(record.legs, from.rate_hz);
  return record;
}

}  // namespace etude

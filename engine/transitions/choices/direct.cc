#include "engine/transitions/choices/direct.h"

namespace etude {

TransitionRecord DirectTransition(const MotionLibrary& library, const TransitionRequest& request, int leave_frame,
                                  int enter_frame, const MatchRules& rules) {
  const TaggedClip &from = library.tagged[request.from], &to = library.tagged[request.to];
  TransitionRecord record;
  record.branch = to.InFrontHalf(enter_frame) ? Branch::kFrontHalf : Branch::kRearHalf;
  record.request_frame = request.request_frame;
  record.segments = {{.clip = request.from, .first = request.request_frame, .last = leave_frame, .own = {}},
                     {.clip = request.to, .first = enter_frame, .last = to.FrameCount() - 1, .own = {}}};
  record.distances = {ComputeDistance(from.grades[leave_frame], to.grades[enter_frame], rules.weights)};
  record.wait_s = WaitOf(record.segments, from.rate_hz);
  return record;
}

}  // namespace etude

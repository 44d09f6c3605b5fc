#include "engine/transitions/choices/abrupt.h"

#include <fmt/format.h>

#include "engine/transitions/choices/direct.h"

namespace etude {

TransitionRecord PlanNow(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules) {
  TransitionRecord record = DirectTransition(library, request, request.request_frame, 0, rules);
  record.branch = Branch::kNow;
  record.why = fmt::format("at once into the first frame, whatever the poses; d = {:.2f}", record.distances[0].value);
  return record;
}

TransitionRecord PlanWaitForEnd(const MotionLibrary& library, const TransitionRequest& request,
                                const MatchRules& rules) {
  const int end = library.tagged[request.from].FrameCount() - 1;
  TransitionRecord record = DirectTransition(library, request, end, 0, rules);
  record.branch = Branch::kEnd;
  record.why = fmt::format("the playing clip ended, after {:.2f} s; d = {:.2f} to the first frame", record.wait_s,
                           record.distances[0].value);
  return record;
}

}  // namespace etude

#include "engine/transitions/choices/abrupt.h"

#include <fmt/format.h>

#include "engine/transitions/choices/direct.h"

namespace etude {

SwitchRecord PlanNow(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  SwitchRecord record = DirectSwitch(library, request, request.request_frame, 0, rules);
  record.branch = Branch::kNow;
  record.why = fmt::format("at once into the first frame, whatever the poses; d = {:.2f}", record.meetings[0].value);
  return record;
}

SwitchRecord PlanWaitForEnd(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const int end = library.tagged[request.from].FrameCount() - 1;
  SwitchRecord record = DirectSwitch(library, request, end, 0, rules);
  record.branch = Branch::kEnd;
  record.why = fmt::format("the playing clip ended, after {:.2f} s; d = {:.2f} to the first frame", record.wait_s,
                           record.meetings[0].value);
  return record;
}

}  // namespace etude

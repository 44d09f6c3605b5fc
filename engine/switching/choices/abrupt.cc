#include "engine/switching/choices/abrupt.h"

#include "engine/switching/choices/direct.h"

namespace etude {

SwitchRecord PlanNow(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  SwitchRecord record = DirectSwitch(library, request, request.request_frame, 0, rules);
  record.branch = Branch::kNow;
  record.why = "asked for, and shown";
  return record;
}

SwitchRecord PlanWaitForEnd(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const int end = library.tagged[request.from].FrameCount() - 1;
  SwitchRecord record = DirectSwitch(library, request, end, 0, rules);
  record.branch = Branch::kEnd;
  record.why = "the playing clip has ended";
  return record;
}

}  // namespace etude

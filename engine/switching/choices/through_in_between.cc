#include "engine/switching/choices/through_in_between.h"

#include <fmt/format.h>

#include "engine/bridging/in_between.h"

namespace etude {

SwitchRecord ThroughInBetween(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules,
                              const std::string& why_not, std::int64_t pairs_seen) {
  SwitchRecord record;
  record.request_frame = request.request_frame;
  record.pairs_seen = pairs_seen;
  const FrameWindow window = WaitWindow(library.tagged[request.from], request.request_frame, request.budget_s);
  const bool found = TakeInBetween(library, request, window, rules, record);
  record.why = fmt::format("{}; {}", why_not, found ? record.why : "and the library has no in-between");
  return record;
}

}  // namespace etude

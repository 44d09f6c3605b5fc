#include "engine/switching/choices/fuzzy_bridge.h"

#include "engine/switching/choices/direct.h"

namespace etude {

SwitchRecord PlanFuzzyBridge(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const FrameWindow window = WaitWindow(library.tagged[request.from], request.request_frame, request.budget_s);
  const LinkSearch search = FindLink(library.tagged[request.from], window, library.tagged[request.to], rules);
  SwitchRecord record;
  if (search.link) {
    record = DirectSwitch(library, request, search.link->from, search.link->to, rules);
    record.pairs_seen = search.pairs_seen;
    return record;
  }
  record.request_frame = request.request_frame;
  record.pairs_seen = search.pairs_seen;
  if (!TakeInBetween(library, request, window, rules, record)) record.why = "no bridge frames match";
  return record;
}

}  // namespace etude

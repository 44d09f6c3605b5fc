#include "engine/bridging/transition.h"

#include <cassert>

namespace etude {
namespace {

Transition SwitchToStart(std::span<const TaggedClip> library, Switch change, int request_frame, Branch branch,
                         const SwitchRules& rules) {
  const TaggedClip& from = library[change.from_clip];
  change.distance = ComputeDistance(from.grades[change.from_frame], library[change.to_clip].grades[0], rules.weights);
  const double wait_s = (change.from_frame - request_frame) / from.rate_hz;
  return {branch, {change}, request_frame, 0, wait_s};
}

Switch ToSwitch(int from, int to, const Link& link) { return {from, link.from, to, link.to, link.distance}; }

Transition BridgeByFuzzyTags(std::span<const TaggedClip> library, int from, int request_frame, int to,
                             const SwitchRules& rules) {
  Transition plan;
  plan.request_frame = request_frame;
  const double rate_hz = library[from].rate_hz;
  const FrameWindow window = WaitWindow(library[from], request_frame, rules);

  const LinkSearch direct = FindLink(library[from], window, library[to], rules);
  plan.pairs_seen = direct.pairs_seen;
  if (direct.link) {
    plan.branch = direct.link->to < library[to].FrameCount() / 2 ? Branch::kFrontHalf : Branch::kRearHalf;
    plan.switches = {ToSwitch(from, to, *direct.link)};
    plan.wait_s = (direct.link->from - request_frame) / rate_hz;
    return plan;
  }

  const InBetweenSearch detour = FindInBetween(library, from, window, to, rules);
  plan.pairs_seen += detour.pairs_seen;
  if (detour.found) {
    const InBetween& way = *detour.found;
    plan.branch = Branch::kInBetween;
    plan.switches = {ToSwitch(from, way.through, way.enter), ToSwitch(way.through, to, way.leave)};
    plan.wait_s = (way.enter.from - request_frame) / rate_hz + (way.leave.from - way.enter.to) / rate_hz;
  }
  return plan;
}

}  // namespace

std::string_view BranchName(Branch branch) {
  switch (branch) {
    case Branch::kNone:
      return "none";
    case Branch::kNow:
      return "now";
    case Branch::kEnd:
      return "end";
    case Branch::kFrontHalf:
      return "front half";
    case Branch::kRearHalf:
      return "rear half";
    case Branch::kInBetween:
      return "in-between";
  }
  return "";
}

Transition PlanTransition(std::span<const TaggedClip> library, int from, int request_frame, int to, Choice choice,
                          const SwitchRules& rules) {
  assert(library[to].FrameCount() >= 2 && request_frame < library[from].FrameCount());
  const Switch change{.from_clip = from, .from_frame = request_frame, .to_clip = to, .to_frame = 0, .distance = {}};
  switch (choice) {
    case Choice::kNow:
      return SwitchToStart(library, change, request_frame, Branch::kNow, rules);
    case Choice::kWaitForEnd: {
      Switch at_end = change;
      at_end.from_frame = library[from].FrameCount() - 1;
      return SwitchToStart(library, at_end, request_frame, Branch::kEnd, rules);
    }
    case Choice::kFuzzyBridge:
      break;
  }
  return BridgeByFuzzyTags(library, from, request_frame, to, rules);
}

}  // namespace etude

#pragma once

#include "engine/transitions/choices/through_in_between.h"
#include "engine/transitions/library/library.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/controls.h"
#include "sim/choreography/move.h"

namespace etude {

/// Returns all built-in moves and acts, danced by one body.
inline MotionLibrary BuiltinLibrary() {
  std::vector<std::string> names = BuiltinMoveNames();
  for (const std::string& act : BuiltinActNames()) names.push_back(act);
  std::vector<BodyMotion> clips;
  for (const std::string& name : names) clips.push_back(LoadBuiltinMove(name).value().motion);
  return MakeLibrary(names, clips, MakeBodyProportions(PoseOf(Controls{}), 0.9));
}

struct Connections {
  int tried = 0, found = 0;
  int forced = 0;
  double worst_wait_s = 0;
};

/// Tries transitions from every `step`-th frame of every clip into every other clip.
inline Connections TryAll(const MotionLibrary& library, int step, const MatchRules& rules = {}) {
  Connections connections;
  const int count = static_cast<int>(library.tagged.size());
  for (int from = 0; from < count; ++from) {
    for (int to = 0; to < count; ++to) {
      if (from == to) continue;
      for (int frame = 0; frame < library.tagged[from].FrameCount(); frame += step) {
        const TransitionRequest request{.from = from, .request_frame = frame, .to = to, .budget_s = 1};
        const TransitionRecord record = ThroughInBetween(library, request, rules, "", 0);
        ++connections.tried;
        connections.found += !record.segments.empty();
        connections.forced += record.branch == Branch::kForced;
        connections.worst_wait_s = std::max(connections.worst_wait_s, record.wait_s);
      }
    }
  }
  return connections;
}

}  // namespace etude

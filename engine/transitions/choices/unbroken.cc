#include "engine/transitions/choices/unbroken.h"

#include <fmt/format.h>

namespace etude {

TransitionRecord PlanUnbroken(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules) {
  const TaggedClip& playing = library.tagged[request.from];
  const int frame = request.request_frame, last = playing.FrameCount() - 1;
  TransitionRecord record;
  record.request_frame = frame;
  if (frame >= last) {
    record.why = fmt::format("{} has no frame left to go on with", library.names[request.from]);
    return record;
  }
  record.branch = Branch::kUnbroken;
  record.segments = {{.clip = request.from, .first = frame, .last = frame, .own = {}},
                     {.clip = request.from, .first = frame, .last = last, .own = {}}};
  record.distances = {ComputeDistance(playing.grades[frame], playing.grades[frame], rules.weights)};
  record.why = fmt::format("{} goes on: no transition, for comparison", library.names[request.from]);
  return record;
}

}  // namespace etude

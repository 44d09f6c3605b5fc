#include "engine/transitions/transition.h"

namespace etude {

Transition MakeTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& way) {
  Transition made{way.choice->plan(library, request, way.rules, way.choice_settings), {}};
  if (!made.record.segments.empty()) {
    made.splice = SpliceSegments(library.motions, made.record.segments, *way.join, way.join_settings);
  }
  return made;
}

}  // namespace etude

#include "engine/transitions/transition.h"

namespace etude {

SwitchResult SwitchClips(const MotionLibrary& library, const SwitchRequest& request, const SwitchMethod& method) {
  SwitchResult result{method.choice->plan(library, request, method.rules), {}};
  if (!result.record.legs.empty()) {
    result.splice = SpliceLegs(library.motions, result.record.legs, *method.join, method.join_settings);
  }
  return result;
}

}  // namespace etude

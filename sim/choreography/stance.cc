#include "sim/choreography/stance.h"

#include "engine/base/angles.h"
#include "sim/choreography/canonical_body.h"

namespace etude {

Controls ReadyStance() {
  Controls ready;
  ready[MiddleControl::kHipsDrop] = 0.006;
  ready[MiddleControl::kHipsAhead] = 0.01;
  for (Side side : {Side::kLeft, Side::kRight}) {
    ready.Of(side, SideControl::kArmForward) = Radians(4);
    ready.Of(side, SideControl::kArmSide) = Radians(9);
    ready.Of(side, SideControl::kElbow) = Radians(16);
    ready.Of(side, SideControl::kWrist) = Radians(8);
  }
  return ready;
}

BodyPose StandingPose() { return PoseOf(Controls{}); }

}  // namespace etude

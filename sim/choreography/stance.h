#pragma once

#include "engine/motion/body.h"
#include "sim/choreography/controls.h"

namespace etude {

/// The ready stance near which every move starts and ends: feet on their home spots, knees soft,
/// arms loosely hanging. What a choreography file does not name stands like this.
Controls ReadyStance();

/// The canonical body at rest: legs straight, arms hanging. The pose to calibrate, fit and compare by.
BodyPose StandingPose();

}  // namespace etude

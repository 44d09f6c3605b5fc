#pragma once

#include <string>

#include "bench/keys/field_table.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/key_pose.h"
#include "sim/performer/session.h"

namespace etude {

/// One condition of a detection scenario: who dances, and how well the sensor sees it.
///
///     events: 8        # performances in one session
///     fault_share: 0.5 # of them are wrong
///     skill: 1         # 1 = careful learner, 0 = sloppy
///     noise: 1         # times every error of the sensor
///     turn_deg: 0      # how far the performer is turned away from the sensor
struct DetectionOptions {
  SessionOptions session;
  double noise = 1;
  double turn_deg = 0;
  KeyPoseOptions recogniser;  ///< what methods begin with
};

/// One way from stream to verdict.
///
///     - {name: adaptive, filter: holt, recogniser: key-pose, weights: adaptive, threshold: 0.8}
struct DetectionMethod {
  std::string name;
  FilterOptions filter;
  bool sees_truth = false;  ///< `oracle: [stream]`
  KeyPoseOptions recogniser;
};

const FieldTable<DetectionOptions>& DetectionConditionFields();
/// `threshold` and `hold_frames` may stand in the condition for all methods, which makes these two sweepable.
const FieldTable<DetectionMethod>& DetectionMethodFields();

}  // namespace etude

#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
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
///     turn_deg: 0      # how far the dancer is turned away from the sensor
struct DetectionOptions {
  SessionOptions session;
  double noise = 1;
  double turn_deg = 0;
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

/// Complaints stay in `condition`.
DetectionOptions ReadDetectionOptions(Fields& condition);

/// Reads the methods; `threshold` and `hold_frames` may stand in the condition for all of them, which
/// makes these two sweepable.
Result<std::vector<DetectionMethod>> ReadDetectionMethods(Fields& condition, std::span<const Node> methods);

/// The keys of a scenario and of a method, for the reference page.
std::vector<KeyInfo> DetectionConditionKeys();
std::vector<KeyInfo> DetectionMethodKeys();

}  // namespace etude

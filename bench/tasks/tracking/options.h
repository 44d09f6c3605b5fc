#pragma once

#include <optional>
#include <string>

#include "bench/tasks/base/ik_targets.h"
#include "bench/tasks/base/solver_fields.h"
#include "engine/motion/body.h"

namespace etude {

/// The smallest number of frames of a motion. Jerk needs four frames.
constexpr int kMinTrackedFrames = 4;

/// One condition of a tracking scenario: the motion to follow.
struct TrackingOptions {
  double duration_s = 5;
  double rate_hz = kJudgedRateHz;
  TargetNoise target_noise = {};
  /// The standard deviation of the noise that is added to the true angles for the start of the first frame, degrees. If
  /// empty, the first frame starts at the standing pose.
  std::optional<double> joint_noise_deg = {};
  IkOptions common = IkBudget(20);  ///< options that all methods share
};

/// The pose from which a solver starts in every frame except the first.
enum class FrameStart {
  kWarm,  ///< "warm": the solver's answer to the previous frame
  kCold,  ///< "cold": the start of the first frame
};

/// A solver with its settings.
struct TrackingMethod {
  std::string name;
  const IkSolver* solver = DefaultIkSolver();
  IkOptions options;
  FrameStart start = FrameStart::kWarm;
};

const FieldTable<TrackingOptions>& TrackingConditionFields();
const FieldTable<TrackingMethod>& TrackingMethodFields();

}  // namespace etude

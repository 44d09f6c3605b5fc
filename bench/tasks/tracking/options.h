#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/ik_targets.h"
#include "bench/tasks/base/task.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

/// Jerk needs as many frames.
constexpr int kFewestTrackedFrames = 4;

/// One condition of a tracking scenario: what is to be followed.
struct TrackingOptions {
  double duration_s = 5;
  double rate_hz = kJudgedRateHz;
  TargetNoise target_noise = {};
  /// How far the first frame's start is from its truth, standard deviation; empty: it is the standing pose.
  std::optional<double> joint_noise_deg = {};
};

/// Where a solver begins at every frame but the first.
enum class FrameStart {
  kWarm,  ///< "warm": at its answer to the frame before
  kCold,  ///< "cold": where it began at the first frame
};

/// A solver with its settings.
struct TrackingMethod {
  std::string name;
  const IkSolver* solver = nullptr;
  IkOptions options;
  FrameStart start = FrameStart::kWarm;
};

/// Reads `duration_s`, `rate_hz`, `target_noise_cm`, `target_noise_deg`, `joint_noise_deg`; complaints stay in
/// `condition`.
TrackingOptions ReadTrackingOptions(Fields& condition);

/// Reads what all methods of a condition share: `max_sweeps`, `stop_at`; complaints stay in `condition`.
IkOptions ReadFrameBudget(Fields& condition);

/// Reads the methods: `solver` and its settings, `start`, `tolerance_deg`, on top of what they share.
Result<std::vector<TrackingMethod>> ReadTrackingMethods(std::span<const Node> methods, const IkOptions& common);

/// What the functions above read, for the reference page.
std::vector<KeyInfo> TrackingConditionKeys();
std::vector<KeyInfo> TrackingMethodKeys();

}  // namespace etude

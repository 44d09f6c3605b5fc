#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/ik_targets.h"
#include "bench/tasks/base/task.h"
#include "engine/kinematics/joint_limits.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

enum class NoiseKind {
  kGaussian,  ///< standard deviation = joint_noise_deg
  kUniform,   ///< within ± joint_noise_deg
};

/// Where solvers begin.
enum class IkStart {
  kDisturbed,  ///< at the truth, disturbed
  kMiddle,     ///< cold: in the middle of every joint's range
  kStretched,  ///< paper B, figure 3.8: with stretched limbs, which the targets lie along
};

/// One condition of an ik scenario: how hard the trials are.
struct IkTrialOptions {
  LimitSet limit_set = LimitSet::kAdult;
  double pose_range = 0.5;  ///< the true pose is uniform in this share of every joint's range, about its middle
  IkStart start = IkStart::kDisturbed;
  double joint_noise_deg = 15;  ///< how far the start is from the truth
  NoiseKind noise = NoiseKind::kGaussian;
  TargetNoise target_noise;
  double unreachable_cm = 0;  ///< how far beyond every pose's reach one target lies; 0: none does
  bool asks_positions = true;
  bool asks_axes = true;
};

/// What is kept of a cell beside its metrics and the curves of its worst errors.
struct IkRecords {
  bool effector_errors = false;
  bool angle_changes = false;
  bool effector_curves = false;
  bool motion = false;
};

/// A solver with its settings.
struct IkMethod {
  std::string name;
  const IkSolver* solver = nullptr;
  IkOptions options;
};

/// Reads the keys of a condition that make its worlds, from `limit_set` to `unreachable_cm`; complaints stay in
/// `condition`.
IkTrialOptions ReadIkTrialOptions(Fields& condition);

/// Reads `record`; complaints stay in `condition`.
IkRecords ReadIkRecords(Fields& condition);

/// Reads what all methods of a condition share: `max_sweeps`, `stop_at`; complaints stay in `condition`.
IkOptions ReadIkCommonOptions(Fields& condition);

/// Reads the methods: `solver`, its settings, `limits`, `tolerance_deg`, `tolerance_times_noise`, on top of what they
/// share.
Result<std::vector<IkMethod>> ReadIkMethods(std::span<const Node> methods, const IkOptions& common,
                                            const IkTrialOptions& trial);

/// What the functions above read, for the reference page.
std::vector<KeyInfo> IkConditionKeys();
std::vector<KeyInfo> IkMethodKeys();

}  // namespace etude

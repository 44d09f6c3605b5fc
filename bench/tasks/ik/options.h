#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/ik_targets.h"
#include "bench/tasks/base/solver_fields.h"
#include "bench/tasks/base/task.h"
#include "engine/kinematics/joint_limits.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

enum class NoiseKind {
  kGaussian,  ///< normal distribution with the standard deviation joint_noise_deg
  kUniform,   ///< uniform distribution within ± joint_noise_deg
};

/// The pose from which solvers start.
enum class IkStart {
  kDisturbed,  ///< the truth plus noise
  kMiddle,     ///< the middle of every joint's range
  kStretched,  ///< the standing pose; the position errors point along its stretched limbs (paper B, figure 3.8)
};

/// The difficulty of the trials of a condition.
struct IkTrialOptions {
  LimitSet limit_set = LimitSet::kAdult;
  double pose_range = 0.5;  ///< true angles are drawn uniformly from this share of their ranges, around the middle
  IkStart start = IkStart::kDisturbed;
  double joint_noise_deg = 15;  ///< strength of the noise on the start angles (NoiseKind)
  NoiseKind noise = NoiseKind::kGaussian;
  TargetNoise target_noise;
  double unreachable_cm = 0;  ///< distance of one target beyond the effector's reach; 0: all targets can be reached
  bool asks_positions = true;
  bool asks_axes = true;
};

/// The optional series and the recording that a cell keeps. Metrics and the curves of the largest errors are always
/// kept.
struct IkRecords {
  bool effector_errors = false;
  bool angle_changes = false;
  bool effector_curves = false;
  bool motion = false;
};

struct IkCondition {
  IkTrialOptions trial;
  IkRecords records;
  IkOptions common = IkBudget(200);  ///< options that all methods share
};

/// A solver with its settings.
struct IkMethod {
  std::string name;
  const IkSolver* solver = DefaultIkSolver();
  IkOptions options;
  std::optional<double> tolerance_times_noise;  ///< options.angle_change_tolerance, in multiples of joint_noise_deg
};

const FieldTable<IkCondition>& IkConditionFields();
const FieldTable<IkMethod>& IkMethodFields();

/// Reads the methods. Each method begins with the options that the condition sets for all methods.
Result<std::vector<IkMethod>> ReadIkMethods(TaskInput& input, const IkCondition& condition);

}  // namespace etude

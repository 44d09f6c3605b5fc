#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

enum class NoiseKind {
  kGaussian,  ///< standard deviation = joint_noise_deg
  kUniform,   ///< within ± joint_noise_deg
};

/// One condition of an ik scenario: how hard the trials are.
struct IkTrialOptions {
  double pose_range = 0.5;      ///< the true pose is uniform in this share of every joint's range, about its middle
  double joint_noise_deg = 15;  ///< how far the start is from the truth
  NoiseKind noise = NoiseKind::kGaussian;
};

/// A solver with its settings.
struct IkMethod {
  std::string name;
  const IkSolver* solver = nullptr;
  IkOptions options;
};

/// Reads the keys `poses`, `joint_noise_deg`, `noise` of a condition; complaints stay in `condition`.
IkTrialOptions ReadIkTrialOptions(Fields& condition);

/// Reads what all methods of a condition share: `max_sweeps`, `stop_at`; complaints stay in `condition`.
IkOptions ReadIkCommonOptions(Fields& condition);

/// Reads the methods: `solver`, `weights`, `refresh`, `limits`, `tolerance_deg`, `tolerance_times_noise`, on top of
/// what they share.
Result<std::vector<IkMethod>> ReadIkMethods(std::span<const Node> methods, const IkOptions& common,
                                            const IkTrialOptions& trial);

/// What the functions above read, for the reference page.
std::vector<KeyInfo> IkConditionKeys();
std::vector<KeyInfo> IkMethodKeys();

}  // namespace etude

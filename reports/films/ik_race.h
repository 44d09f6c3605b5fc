#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/base/result.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/motion/body.h"

namespace etude {

/// The limits for a solved pose: the position error of the worst effector, cm, and the angular error of the worst axis,
/// degrees, must be smaller.
inline const double kGoalCm = 100 * IkOptions{}.position_goal;
inline const double kGoalDeg = Degrees(IkOptions{}.axis_goal);

/// The poses of one method from the first to the last of its iterations. All lists below have one entry per recorded
/// iteration.
struct IkPath {
  std::string method;
  std::size_t method_index = 0;  ///< index of the method in the scenario, which selects the colour
  std::vector<BodyPose> poses;
  std::vector<int> iterations;          ///< numbers of the recorded iterations, ascending; the first is 0, the start
  std::vector<double> position_cm;      ///< position error of the worst end effector
  std::vector<double> orientation_deg;  ///< orientation error of the worst axis of any end effector
  /// The iteration from which on the position error and the orientation error stay below the goal; nullopt if there is
  /// no such iteration.
  std::optional<int> solved_at;
  std::string ending;  ///< the outcome: "solved", "not solved", or the status
  std::string reason;  ///< why the method did not solve the pose; "" if the pose is solved

  /// Returns the index of the entry to show at `iteration`: the last recorded iteration that is not later than
  /// `iteration`.
  std::size_t EntryAt(double iteration) const;
};

/// Returns true if any of these errors is above zero. If all position errors (or all orientation errors) are zero, no
/// target prescribes a position (or an orientation), so the film leaves out the plot of these errors.
bool IsAskedFor(const std::vector<double>& errors);

/// The joints that have targets, in the order of the effectors in the tree.
inline constexpr std::array kIkEnds{Role::kRightFoot, Role::kLeftHand, Role::kRightHand, Role::kHead};
/// The target position of each joint in kIkEnds; nullopt for a target that prescribes no position.
using IkTargets = std::array<std::optional<glm::dvec3>, kIkEnds.size()>;

/// The iterations of two methods of inverse kinematics in the same world.
struct IkRace {
  std::string world;   ///< name of the world: "joint_noise_deg=5, trial 0"
  std::string choice;  ///< a sentence that says why this world was chosen, and which worlds were skipped
  BodyPose truth;
  IkTargets targets;
  std::array<IkPath, 2> paths;

  int LastIteration() const;
};

/// Finds the first two methods with recordings, in the scenario's order, and the first world that both methods
/// recorded. The choice never depends on the results. Fails with the reason if no world was recorded for both methods,
/// or if the recordings cannot be read.
Result<IkRace> FindIkRace(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude

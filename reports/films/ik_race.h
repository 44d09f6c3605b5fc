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

/// A pose counts as solved if the position error of the worst effector (cm) and the error of the worst axis (degrees)
/// are below these limits.
inline const double kGoalCm = 100 * IkOptions{}.position_goal;
inline const double kGoalDeg = Degrees(IkOptions{}.axis_goal);

/// One method's path from the start to its end. All lists have one entry per recorded iteration.
struct IkPath {
  std::string method;
  std::size_t method_index = 0;  ///< index in the scenario, which selects the colour
  std::vector<BodyPose> poses;
  std::vector<int> iterations;          ///< never decreasing; the first is the start (0)
  std::vector<double> position_cm;      ///< error of the worst effector
  std::vector<double> orientation_deg;  ///< error of the worst single axis of any effector
  std::optional<int> solved_at;         ///< both errors are below the goal from this iteration on
  std::string ending;                   ///< "solved", "not solved", or the status
  std::string reason;                   ///< the reason if the path is not solved, else empty

  /// Returns the entry to show at `iteration`: the last recorded iteration up to it.
  std::size_t EntryAt(double iteration) const;
};

/// Returns true if any error is above zero. If all are zero, the world has no targets of this kind (positions or
/// orientations).
bool IsAskedFor(const std::vector<double>& errors);

/// The roles of the body that have targets, in the order of the effectors in the tree.
inline constexpr std::array kIkEnds{Role::kRightFoot, Role::kLeftHand, Role::kRightHand, Role::kHead};
/// The position of each target; nullopt for a target without a position.
using IkTargets = std::array<std::optional<glm::dvec3>, kIkEnds.size()>;

/// Two methods of inverse kinematics in the same world.
struct IkRace {
  std::string world;   ///< "joint_noise_deg=5, trial 0"
  std::string choice;  ///< in words: why this world was chosen, and which worlds were skipped
  BodyPose truth;
  IkTargets targets;
  std::array<IkPath, 2> paths;

  int LastIteration() const;
};

/// Finds the first two methods with recordings, in the scenario's order, and the first world that both recorded; it
/// never selects a world by its content. Fails with the reason if no world was recorded by both, or if the recordings
/// cannot be read.
Result<IkRace> FindIkRace(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude

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

/// "Solved" means on every picture that the worst effector and the worst axis are below these.
inline const double kGoalCm = 100 * IkOptions{}.position_goal;
inline const double kGoalDeg = Degrees(IkOptions{}.axis_goal);

/// One method's way from the start to where it ended. All lists have one entry per recorded iteration.
struct IkPath {
  std::string method;
  std::size_t method_index = 0;  ///< in the scenario: its colour
  std::vector<BodyPose> poses;
  std::vector<int> iterations;          ///< never falling, the start (0) first
  std::vector<double> position_cm;      ///< of the worst effector
  std::vector<double> orientation_deg;  ///< of the worst single axis of any effector
  std::optional<int> solved_at;         ///< from this iteration on, both errors are below the goal
  std::string ending;                   ///< "solved", "not solved", or the status
  std::string reason;                   ///< why it is not solved; empty when it is

  /// Finds the entry that shows the state at that moment: the last recorded iteration that is over.
  std::size_t EntryAt(double iteration) const;
};

/// Tells whether positions, or orientations, were asked for at all: without targets of that kind all their errors are
/// zero.
bool IsAskedFor(const std::vector<double>& errors);

/// The ends of the body that have targets, in the order of the tree's effectors.
inline constexpr std::array kIkEnds{Role::kRightFoot, Role::kLeftHand, Role::kRightHand, Role::kHead};
/// The place of each target; nothing where no position is asked for.
using IkTargets = std::array<std::optional<glm::dvec3>, kIkEnds.size()>;

/// Two methods of inverse kinematics in the same world.
struct IkRace {
  std::string world;   ///< "joint_noise_deg=5, trial 0"
  std::string choice;  ///< why this world, and what was passed over, in words
  BodyPose truth;
  IkTargets targets;
  std::array<IkPath, 2> paths;

  int LastIteration() const;
};

/// Finds the first two methods that kept recordings, in the scenario's order, in the first world in which both did,
/// never the prettiest one. Fails, saying why, when there is no such world or its recordings cannot be read.
Result<IkRace> FindIkRace(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude

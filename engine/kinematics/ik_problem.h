#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/tree.h"
#include "engine/kinematics/weights.h"

namespace etude {

/// The pose X_WD that one end effector shall have, and how much each part of that matters.
struct EffectorTarget {
  glm::dvec3 position{0};      ///< p_WD, metres
  glm::dmat3 axes{1};          ///< R_WD: its three axes in the world, unit columns
  double position_weight = 1;  ///< multiplies the weight rule's w_p; 0 = the position is unknown
  glm::dvec3 axis_weights{1};  ///< multiplies w_o of each axis; (0, 0, 1) when only the limb's direction is known
};

/// Find angles that bring every end effector to its target, beginning with those of `start`, whose root stays where it
/// is.
struct IkProblem {
  TreeState start;
  std::vector<EffectorTarget> targets;  ///< one per effector of the tree, in its order
  std::vector<AngleRange> limits;       ///< one per degree of freedom, e.g. the tree's own
};

/// What all solvers can be set by; what only one of them can stands in its own header.
struct IkOptions {
  WeightRule weights = WeightRule::kAdaptive;  ///< CCD only
  WeightRefresh refresh = WeightRefresh::kSweep;
  /// For `IkSolver::solve`: the solver's own settings, one value for each of `IkSolver::settings`; none: its defaults.
  std::vector<double> solver_settings;
  bool limits = true;  ///< paper B, section 3.7.1; off: angles are free
  /// Paper B, section 3.7.2: no angle may leave its start angle by more than this (radians). Empty: no such bound.
  std::optional<double> angle_change_tolerance;
  int max_iterations = 200;
  /// Converged when every effector is nearer than the one, and every single axis of it than the other (axes and
  /// positions of weight 0 do not count): a mean over the axes would pass a limb that is twisted too far, since the
  /// axis that it is twisted about stays. The defaults are "solved practically": 0.1 cm and 0.1°.
  double position_goal = 0.001;     ///< metres
  double axis_goal = Radians(0.1);  ///< radians
  /// Stalled when no angle moves further than this in one iteration (radians): far below what any goal can see, and
  /// above rounding.
  double stall_change = 1e-10;
  bool trace = false;  ///< fill IkSolution::trace
  /// With so many entries at most, the first ones: an entry takes half a kilobyte and what it costs to know it.
  int longest_trace = std::numeric_limits<int>::max();

  bool operator==(const IkOptions&) const = default;
};

enum class IkStatus {
  kConverged,
  kStalled,      ///< the angles do not move any more, and a goal is not reached
  kUnreachable,  ///< not converged, and no pose could be: `IsOutOfReach`; the angles are the nearest that were found
  kIterationLimit,
  kBadInput,  ///< nothing was computed; angles are zeros
};

/// How far one end effector is from its target.
struct EffectorError {
  double position = 0;        ///< metres
  glm::dvec3 axis_angles{0};  ///< of each axis to its target, radians

  /// Mean over the axes of non-zero weight; 0 when there is none.
  double MeanAxisAngle(const glm::dvec3& axis_weights) const;
};

/// The state after one iteration; entry 0 is the start.
struct IkTraceEntry {
  double worst_position = 0;   ///< metres, the largest over the effectors
  double worst_axis = 0;       ///< radians, the largest of a single axis: what the goal is compared with
  double worst_mean_axis = 0;  ///< radians, the largest mean over an effector's axes
  std::vector<EffectorError> errors;
  std::vector<double> angles;
};

struct IkSolution {
  IkStatus status = IkStatus::kBadInput;
  std::vector<double> angles;  ///< one per degree of freedom, always finite
  std::vector<EffectorError> errors;
  int iterations = 0;
  int fk_evaluations = 0;  ///< forward-kinematics passes over the whole tree
  std::vector<IkTraceEntry> trace;
};

/// No number of a problem may be larger: beyond this (metres: 1,000 km), squares of distances lose what goals are made
/// of.
inline constexpr double kIkFarthest = 1e6;
/// How far squares of unit vectors, and the determinant of a frame, may be from 1.
inline constexpr double kUnitTolerance = 2e-6, kFrameTolerance = 1e-5;

/// Why a problem cannot be worked on, or empty when it can: joints that are no tree, angles that are not theirs one
/// after the other, sizes that do not fit it, values that are not finite or absurdly far (> 1,000 km), limbs of no
/// length (a joint may stand where the root does), limits whose lower end is above the upper, axes that are not unit
/// vectors, negative weights, an iteration limit below 1.
std::string_view FindFault(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);
/// The parts of it that are no single problem's, and the one that is: of a tree without faults.
std::string_view FindFault(const KinematicTree& tree, const IkOptions& options);
std::string_view FindTreeFault(const KinematicTree& tree);
std::string_view FindFault(const IkOptions& options);
std::string_view FindProblemFault(const KinematicTree& tree, const IkProblem& problem);

/// Whether the limbs are too short for the targets whatever the angles: an effector's target is farther from the root,
/// or two effectors' targets from each other, than all limbs between them together. `false` promises nothing.
bool IsOutOfReach(const KinematicTree& tree, const IkProblem& problem);

/// The range every angle may take: limits (when on) and the box of the angle-change tolerance, intersected. The box is
/// laid around the start angle after that was moved into its limits, so that the intersection is never empty.
std::vector<AngleRange> AllowedRanges(const IkProblem& problem, const IkOptions& options);
/// Of one angle.
AngleRange AllowedRange(double start_angle, const AngleRange& limits, const IkOptions& options);

EffectorError ErrorOf(const LimbFrame& effector, const EffectorTarget& target);

/// The largest errors over all effectors, counting only what has weight.
struct WorstError {
  double position = 0;  ///< metres
  double axis = 0;      ///< radians, of a single axis

  bool Within(const IkOptions& options) const { return position < options.position_goal && axis < options.axis_goal; }
};
WorstError FindWorst(std::span<const EffectorError> errors, std::span<const EffectorTarget> targets);

}  // namespace etude

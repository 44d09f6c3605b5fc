#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The rule by which an end effector's position counts against its three axes. Paper B, section 3.7.3, asks for weights
/// that follow the errors and gives no formula; the formulas are ours. e = distance to the target in cm, θ_k = angle of
/// axis k to its target.
enum class WeightRule {
  kFixed,          ///< w_p = 1, w_o = 1
  kFixedTuned,     ///< w_p = 0.0015, w_o = 1
  kAdaptive,       ///< w_p = e, w_ok = θ_k in degrees: B's rule, plain
  kAdaptiveTuned,  ///< w_p = 0.003 e, w_ok = θ_k in degrees
  kAdaptivePower,  ///< w_p = 5·10⁻⁵ e^0.75, w_ok = θ_k^0.75, radians
  kWangChen,       ///< w_p = 0.0007 (1 + min/max(|P_d|, |P_c|)), w_o = 1 (Wang and Chen 1991)
};

/// The step after which errors are measured anew for the weights that depend on them.
enum class WeightRefresh { kSweep, kJoint, kDof };

/// Return the names of scenario files: "fixed", "fixed-tuned", … and "sweep", "joint", "dof".
const std::vector<std::string>& WeightRuleNames();
const std::vector<std::string>& WeightRefreshNames();
std::optional<WeightRule> FindWeightRule(std::string_view name);
std::optional<WeightRefresh> FindWeightRefresh(std::string_view name);

/// The weights of one end effector.
struct EffectorWeights {
  double position = 1;  ///< w_p per square METRE (the formulas' value, which is per cm², times 10⁴)
  glm::dvec3 axes{1};   ///< w_o1, w_o2, w_o3
};

/// The power of an error that a weight grows with.
enum class ErrorPower { kNone, kThreeQuarters, kOne };

/// A rule as numbers: w_p = `position` · e^power, w_ok = `axis` · θ_k^power with e in metres and θ_k in radians.
struct WeightFormula {
  double position = 1;
  double axis = 1;
  ErrorPower power = ErrorPower::kNone;
};

/// Returns the rule as numbers; of `kWangChen` the part without ρ.
WeightFormula FormulaOf(WeightRule rule);

/// Returns whether the rule depends on errors. `kWangChen` does not: it depends on the joint that turns.
bool IsAdaptive(WeightRule rule);

/// Returns the weights by `rule` of an effector `distance` metres from its target with axes off by `axis_angles`
/// radians. For `kWangChen` this is the part without ρ; multiply `position` by `WangChenFactor` at each joint.
EffectorWeights ComputeWeights(WeightRule rule, double distance, const glm::dvec3& axis_angles);

/// Returns 1 + ρ, where ρ = min / max of the distances of the effector and of its target from the joint; 1 when both
/// are 0.
double WangChenFactor(const glm::dvec3& current, const glm::dvec3& desired);

/// The pose X_WD that one end effector shall have, and how much each part of that matters.
struct EffectorTarget {
  glm::dvec3 position{0};      ///< p_WD, metres
  glm::dmat3 axes{1};          ///< R_WD: its three axes in the world, unit columns
  double position_weight = 1;  ///< multiplies the weight rule's w_p; 0 = the position is unknown
  glm::dvec3 axis_weights{1};  ///< multiplies w_o of each axis; (0, 0, 1) when only the limb's direction is known
};

/// The task to find angles that bring every end effector to its target, beginning with those of `start`, whose root
/// stays where it is.
struct IkProblem {
  TreeState start;
  std::vector<EffectorTarget> targets;  ///< one per effector of the tree, in its order
  std::vector<AngleRange> limits;       ///< one per degree of freedom, e.g. the tree's own
};

/// What single solvers can be set by. Each reads its own, whose default and meaning stand in its header.
struct SolverSettings {
  std::optional<int> first_sweeps;      ///< gauss-newton
  std::optional<int> memory;            ///< ccd-anderson
  std::optional<double> damping_share;  ///< levenberg-marquardt
  std::optional<double> first_radius;   ///< ceres-lm
  std::optional<double> damping;        ///< damped-least-squares, damped-least-squares-active-set
  std::optional<double> pinv_damping;   ///< jacobian-pinv
  std::optional<double> gain;           ///< jacobian-transpose

  bool operator==(const SolverSettings&) const = default;
};

/// The settings that all solvers share, and those of single ones.
struct IkOptions {
  WeightRule weights = WeightRule::kAdaptive;  ///< CCD only
  WeightRefresh refresh = WeightRefresh::kSweep;
  SolverSettings solver_settings;  ///< for `IkSolver::solve`
  bool limits = true;              ///< paper B, section 3.7.1; off: angles are free
  /// No angle may leave its start angle by more than this, radians (paper B, section 3.7.2). Empty: no such bound.
  std::optional<double> angle_change_tolerance;
  int max_iterations = 200;
  /// A pose has converged when every effector is nearer than the one, and every single axis of it than the other (axes
  /// and positions of weight 0 do not count): a mean over the axes would pass a limb that is twisted too far, since the
  /// axis that it is twisted about stays. The defaults are "solved practically": 0.1 cm and 0.1°.
  double position_goal = 0.001;     ///< metres
  double axis_goal = Radians(0.1);  ///< radians
  /// A solver has stalled when no angle moves further than this in one iteration (radians): far below what any goal can
  /// see, and above rounding.
  double stall_change = 1e-10;
  bool trace = false;  ///< fill IkSolution::trace
  /// The trace keeps this many entries at most, the first ones: an entry takes half a kilobyte, and time to compute.
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

/// The distance of one end effector from its target.
struct EffectorError {
  double position = 0;        ///< metres
  glm::dvec3 axis_angles{0};  ///< of each axis to its target, radians

  /// Returns the mean over the axes of non-zero weight; 0 when there is none.
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
/// Squares of unit vectors, and the determinant of a frame, may differ from 1 by this much.
inline constexpr double kUnitTolerance = 2e-6, kFrameTolerance = 1e-5;

/// Returns why a problem cannot be worked on, or empty when it can: joints that are no tree, angles that are not theirs
/// one after the other, sizes that do not fit it, values that are not finite or absurdly far (> 1,000 km), limbs of no
/// length (a joint may stand where the root does), limits whose lower end is above the upper, axes that are not unit
/// vectors, negative weights, an iteration limit below 1.
std::string_view FindFault(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);
/// Find the faults of the tree, of the options or of both; and of one problem of a tree without faults.
std::string_view FindFault(const KinematicTree& tree, const IkOptions& options);
std::string_view FindTreeFault(const KinematicTree& tree);
std::string_view FindFault(const IkOptions& options);
std::string_view FindProblemFault(const KinematicTree& tree, const IkProblem& problem);

/// Returns whether the limbs are too short for the targets whatever the angles: an effector's target is farther from
/// the root, or two effectors' targets from each other, than all limbs between them together. `false` promises nothing.
bool IsOutOfReach(const KinematicTree& tree, const IkProblem& problem);

/// Returns the range that every angle may take: limits (when on) and the box of the angle-change tolerance,
/// intersected. The box is laid around the start angle after that was moved into its limits, so that the intersection
/// is never empty.
std::vector<AngleRange> AllowedRanges(const IkProblem& problem, const IkOptions& options);
/// Returns that range of one angle.
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

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

namespace [[gnu::visibility("default")]] etude {

/// The rule that weights an end effector's position error against the errors of the effector's three axes. Paper B,
/// section 3.7.3, proposes weights that depend on the errors but gives no formula; the formulas are ours. Here e is the
/// distance to the target in cm, and θ_k the angle of axis k to its target axis.
enum class WeightRule {
  kFixed,          ///< w_p = 1, w_o = 1
  kFixedTuned,     ///< w_p = 0.0015, w_o = 1
  kAdaptive,       ///< w_p = e, w_ok = θ_k in degrees: B's proposal without factors
  kAdaptiveTuned,  ///< w_p = 0.003 e, w_ok = θ_k in degrees
  kAdaptivePower,  ///< w_p = 5·10⁻⁵ e^0.75, w_ok = θ_k^0.75, radians
  kWangChen,       ///< w_p = 0.0007 · `WangChenFactor`, w_o = 1 (Wang and Chen 1991)
};

/// The interval at which a solver recomputes adaptive weights: once per sweep, joint, or degree of freedom.
enum class WeightRefresh { kSweep, kJoint, kDof };

/// Returns the names that scenario files use: "fixed", "fixed-tuned", … and "sweep", "joint", "dof".
const std::vector<std::string>& WeightRuleNames();
const std::vector<std::string>& WeightRefreshNames();
std::optional<WeightRule> FindWeightRule(std::string_view name);
std::optional<WeightRefresh> FindWeightRefresh(std::string_view name);

/// The weights of one end effector.
struct EffectorWeights {
  double position = 1;  ///< w_p per square METRE: the formula's value, which is per cm², times 10⁴
  glm::dvec3 axes{1};   ///< w_o1, w_o2, w_o3
};

/// The power of the error to which a weight is proportional.
enum class ErrorPower { kNone, kThreeQuarters, kOne };

/// A weight rule in SI units: w_p = `position` · e^power, w_ok = `axis` · θ_k^power, e in metres, θ_k in radians.
struct WeightFormula {
  double position = 1;
  double axis = 1;
  ErrorPower power = ErrorPower::kNone;
};

/// Returns the rule in SI units; for `kWangChen` the formula lacks the factor 1 + ρ.
WeightFormula FormulaOf(WeightRule rule);

/// Returns true if the weights depend on the errors. Returns false for `kWangChen`, whose weights depend on the joint
/// that turns.
bool IsAdaptive(WeightRule rule);

/// Returns the weights of an effector that is `distance` metres from its target and whose axes are off by `axis_angles`
/// radians. For `kWangChen` the factor 1 + ρ is missing: multiply `position` by `WangChenFactor` at each joint.
EffectorWeights ComputeWeights(WeightRule rule, double distance, const glm::dvec3& axis_angles);

/// Returns 1 + ρ, where ρ is the ratio min / max of two distances from the joint: the effector's and the target's.
/// Returns 1 if both distances are 0.
double WangChenFactor(const glm::dvec3& current, const glm::dvec3& desired);

/// The desired pose X_WD of one end effector, and the weights of its position and of its axes.
struct EffectorTarget {
  glm::dvec3 position{0};      ///< p_WD, metres
  glm::dmat3 axes{1};          ///< R_WD: the desired axes in the world, as unit columns
  double position_weight = 1;  ///< multiplies w_p of the weight rule; 0 if the position is unknown
  glm::dvec3 axis_weights{1};  ///< multiplies w_o of each axis; (0, 0, 1) when only the limb's direction is known
};

/// The problem of finding angles that bring every end effector to its target. The search begins at the angles of
/// `start`; the root of `start` stays fixed.
struct IkProblem {
  TreeState start;
  std::vector<EffectorTarget> targets;  ///< one per effector of the tree, in the tree's order
  std::vector<AngleRange> limits;       ///< one per degree of freedom; usually the tree's own limits
};

/// The settings of single solvers. The comment behind a setting names the solver that reads it; the solver's header
/// explains the setting and its default.
struct SolverSettings {
  std::optional<int> first_sweeps = {};      ///< read by gauss-newton
  std::optional<int> memory = {};            ///< read by ccd-anderson
  std::optional<double> damping_share = {};  ///< read by levenberg-marquardt
  std::optional<double> first_radius = {};   ///< read by ceres-lm
  std::optional<double> damping = {};        ///< read by damped-least-squares, damped-least-squares-active-set
  std::optional<double> pinv_damping = {};   ///< read by jacobian-pinv
  std::optional<double> gain = {};           ///< read by jacobian-transpose

  bool operator==(const SolverSettings&) const = default;
};

/// Options that all solvers share. A solver's own options are in the solver's header.
struct IkOptions {
  WeightRule weights = WeightRule::kAdaptive;  ///< the rule of weights; only the CCD solvers read this option
  WeightRefresh refresh = WeightRefresh::kSweep;
  SolverSettings solver_settings;  ///< settings of single solvers, which `IkSolver::solve` reads
  bool limits = true;              ///< true: angles stay within their limits (paper B, 3.7.1); false: they are free
  /// Maximum difference between an angle and its start angle, radians (paper B, section 3.7.2). nullopt means no limit.
  std::optional<double> angle_change_tolerance;
  int max_iterations = 200;
  /// A pose has converged if every effector is nearer to its target than `position_goal`, and each of the effector's
  /// axes is nearer to the target's axis than `axis_goal`. Axes and positions of weight 0 do not count. (A mean over
  /// the axes would accept a twisted limb, because a twist does not change the limb's own axis.) The defaults, 0.1 cm
  /// and 0.1°, are accurate enough for practical use.
  double position_goal = 0.001;     ///< metres
  double axis_goal = Radians(0.1);  ///< radians
  /// A solver has stalled if no angle changes by more than `stall_change` radians in one iteration. The default is far
  /// below any goal and above rounding.
  double stall_change = 1e-10;
  bool trace = false;  ///< if true, IkSolution::trace is filled
  /// Maximum number of trace entries; later entries are dropped. Lower it for long runs: an entry takes half a kilobyte
  /// and costs time.
  int max_trace_entries = std::numeric_limits<int>::max();

  bool operator==(const IkOptions&) const = default;
};

enum class IkStatus {
  kConverged,
  kStalled,      ///< the angles no longer move, and a goal is not reached
  kUnreachable,  ///< not converged, and no pose can converge (`IsOutOfReach`); the angles are the best that were found
  kIterationLimit,
  kBadInput,  ///< the input has a fault (`FindFault`); nothing was computed, all angles are 0
};

/// The distance of one end effector from its target.
struct EffectorError {
  double position = 0;        ///< metres
  glm::dvec3 axis_angles{0};  ///< angles between the axes and their target axes, radians

  /// Returns the mean of `axis_angles` over the axes of positive weight, radians; 0 if no weight is positive.
  double MeanAxisAngle(const glm::dvec3& axis_weights) const;
};

/// The errors after one iteration of a solver; entry 0 of a trace has the errors of the start pose.
struct IkTraceEntry {
  double worst_position = 0;   ///< metres, the largest over the effectors
  double worst_axis = 0;       ///< radians, the largest of a single axis; `axis_goal` is the limit for this error
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

/// Upper bound on the magnitude of every number of a problem (in metres: 1,000 km). For larger numbers, squared
/// distances lose the digits that the goals depend on.
inline constexpr double kMaxIkValue = 1e6;
/// Tolerances for two numbers that should be 1: the squared length of an axis, and the determinant of a frame.
inline constexpr double kUnitTolerance = 2e-6, kFrameTolerance = 1e-5;

/// Returns the fault of a problem as text, or an empty text if there is none. Faults are: joints that form no tree;
/// degrees of freedom that are not numbered consecutively; lists whose sizes do not fit the tree; values that are not
/// finite or exceed `kMaxIkValue`; limbs of zero length (a joint may coincide with the root); limits with lower >
/// upper; axes that are not orthonormal; negative weights; an iteration limit below 1.
std::string_view FindFault(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);
/// Each of the following four functions makes some of these checks: the first checks tree and options, the second only
/// the tree, the third only the options, the fourth a problem whose tree has no faults.
std::string_view FindFault(const KinematicTree& tree, const IkOptions& options);
std::string_view FindTreeFault(const KinematicTree& tree);
std::string_view FindFault(const IkOptions& options);
std::string_view FindProblemFault(const KinematicTree& tree, const IkProblem& problem);

/// Returns true if the limbs are certainly too short for the targets at any angles: the target of an effector is
/// farther from the root, or from another effector's target, than the total length of the limbs in between. If it
/// returns false, the targets may still be unreachable.
bool IsOutOfReach(const KinematicTree& tree, const IkProblem& problem);

/// Returns the range that each angle may take: the angle's limits (if `IkOptions::limits` is true), intersected with
/// the angle-change tolerance around the start angle. The start angle is first clamped to the limits, so the
/// intersection is never empty.
std::vector<AngleRange> AllowedRanges(const IkProblem& problem, const IkOptions& options);
/// Returns the range that one angle may take, by the rule of `AllowedRanges`.
AngleRange AllowedRange(double start_angle, const AngleRange& limits, const IkOptions& options);

/// Returns the distance of an effector from its target, and the angles between the effector's and the target's axes.
EffectorError ErrorOf(const LimbFrame& effector, const EffectorTarget& target);

/// The largest errors over all effectors; positions and axes of weight 0 do not count.
struct WorstError {
  double position = 0;  ///< metres
  double axis = 0;      ///< radians, of a single axis

  /// Returns true if `position` and `axis` are below their goals; false for NaN.
  bool Within(const IkOptions& options) const { return position < options.position_goal && axis < options.axis_goal; }
};
/// Returns the largest errors of all effectors.
WorstError FindWorst(std::span<const EffectorError> errors, std::span<const EffectorTarget> targets);

}  // namespace etude

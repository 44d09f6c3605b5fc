#include "engine/kinematics/ik_problem.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/named.h"

namespace etude {
namespace {

constexpr double kCmPerMetre = 100;
constexpr double kPerSquareCm = kCmPerMetre * kCmPerMetre;  // converts a weight per cm² to one per m²

constexpr Named<WeightRule> kRules[] = {{"fixed", WeightRule::kFixed},
                                        {"fixed-tuned", WeightRule::kFixedTuned},
                                        {"adaptive", WeightRule::kAdaptive},
                                        {"adaptive-tuned", WeightRule::kAdaptiveTuned},
                                        {"adaptive-power", WeightRule::kAdaptivePower},
                                        {"wang-chen", WeightRule::kWangChen}};
constexpr Named<WeightRefresh> kRefreshes[] = {
    {"sweep", WeightRefresh::kSweep}, {"joint", WeightRefresh::kJoint}, {"dof", WeightRefresh::kDof}};

// These checks use `&` instead of `&&` to avoid branches. NaN fails every comparison, so NaN is never sane.
inline bool IsSane(double value) { return std::abs(value) <= kMaxIkValue; }
inline bool IsSane(const glm::dvec3& v) { return IsSane(v.x) & IsSane(v.y) & IsSane(v.z); }

inline bool IsUnit(const glm::dvec3& axis) { return std::abs(glm::dot(axis, axis) - 1) <= kUnitTolerance; }

inline bool IsWeight(double weight) { return (weight >= 0) & (weight <= kMaxIkValue); }

// Returns true for unit axes at right angles to each other that form a right-handed frame.
inline bool IsAFrame(const glm::dmat3& axes) {
  return IsUnit(axes[0]) & IsUnit(axes[1]) & IsUnit(axes[2]) & (std::abs(glm::determinant(axes) - 1) < kFrameTolerance);
}

inline bool IsGood(const EffectorTarget& target) {
  return IsWeight(target.position_weight) & IsWeight(target.axis_weights.x) & IsWeight(target.axis_weights.y) &
         IsWeight(target.axis_weights.z) & IsSane(target.position) & IsAFrame(target.axes);
}

// Returns true if the first joint is the only root and does not turn, parents come before children, degrees of freedom
// are numbered consecutively, and all indices are valid.
bool IsATree(const KinematicTree& tree) {
  const int joints = static_cast<int>(tree.joints.size());
  int dofs = 0;
  if (joints == 0 || tree.joints[0].parent >= 0 || tree.joints[0].dof_count != 0) return false;
  for (int n = 1; n < joints; ++n) {
    const TreeJoint& joint = tree.joints[n];
    if (joint.parent < 0 || joint.parent >= n || !IsAFrame(joint.R_PJ)) return false;
    if (joint.dof_count < 0 || joint.dof_count > 3) return false;
    if (joint.dof_count > 0 && joint.first_dof != dofs) return false;
    dofs += joint.dof_count;
  }
  if (dofs != tree.dof_count()) return false;
  return std::ranges::all_of(tree.effectors, [&](const Effector& e) { return e.joint >= 0 && e.joint < joints; });
}

// A point whose world position is fixed by a target, and the chain of joints from this point to the root.
struct FixedPoint {
  glm::dvec3 position;
  std::vector<int> joints;  // from the point to the root
  double last_limb = 0;     // distance of the point from the first of `joints`, metres
};

FixedPoint FixedBy(const KinematicTree& tree, const Effector& effector, const EffectorTarget& target) {
  FixedPoint point{target.position, {}, glm::length(effector.p_LE)};
  const glm::dvec3& w = target.axis_weights;
  if (w.x > 0 && w.y > 0 && w.z > 0) {  // if all axes have targets, the limb's joint is fixed, too
    point.position -= target.axes * effector.p_LE;
    point.last_limb = 0;
  }
  for (int joint = effector.joint; joint >= 0; joint = tree.joints[joint].parent) point.joints.push_back(joint);
  return point;
}

// The chain of limbs from a point up to a joint.
struct Branch {
  double length = 0;  // total length of the chain's limbs, metres
  int top = -1;       // the last joint of the chain; −1 if it has none
};

// Returns the chain from `point` up to the first joint in `shared`, or up to the root.
Branch BranchOf(const KinematicTree& tree, const FixedPoint& point, std::span<const int> shared) {
  Branch branch{point.last_limb, -1};
  for (const int joint : point.joints) {
    if (std::ranges::find(shared, joint) != shared.end() || tree.joints[joint].parent < 0) break;
    branch.length += glm::length(tree.joints[joint].p_PJ);
    branch.top = joint;
  }
  return branch;
}

// Returns the largest possible distance between two points: the length of the limbs between them when stretched out.
double LongestBetween(const KinematicTree& tree, const FixedPoint& a, const FixedPoint& b) {
  const Branch to_a = BranchOf(tree, a, b.joints), to_b = BranchOf(tree, b, a.joints);
  if (to_a.top < 0 || to_b.top < 0) return to_a.length + to_b.length;
  // Both chains end at joints of the same rigid limb, so the distance between these two joints is constant.
  const glm::dvec3& p_PA = tree.joints[to_a.top].p_PJ;
  const glm::dvec3& p_PB = tree.joints[to_b.top].p_PJ;
  return to_a.length + to_b.length - glm::length(p_PA) - glm::length(p_PB) + glm::distance(p_PA, p_PB);
}

}  // namespace

const std::vector<std::string>& WeightRuleNames() {
  static const std::vector<std::string> names = NamesOf(kRules);
  return names;
}

const std::vector<std::string>& WeightRefreshNames() {
  static const std::vector<std::string> names = NamesOf(kRefreshes);
  return names;
}

std::optional<WeightRule> FindWeightRule(std::string_view name) { return FindValue(kRules, name); }

std::optional<WeightRefresh> FindWeightRefresh(std::string_view name) { return FindValue(kRefreshes, name); }

WeightFormula FormulaOf(WeightRule rule) {
  constexpr double kRoot = 31.622776601683793;  // 100^0.75, which converts e^0.75 from metres to centimetres
  switch (rule) {
    case WeightRule::kFixed:
      return {kPerSquareCm, 1, ErrorPower::kNone};
    case WeightRule::kFixedTuned:
      return {0.0015 * kPerSquareCm, 1, ErrorPower::kNone};
    case WeightRule::kAdaptive:
      return {kCmPerMetre * kPerSquareCm, Degrees(1), ErrorPower::kOne};
    case WeightRule::kAdaptiveTuned:
      return {0.003 * kCmPerMetre * kPerSquareCm, Degrees(1), ErrorPower::kOne};
    case WeightRule::kAdaptivePower:
      return {5e-5 * kRoot * kPerSquareCm, 1, ErrorPower::kThreeQuarters};
    case WeightRule::kWangChen:
      return {0.0007 * kPerSquareCm, 1, ErrorPower::kNone};
  }
  return {};
}

bool IsAdaptive(WeightRule rule) { return FormulaOf(rule).power != ErrorPower::kNone; }

EffectorWeights ComputeWeights(WeightRule rule, double distance, const glm::dvec3& axis_angles) {
  const WeightFormula formula = FormulaOf(rule);
  const auto power = [&formula](double error) {
    switch (formula.power) {
      case ErrorPower::kNone:
        return 1.0;
      case ErrorPower::kThreeQuarters:
        return std::sqrt(error * std::sqrt(error));  // gives the same bits with every libm, unlike std::pow
      case ErrorPower::kOne:
        return error;
    }
    return 1.0;
  };
  return {formula.position * power(distance),
          formula.axis * glm::dvec3(power(axis_angles.x), power(axis_angles.y), power(axis_angles.z))};
}

double WangChenFactor(const glm::dvec3& current, const glm::dvec3& desired) {
  const double c = glm::length(current), d = glm::length(desired);
  const double larger = std::max(c, d);
  return larger > 0 ? 1 + std::min(c, d) / larger : 1;
}

double EffectorError::MeanAxisAngle(const glm::dvec3& axis_weights) const {
  double sum = 0;
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    if (axis_weights[k] <= 0) continue;
    sum += axis_angles[k];
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

std::string_view FindTreeFault(const KinematicTree& tree) {
  if (!IsATree(tree)) return "the joints do not form a tree whose first joint is the root";
  for (const TreeJoint& joint : tree.joints) {
    if (joint.parent < 0) continue;
    // A child of the root may coincide with the root; such a joint lets the whole tree turn.
    if (!IsSane(joint.p_PJ) || (joint.parent > 0 && glm::length(joint.p_PJ) <= 0)) return "a limb has no length";
  }
  for (const Effector& effector : tree.effectors) {
    if (!IsSane(effector.p_LE) || glm::length(effector.p_LE) <= 0) return "a limb has no length";
  }
  return {};
}

std::string_view FindFault(const IkOptions& options) {
  const double change = options.angle_change_tolerance.value_or(0);
  if (!std::isfinite(change) || change < 0) return "the angle-change tolerance is negative or not finite";
  if (options.max_iterations < 1) return "the iteration limit is below 1";
  return {};
}

std::string_view FindFault(const KinematicTree& tree, const IkOptions& options) {
  const std::string_view fault = FindTreeFault(tree);
  return fault.empty() ? FindFault(options) : fault;
}

std::string_view FindFault(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  const std::string_view fault = FindFault(tree, options);
  return fault.empty() ? FindProblemFault(tree, problem) : fault;
}

std::string_view FindProblemFault(const KinematicTree& tree, const IkProblem& problem) {
  const std::size_t dofs = tree.limits.size();
  if (problem.start.angles.size() != dofs || problem.limits.size() != dofs)
    return "the number of angles or limits is not the tree's number of degrees of freedom";
  if (problem.targets.size() != tree.effectors.size())
    return "the number of targets is not the tree's number of end effectors";
  if (!IsSane(problem.start.root_position) || !IsAFrame(problem.start.root_frame))
    return "the root's position is not finite or too large, or the root's axes are not orthonormal";
  bool are_angles_sane = true, are_limits_good = true, are_targets_good = true;
  for (const double angle : problem.start.angles) are_angles_sane &= IsSane(angle);
  if (!are_angles_sane) return "a start angle is not finite";
  for (const AngleRange& range : problem.limits) {
    are_limits_good &= IsSane(range.lower) & IsSane(range.upper) & (range.lower <= range.upper);
  }
  if (!are_limits_good) return "an angle limit is not finite or too large, or a lower limit is above the upper limit";
  for (const EffectorTarget& target : problem.targets) are_targets_good &= IsGood(target);
  if (!are_targets_good) {
    return "a target is invalid; allowed: a finite position, orthonormal axes, finite weights of 0 or more";
  }
  return {};
}

bool IsOutOfReach(const KinematicTree& tree, const IkProblem& problem) {
  constexpr double kRounding = 1e-9;  // tolerance for rounding, metres
  std::vector<FixedPoint> points;
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    if (problem.targets[e].position_weight <= 0) continue;
    // Compare the distance to the root, then to every earlier target, with the total length of the limbs in between.
    const FixedPoint point = FixedBy(tree, tree.effectors[e], problem.targets[e]);
    const double from_root = glm::distance(point.position, problem.start.root_position);
    if (from_root > BranchOf(tree, point, {}).length + kRounding) return true;
    for (const FixedPoint& other : points) {
      if (glm::distance(point.position, other.position) > LongestBetween(tree, point, other) + kRounding) return true;
    }
    points.push_back(point);
  }
  return false;
}

AngleRange AllowedRange(double start_angle, const AngleRange& limits, const IkOptions& options) {
  AngleRange range{-kMaxIkValue, kMaxIkValue};
  if (options.limits) range = limits;
  if (!options.angle_change_tolerance) return range;
  const double start = std::clamp(start_angle, range.lower, range.upper);
  return {std::max(range.lower, start - *options.angle_change_tolerance),
          std::min(range.upper, start + *options.angle_change_tolerance)};
}

std::vector<AngleRange> AllowedRanges(const IkProblem& problem, const IkOptions& options) {
  std::vector<AngleRange> ranges(problem.limits.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i] = AllowedRange(problem.start.angles[i], problem.limits[i], options);
  }
  return ranges;
}

EffectorError ErrorOf(const LimbFrame& effector, const EffectorTarget& target) {
  EffectorError error;
  error.position = glm::length(target.position - effector.position);
  for (int k = 0; k < 3; ++k) error.axis_angles[k] = AngleBetween(effector.axes[k], target.axes[k]);
  return error;
}

WorstError FindWorst(std::span<const EffectorError> errors, std::span<const EffectorTarget> targets) {
  WorstError worst;
  for (std::size_t e = 0; e < errors.size(); ++e) {
    if (targets[e].position_weight > 0) worst.position = std::max(worst.position, errors[e].position);
    for (int k = 0; k < 3; ++k) {
      if (targets[e].axis_weights[k] > 0) worst.axis = std::max(worst.axis, errors[e].axis_angles[k]);
    }
  }
  return worst;
}

}  // namespace etude

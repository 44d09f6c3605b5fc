#include "engine/kinematics/solvers/ccd_sweep.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/euler.h"
#include "engine/kinematics/solvers/hinge_gain.h"

namespace etude {

CcdSweep::CcdSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind)
    : tree_(tree),
      problem_(problem),
      options_(options),
      joint_kind_(joint_kind),
      ranges_(AllowedRanges(problem, options)),
      effectors_below_(tree.joints.size()),
      state_(problem.start),
      errors_(tree.effectors.size()),
      weights_(tree.effectors.size()) {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    for (int joint = tree.effectors[e].joint; joint >= 0; joint = tree.joints[joint].parent) {
      effectors_below_[joint].push_back(static_cast<int>(e));
    }
  }
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    state_.angles[i] = std::clamp(state_.angles[i], ranges_[i].lower, ranges_[i].upper);
  }
  UpdateFrames();
}

double CcdSweep::Sweep() {
  // The last FK has measured the errors that the weights of this sweep go by.
  for (std::size_t e = 0; e < weights_.size(); ++e) {
    weights_[e] = ComputeWeights(options_.weights, errors_[e].position, errors_[e].axis_angles);
  }
  double largest = 0;
  for (int joint = static_cast<int>(tree_.joints.size()) - 1; joint >= 0; --joint) {
    if (tree_.joints[joint].dof_count == 0 || effectors_below_[joint].empty()) continue;
    if (options_.refresh == WeightRefresh::kJoint) UpdateWeightsBelow(joint);
    const bool whole = joint_kind_ == CcdJoint::kWhole && tree_.joints[joint].dof_count > 1;
    largest = std::max(largest, whole ? TurnWhole(joint) : TurnAsHinges(joint));
  }
  UpdateFrames();
  return largest;
}

void CcdSweep::UpdateFrames() {
  ComputeFrames(tree_, state_, frames_);
  for (std::size_t e = 0; e < errors_.size(); ++e) errors_[e] = ErrorOf(frames_.effectors[e], problem_.targets[e]);
}

void CcdSweep::UpdateWeightsBelow(int joint) {
  if (!IsAdaptive(options_.weights)) return;
  for (int e : effectors_below_[joint]) {
    const EffectorError error = ErrorOf(frames_.effectors[e], problem_.targets[e]);
    weights_[e] = ComputeWeights(options_.weights, error.position, error.axis_angles);
  }
}

HingeGain CcdSweep::GainAbout(const glm::dvec3& axis, int joint) const {
  const glm::dvec3& pivot = frames_.joints[joint].position;
  HingeGain gain;
  for (int e : effectors_below_[joint]) {
    const EffectorTarget& target = problem_.targets[e];
    const glm::dvec3 current = frames_.effectors[e].position - pivot, desired = target.position - pivot;
    double position_weight = weights_[e].position * target.position_weight;
    if (options_.weights == WeightRule::kWangChen) position_weight *= WangChenFactor(current, desired);
    gain.Add(position_weight, current, desired, axis);
    const glm::dvec3 axis_weights = weights_[e].axes * target.axis_weights;
    for (int k = 0; k < 3; ++k) gain.Add(axis_weights[k], frames_.effectors[e].axes[k], target.axes[k], axis);
  }
  return gain;
}

void CcdSweep::TurnBelow(int joint, const glm::dmat3& rotation) {
  const glm::dvec3& pivot = frames_.joints[joint].position;
  for (int e : effectors_below_[joint]) {
    LimbFrame& effector = frames_.effectors[e];
    effector = {pivot + rotation * (effector.position - pivot), rotation * effector.axes};
  }
}

// One degree of freedom (paper B, case 1). Returns how far it turned.
double CcdSweep::TurnHinge(int joint, int axis) {
  if (options_.refresh == WeightRefresh::kDof) UpdateWeightsBelow(joint);
  const int dof = tree_.joints[joint].first_dof + axis;
  double& angle = state_.angles[dof];
  const glm::dvec3 world_axis = DofAxis(tree_.joints[joint], frames_.bases[joint], state_.angles, axis);
  const AngleRange left{ranges_[dof].lower - angle, ranges_[dof].upper - angle};
  const double turn = GainAbout(world_axis, joint).OptimumWithin(left);
  // (upper − angle) + angle may miss upper by a rounding.
  angle = std::clamp(angle + turn, ranges_[dof].lower, ranges_[dof].upper);
  TurnBelow(joint, AxisRotation(world_axis, turn));
  return std::abs(turn);
}

double CcdSweep::TurnAsHinges(int joint) {
  double largest = 0;
  // The innermost axis is nearest to the leaves: turning it leaves the others' axes where they are.
  for (int axis = tree_.joints[joint].dof_count - 1; axis >= 0; --axis) {
    largest = std::max(largest, TurnHinge(joint, axis));
  }
  return largest;
}

double CcdSweep::TurnWhole(int joint) {
  const TreeJoint& limb = tree_.joints[joint];
  const glm::dmat3& base = frames_.bases[joint];
  glm::dvec3 angles = JointAngles(limb, state_.angles);
  const glm::dvec3 before = angles;
  for (int axis = 0; axis < limb.dof_count; ++axis) {
    if (options_.refresh == WeightRefresh::kDof) UpdateWeightsBelow(joint);
    const glm::dmat3 rotation = RotationXyz(angles);
    const double turn = GainAbout(base[axis], joint).Optimum();
    glm::dvec3 wanted(0);
    wanted[axis] = turn;
    angles = AnglesXyz(RotationXyz(wanted) * rotation);
    for (int k = 0; k < 3; ++k) {
      const int dof = limb.first_dof + k;
      angles[k] = k < limb.dof_count ? ClampAngle(angles[k], ranges_[dof]) : 0;
    }
    TurnBelow(joint, base * RotationXyz(angles) * glm::transpose(rotation) * glm::transpose(base));
  }
  double largest = 0;
  for (int k = 0; k < limb.dof_count; ++k) {
    state_.angles[limb.first_dof + k] = angles[k];
    largest = std::max(largest, std::abs(angles[k] - before[k]));
  }
  return largest;
}

}  // namespace etude

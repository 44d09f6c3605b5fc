#include "engine/kinematics/solvers/ccd.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/euler.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"

namespace etude {
namespace {

IkSolution SolveBySweeps(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                         CcdJoint joint_kind) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  CcdSweep ccd(tree, problem, options, joint_kind);
  run.Record(ccd.errors(), ccd.angles());
  while (run.MustGoOn()) {
    const double change = ccd.Sweep();
    run.Record(ccd.errors(), ccd.angles());
    if (change < options.stall_change) run.Stall();
  }
  return run.Finish({ccd.angles().begin(), ccd.angles().end()});
}

// R · R_JL, R the rotation by `angle` about J's coordinate axis `axis`.
glm::dmat3 TurnedAbout(int axis, double angle, glm::dmat3 R_JL) {
  const double c = std::cos(angle), s = std::sin(angle);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  for (int column = 0; column < 3; ++column) {
    const double x = R_JL[column][i], y = R_JL[column][j];
    R_JL[column][i] = c * x - s * y;
    R_JL[column][j] = s * x + c * y;
  }
  return R_JL;
}

}  // namespace

IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return SolveBySweeps(tree, problem, options, CcdJoint::kWhole);
}

IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!MomentSweep::CanServe(options)) return SolveBySweeps(tree, problem, options, CcdJoint::kHinges);
  return RunSweeps<MomentSweep>(tree, problem, options, [](MomentSweep& sweep, IkRun&) { return sweep.Sweep(); });
}

double HingeGain::At(double phi) const {
  const double c = std::cos(phi);
  return k1 * (1 - c) + k2 * c + k3 * std::sin(phi);
}

double HingeGain::Optimum() const {
  if (k3 == 0 && k2 == k1) return 0;
  return std::atan2(k3, k2 - k1);
}

double HingeGain::OptimumWithin(const AngleRange& range) const {
  if (k3 == 0 && k2 == k1) return 0;
  const double best = Optimum();
  for (const double phi : {best, best - 2 * kPi, best + 2 * kPi}) {
    if (phi >= range.lower && phi <= range.upper) return phi;
  }
  return At(range.upper) > At(range.lower) ? range.upper : range.lower;
}

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
  SetAngles(problem.start.angles);
  Measure();
}

double CcdSweep::Sweep() {
  const double change = Turn();
  Measure();
  return change;
}

double CcdSweep::Turn() {
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
  return largest;
}

void CcdSweep::Measure() {
  ComputeFrames(tree_, state_, frames_);
  for (std::size_t e = 0; e < errors_.size(); ++e) errors_[e] = ErrorOf(frames_.effectors[e], problem_.targets[e]);
}

double CcdSweep::Merit() const {
  double merit = 0;
  for (std::size_t e = 0; e < weights_.size(); ++e) {
    const EffectorTarget& target = problem_.targets[e];
    merit += weights_[e].position * target.position_weight * errors_[e].position * errors_[e].position;
    const glm::dvec3 chords = 2.0 * glm::sin(0.5 * errors_[e].axis_angles);
    merit += glm::dot(weights_[e].axes * target.axis_weights, chords * chords);
  }
  return merit;
}

void CcdSweep::SetAngles(std::span<const double> angles) {
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    state_.angles[i] = std::clamp(angles[i], ranges_[i].lower, ranges_[i].upper);
  }
}

void CcdSweep::UpdateWeightsBelow(int joint) {
  if (!IsAdaptive(options_.weights)) return;
  for (int e : effectors_below_[joint]) {
    const EffectorError error = ErrorOf(frames_.effectors[e], problem_.targets[e]);
    weights_[e] = ComputeWeights(options_.weights, error.position, error.axis_angles);
  }
}

HingeGain CcdSweep::GainAbout(const glm::dvec3& axis_W, int joint) const {
  const glm::dvec3& p_WJ = frames_.joints[joint].position;
  HingeGain gain;
  for (int e : effectors_below_[joint]) {
    const EffectorTarget& target = problem_.targets[e];
    const glm::dvec3 p_JE_W = frames_.effectors[e].position - p_WJ, p_JD_W = target.position - p_WJ;
    double position_weight = weights_[e].position * target.position_weight;
    if (options_.weights == WeightRule::kWangChen) position_weight *= WangChenFactor(p_JE_W, p_JD_W);
    gain.Add(position_weight, p_JE_W, p_JD_W, axis_W);
    const glm::dvec3 axis_weights = weights_[e].axes * target.axis_weights;
    for (int k = 0; k < 3; ++k) gain.Add(axis_weights[k], frames_.effectors[e].axes[k], target.axes[k], axis_W);
  }
  return gain;
}

// By a rotation of the world.
void CcdSweep::TurnBelow(int joint, const glm::dmat3& rotation) {
  const glm::dvec3& p_WJ = frames_.joints[joint].position;
  for (int e : effectors_below_[joint]) {
    LimbFrame& X_WE = frames_.effectors[e];
    X_WE = {p_WJ + rotation * (X_WE.position - p_WJ), rotation * X_WE.axes};
  }
}

// One degree of freedom (paper B, case 1). Returns how far it turned.
double CcdSweep::TurnHinge(int joint, int axis) {
  if (options_.refresh == WeightRefresh::kDof) UpdateWeightsBelow(joint);
  const int dof = tree_.joints[joint].first_dof + axis;
  double& angle = state_.angles[dof];
  const glm::dvec3& axis_W = frames_.dof_axes[dof];  // nothing that carries it has turned since the last FK
  const AngleRange left{ranges_[dof].lower - angle, ranges_[dof].upper - angle};
  const double turn = GainAbout(axis_W, joint).OptimumWithin(left);
  // (upper − angle) + angle may miss upper by a rounding.
  angle = std::clamp(angle + turn, ranges_[dof].lower, ranges_[dof].upper);
  TurnBelow(joint, AxisRotation(axis_W, turn));
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
  const glm::dmat3& R_WJ = frames_.R_WJ[joint];
  glm::dvec3 angles = JointAngles(limb, state_.angles);
  const glm::dvec3 before = angles;
  glm::dmat3 R_JL = RotationXyz(angles);
  for (int axis = 0; axis < limb.dof_count; ++axis) {
    if (options_.refresh == WeightRefresh::kDof) UpdateWeightsBelow(joint);
    const double turn = GainAbout(R_WJ[axis], joint).Optimum();
    const glm::dmat3 best_R_JL = TurnedAbout(axis, turn, R_JL);
    const glm::dvec3 best_angles = AnglesXyz(best_R_JL);
    for (int k = 0; k < 3; ++k) {
      const int dof = limb.first_dof + k;
      angles[k] = k < limb.dof_count ? ClampAngle(best_angles[k], ranges_[dof]) : 0;
    }
    const glm::dmat3 new_R_JL = angles == best_angles ? best_R_JL : RotationXyz(angles);
    TurnBelow(joint, R_WJ * new_R_JL * glm::transpose(R_JL) * glm::transpose(R_WJ));
    R_JL = new_R_JL;
  }
  double largest = 0;
  for (int k = 0; k < limb.dof_count; ++k) {
    state_.angles[limb.first_dof + k] = angles[k];
    largest = std::max(largest, std::abs(angles[k] - before[k]));
  }
  return largest;
}

}  // namespace etude

#include "engine/kinematics/solvers/damped_least_squares.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

constexpr double kPositionScale = 0.30;  // metres that count as much as one radian
constexpr double kSmallestDamping = 1e-9;
constexpr double kLargestDamping = 1e6;
constexpr double kDampingStep = 5;
constexpr double kLargestTurn = 0.6;  // radians
// A step that lowers the sum by a smaller part than this would have to be taken a million times to matter.
constexpr double kSmallestGain = 1e-6;

// The weighted least-squares problem around one pose.
class Linearised {
 public:
  Linearised(const KinematicTree& tree, const IkProblem& problem)
      : tree_(tree),
        problem_(problem),
        normal_matrix_(tree.dof_count(), tree.dof_count()),
        gradient_(tree.dof_count()),
        rows_(tree.dof_count(), 3) {}

  // Σ weight · residual² at these frames.
  double Cost(const TreeFrames& frames) const {
    double cost = 0;
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      const EffectorTarget& target = problem_.targets[e];
      const glm::dvec3 gap = (target.position - frames.effectors[e].position) / kPositionScale;
      cost += target.position_weight * glm::dot(gap, gap);
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 off = target.axes[k] - frames.effectors[e].axes[k];
        cost += target.axis_weights[k] * glm::dot(off, off);
      }
    }
    return cost;
  }

  // Sets up JᵀJ and Jᵀr.
  void Build(const TreeFrames& frames, const std::vector<double>& angles) {
    normal_matrix_.setZero();
    gradient_.setZero();
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      const EffectorTarget& target = problem_.targets[e];
      const LimbFrame& now = frames.effectors[e];
      AddVector(frames, angles, static_cast<int>(e), now.position, true, (target.position - now.position),
                target.position_weight / (kPositionScale * kPositionScale));
      for (int k = 0; k < 3; ++k) {
        AddVector(frames, angles, static_cast<int>(e), now.axes[k], false, target.axes[k] - now.axes[k],
                  target.axis_weights[k]);
      }
    }
  }

  Eigen::VectorXd Step(double damping) const {
    Eigen::MatrixXd damped = normal_matrix_;
    damped.diagonal().array() += damping;
    return damped.ldlt().solve(gradient_);
  }

 private:
  // Adds the three rows of one vector of an effector: its position (a point: turns about the joint's place) or one
  // of its axes (a direction).
  void AddVector(const TreeFrames& frames, const std::vector<double>& angles, int effector, const glm::dvec3& vector,
                 bool is_point, const glm::dvec3& residual, double weight) {
    if (weight == 0) return;
    rows_.setZero();
    for (int j = tree_.effectors[effector].joint; j >= 0; j = tree_.joints[j].parent) {
      const TreeJoint& joint = tree_.joints[j];
      const glm::dvec3 arm = is_point ? vector - frames.joints[j].position : vector;
      for (int axis = 0; axis < joint.dof_count; ++axis) {
        const glm::dvec3 moves = glm::cross(DofAxis(joint, frames.bases[j], angles, axis), arm);
        rows_.row(joint.first_dof + axis) << moves.x, moves.y, moves.z;
      }
    }
    normal_matrix_.noalias() += weight * (rows_ * rows_.transpose());
    gradient_.noalias() += weight * (rows_ * Eigen::Vector3d(residual.x, residual.y, residual.z));
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  Eigen::MatrixXd normal_matrix_;
  Eigen::VectorXd gradient_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> rows_;  // ∂vector/∂angle, one line per angle
};

// angles + step, neither too far nor out of range. Returns the largest change.
double TurnWithin(const std::vector<AngleRange>& ranges, const std::vector<double>& angles, const Eigen::VectorXd& step,
                  std::vector<double>& turned) {
  double largest = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double turn = std::clamp(step[static_cast<Eigen::Index>(i)], -kLargestTurn, kLargestTurn);
    turned[i] = std::clamp(angles[i] + turn, ranges[i].lower, ranges[i].upper);
    largest = std::max(largest, std::abs(turned[i] - angles[i]));
  }
  return largest;
}

}  // namespace

IkSolution SolveDampedLeastSquares(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  TreeState state = problem.start;
  state.angles = run.start_angles();
  TreeFrames frames = ComputeFrames(tree, state);
  Linearised linearised(tree, problem);
  linearised.Build(frames, state.angles);
  double cost = linearised.Cost(frames);
  double damping = options.tuning.first_damping;
  std::vector<EffectorError> errors;
  const auto note = [&] {
    MeasureErrors(frames, problem.targets, errors);
    run.Note(errors, state.angles);
  };
  note();

  TreeState trial = state;
  TreeFrames trial_frames = frames;
  while (run.MustGoOn()) {
    const double largest = TurnWithin(run.ranges(), state.angles, linearised.Step(damping), trial.angles);
    ComputeFrames(tree, trial, trial_frames);
    const double trial_cost = linearised.Cost(trial_frames);
    if (largest < options.stall_change || damping > kLargestDamping) run.Stall();
    if (trial_cost < cost) {
      if (cost - trial_cost < kSmallestGain * cost) run.Stall();
      std::swap(state, trial);
      std::swap(frames, trial_frames);
      cost = trial_cost;
      damping = std::max(damping / kDampingStep, kSmallestDamping);
      linearised.Build(frames, state.angles);
    } else {
      damping *= kDampingStep;
    }
    note();
  }
  return run.Finish(state.angles);
}

}  // namespace etude

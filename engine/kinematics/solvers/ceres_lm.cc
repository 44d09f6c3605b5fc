#include "engine/kinematics/solvers/ceres_lm.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <utility>

#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

// Maximum trust-region radius. Beyond it, JᵀJ of 29 angles and 24 residuals is too nearly singular for Cholesky.
constexpr double kMaxRadius = 1e8;
// The solver stops if a step lowers the sum of squares by less than this share of the sum.
constexpr double kMinCostChange = 1e-9;
// The maximum number of successive steps that raise the sum of squares. At limits the sum often rises before it falls,
// so Ceres's default of 5 is too small.
constexpr int kMaxStepsUphill = 20;

// Returns the rotation, in the world, that turns an effector's axes E into the desired axes D, by less than half a
// turn.
glm::dquat MissingTurn(const glm::dmat3& R_WE, const glm::dmat3& R_WD) {
  const glm::dquat turn = glm::quat_cast(R_WD * glm::transpose(R_WE));
  return turn.w < 0 ? -turn : turn;
}

// The residuals of all effectors as functions of the angles that can move. A position has three residuals. Three axes
// of equal weight w have three residuals together, 2 √(2w) · (vector part of the quaternion between E and D), whose
// squares sum to Σ w |u_d − u_c|²; otherwise every axis with weight has three residuals of its own.
class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const KinematicTree& tree, const IkProblem& problem, const std::vector<double>& start_angles,
            std::vector<int> moving)
      : tree_(tree), problem_(problem), moving_(std::move(moving)), state_(problem.start) {
    state_.angles = start_angles;
    ComputeFrames(tree_, state_, frames_);
    // Count the residuals.
    int rows = 0;
    for (const EffectorTarget& target : problem.targets) {
      if (target.position_weight > 0) rows += 3;
      if (IsWholeFrame(target)) {
        rows += 3;
      } else {
        for (int k = 0; k < 3; ++k) rows += target.axis_weights[k] > 0 ? 3 : 0;
      }
    }
    set_num_residuals(rows);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(moving_.size()));
  }

  // Returns the forward kinematics at `x`. Recomputes it only if an angle has changed.
  const TreeFrames& FramesAt(const double* x) const {
    bool has_moved = false;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      double& angle = state_.angles[moving_[i]];
      has_moved = has_moved || angle != x[i];
      angle = x[i];
    }
    if (has_moved) ComputeFrames(tree_, state_, frames_);
    return frames_;
  }
  /// Returns the tree's angles at which the residuals were evaluated last.
  const std::vector<double>& angles() const { return state_.angles; }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const TreeFrames& frames = FramesAt(parameters[0]);
    double* jacobian = jacobians == nullptr ? nullptr : jacobians[0];
    if (jacobian != nullptr) ComputeJacobian(tree_, frames, moves_);
    int row = 0;
    for (std::size_t e = 0; e < problem_.targets.size(); ++e) {
      const EffectorTarget& target = problem_.targets[e];
      const LimbFrame& X_WE = frames.effectors[e];
      // Writes three residuals and their rows of the Jacobian. `change` returns the derivative of the residuals with
      // respect to one angle, given the effector's translation and its rotation vector per radian of this angle.
      const auto write = [&](const glm::dvec3& residual, const auto& change) {
        for (int k = 0; k < 3; ++k) residuals[row + k] = residual[k];
        for (std::size_t i = 0; jacobian != nullptr && i < moving_.size(); ++i) {
          const double* move = &moves_.column(moving_[i])[TreeJacobian::kPerEffector * e];
          const glm::dvec3 gain = change(glm::dvec3(move[0], move[1], move[2]), glm::dvec3(move[3], move[4], move[5]));
          for (int k = 0; k < 3; ++k) jacobian[(row + k) * moving_.size() + i] = gain[k];
        }
        row += 3;
      };
      if (target.position_weight > 0) {
        // Write the position residuals, in units of `kPositionScale`.
        const double scale = std::sqrt(target.position_weight) / kPositionScale;
        write(scale * (X_WE.position - target.position),
              [&](const glm::dvec3& shift, const glm::dvec3&) { return scale * shift; });
      }
      if (IsWholeFrame(target)) {
        // Write the residuals of three axes that have the same weight: the rotation between E and D.
        const double scale = std::sqrt(2 * target.axis_weights.x);
        const glm::dquat missing = MissingTurn(X_WE.axes, target.axes);
        const glm::dvec3 v(missing.x, missing.y, missing.z);
        write(-2 * scale * v, [&](const glm::dvec3&, const glm::dvec3& turn) {
          return scale * (missing.w * turn + glm::cross(v, turn));
        });
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        if (target.axis_weights[k] <= 0) continue;
        // Write the residuals of single axes: the difference of the unit vectors.
        const double scale = std::sqrt(target.axis_weights[k]);
        write(scale * (X_WE.axes[k] - target.axes[k]),
              [&](const glm::dvec3&, const glm::dvec3& turn) { return scale * glm::cross(turn, X_WE.axes[k]); });
      }
    }
    return true;
  }

 private:
  static bool IsWholeFrame(const EffectorTarget& target) {
    const glm::dvec3& w = target.axis_weights;
    return w.x > 0 && w.x == w.y && w.x == w.z;
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const std::vector<int> moving_;
  mutable TreeState state_;  // the pose at which the residuals were evaluated last
  mutable TreeFrames frames_;
  mutable TreeJacobian moves_;
};

// Records every step, and stops Ceres when our goals are met.
class Recorder final : public ceres::IterationCallback {
 public:
  Recorder(IkRun& run, const Residuals& residuals, const std::vector<double>& x, double stall_change)
      : run_(run), residuals_(residuals), x_(x), stall_change_(stall_change) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (step.iteration == 0) return ceres::SOLVER_CONTINUE;  // the caller has recorded the start
    const bool has_stalled = step.step_is_successful && StepLength(step) < stall_change_;
    run_.RecordFrames(residuals_.FramesAt(x_.data()), residuals_.angles());
    if (has_stalled) run_.Stall();
    return run_.MustGoOn() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  // Ceres 2.2 reports length 0 for the first successful step. That step leads from the start to the point of the last
  // evaluation. (`x` cannot be used instead, because Ceres stores the best point so far in it.)
  double StepLength(const ceres::IterationSummary& step) {
    if (std::exchange(has_stepped_, true)) return step.step_norm;
    double squares = 0;
    for (std::size_t i = 0; i < residuals_.angles().size(); ++i) {
      const double change = residuals_.angles()[i] - run_.start_angles()[i];
      squares += change * change;
    }
    return std::sqrt(squares);
  }

  IkRun& run_;
  const Residuals& residuals_;
  const std::vector<double>& x_;
  const double stall_change_;
  bool has_stepped_ = false;
};

// Returns the fastest options for this kind of problem; bench/peers/README.md compares the alternatives.
ceres::Solver::Options TunedOptions(const IkOptions& options, const CeresLmOptions& own) {
  ceres::Solver::Options tuned;
  tuned.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  // With about 24 residuals and 29 angles, the matrices are so small that Eigen does not divide them into blocks by
  // cache size, which would make results depend on the machine.
  tuned.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  tuned.dense_linear_algebra_library_type = ceres::EIGEN;
  // Use Levenberg's damping by the identity. With Marquardt's scaling by the diagonal of JᵀJ, weakly determined angles
  // oscillate.
  tuned.jacobi_scaling = false;
  tuned.min_lm_diagonal = 1;
  tuned.max_lm_diagonal = 1;
  tuned.initial_trust_region_radius = own.first_radius;
  tuned.max_trust_region_radius = std::max(kMaxRadius, own.first_radius);
  tuned.use_nonmonotonic_steps = true;
  tuned.max_consecutive_nonmonotonic_steps = kMaxStepsUphill;
  tuned.max_num_line_search_step_size_iterations = 0;  // no line search at the bounds: steps are projected
  // Only our goals, the iteration limit and a stall stop the solver.
  tuned.max_num_iterations = options.max_iterations;
  tuned.function_tolerance = kMinCostChange;
  tuned.gradient_tolerance = 0;
  tuned.parameter_tolerance = 0;
  tuned.max_solver_time_in_seconds = std::numeric_limits<double>::max();
  tuned.num_threads = 1;
  tuned.logging_type = ceres::SILENT;
  return tuned;
}

}  // namespace

IkSolution SolveCeresLm(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                        const CeresLmOptions& own) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  FLAGS_minloglevel = google::GLOG_FATAL;  // no log output: the status reports the outcome

  // Collect the angles that can move, and record the start.
  IkRun run(tree, problem, options);
  // Angles whose range is a single value are left out, because Ceres's bounds do not allow them.
  std::vector<int> moving;
  for (int i = 0; i < tree.dof_count(); ++i) {
    if (run.ranges()[i].lower < run.ranges()[i].upper) moving.push_back(i);
  }
  std::vector<double> x;
  for (const int i : moving) x.push_back(run.start_angles()[i]);
  Residuals residuals(tree, problem, run.start_angles(), moving);
  run.RecordFrames(residuals.FramesAt(x.data()), run.start_angles());
  if (moving.empty()) run.Stall();

  if (run.MustGoOn()) {
    // Set up Ceres's problem with bounds, and solve.
    ceres::Problem::Options borrow;
    borrow.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    borrow.disable_all_safety_checks = true;
    ceres::Problem sum(borrow);
    sum.AddResidualBlock(&residuals, nullptr, x.data());
    for (int i = 0; i < static_cast<int>(moving.size()); ++i) {
      sum.SetParameterLowerBound(x.data(), i, run.ranges()[moving[i]].lower);
      sum.SetParameterUpperBound(x.data(), i, run.ranges()[moving[i]].upper);
    }
    Recorder recorder(run, residuals, x, options.stall_change);
    ceres::Solver::Options tuned = TunedOptions(options, own);
    tuned.callbacks.push_back(&recorder);
    tuned.update_state_every_iteration = true;
    ceres::Solver::Summary summary;
    ceres::Solve(tuned, &sum, &summary);
    if (run.MustGoOn()) run.Stall();  // Ceres stopped without reaching our goals
  }
  residuals.FramesAt(x.data());
  return run.Finish(residuals.angles());
}

}  // namespace etude

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

// With less damping than this, JᵀJ of 29 angles and 24 demands is too nearly singular for Cholesky.
constexpr double kLargestRadius = 1e8;
// A step that lowers the sum by a smaller part than this leads nowhere.
constexpr double kSmallestCostChange = 1e-9;
// More than Ceres's 5: at limits, ways out often lead uphill at first.
constexpr int kMostStepsUphill = 20;

// The rotation of the world that takes an effector's axes E to the desired ones D, the short way round.
glm::dquat MissingTurn(const glm::dmat3& R_WE, const glm::dmat3& R_WD) {
  const glm::dquat turn = glm::quat_cast(R_WD * glm::transpose(R_WE));
  return turn.w < 0 ? -turn : turn;
}

// The residuals of all effectors as functions of those angles that can move. A position has three. Three axes of one
// weight w have three together, 2 √(2w) · (vector part of the quaternion between E and D), whose squares add up
// to just Σ w |u_d − u_c|²; otherwise every axis with weight has its own three.
class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const KinematicTree& tree, const IkProblem& problem, const std::vector<double>& start_angles,
            std::vector<int> moving)
      : tree_(tree), problem_(problem), moving_(std::move(moving)), state_(problem.start) {
    state_.angles = start_angles;
    ComputeFrames(tree_, state_, frames_);
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
  /// All angles of the last call.
  const std::vector<double>& angles() const { return state_.angles; }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const TreeFrames& frames = FramesAt(parameters[0]);
    double* jacobian = jacobians == nullptr ? nullptr : jacobians[0];
    if (jacobian != nullptr) ComputeJacobian(tree_, frames, moves_);
    int row = 0;
    for (std::size_t e = 0; e < problem_.targets.size(); ++e) {
      const EffectorTarget& target = problem_.targets[e];
      const LimbFrame& X_WE = frames.effectors[e];
      // Writes three rows; `change` gives what they gain from a move by `shift` and a turn by `turn`.
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
        const double scale = std::sqrt(target.position_weight) / kPositionScale;
        write(scale * (X_WE.position - target.position),
              [&](const glm::dvec3& shift, const glm::dvec3&) { return scale * shift; });
      }
      if (IsWholeFrame(target)) {
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
  mutable TreeState state_;  // of the last call
  mutable TreeFrames frames_;
  mutable TreeJacobian moves_;
};

// Records every step and stops Ceres by our goals.
class Recorder final : public ceres::IterationCallback {
 public:
  Recorder(IkRun& run, const Residuals& residuals, const std::vector<double>& x, double stall_change)
      : run_(run), residuals_(residuals), x_(x), stall_change_(stall_change) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (step.iteration == 0) return ceres::SOLVER_CONTINUE;  // the start is recorded
    const bool has_stalled = step.step_is_successful && StepLength(step) < stall_change_;
    run_.RecordFrames(residuals_.FramesAt(x_.data()), residuals_.angles());
    if (has_stalled) run_.Stall();
    return run_.MustGoOn() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  // Ceres 2.2 tells 0 as the length of the first successful step. That step leads from the start to where the residuals
  // were asked for last; x is no help, since Ceres keeps the best point so far there.
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

// Ceres's best for this kind of problem; every choice was measured against its alternatives.
ceres::Solver::Options TunedOptions(const IkOptions& options, const CeresLmOptions& own) {
  ceres::Solver::Options tuned;
  tuned.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  // Some 24 demands on 29 angles: so few that Eigen does not block by the sizes of caches, which would differ between
  // machines.
  tuned.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  tuned.dense_linear_algebra_library_type = ceres::EIGEN;
  // The plain damping of Levenberg: Marquardt's, by the diagonal of JᵀJ, lets weak angles swing.
  tuned.jacobi_scaling = false;
  tuned.min_lm_diagonal = 1;
  tuned.max_lm_diagonal = 1;
  tuned.initial_trust_region_radius = own.first_radius;
  tuned.max_trust_region_radius = std::max(kLargestRadius, own.first_radius);
  tuned.use_nonmonotonic_steps = true;
  tuned.max_consecutive_nonmonotonic_steps = kMostStepsUphill;
  tuned.max_num_line_search_step_size_iterations = 0;  // steps are cut at the bounds, not searched along
  // Only our goals, our iterations and a standstill stop it.
  tuned.max_num_iterations = options.max_iterations;
  tuned.function_tolerance = kSmallestCostChange;
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
  FLAGS_minloglevel = google::GLOG_FATAL;  // what it has to say is in the status

  IkRun run(tree, problem, options);
  std::vector<int> moving;  // Ceres takes no bounds that leave no room
  for (int i = 0; i < tree.dof_count(); ++i) {
    if (run.ranges()[i].lower < run.ranges()[i].upper) moving.push_back(i);
  }
  std::vector<double> x;
  for (const int i : moving) x.push_back(run.start_angles()[i]);
  Residuals residuals(tree, problem, run.start_angles(), moving);
  run.RecordFrames(residuals.FramesAt(x.data()), run.start_angles());
  if (moving.empty()) run.Stall();

  if (run.MustGoOn()) {
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
    if (run.MustGoOn()) run.Stall();  // Ceres gave up
  }
  residuals.FramesAt(x.data());
  return run.Finish(residuals.angles());
}

}  // namespace etude

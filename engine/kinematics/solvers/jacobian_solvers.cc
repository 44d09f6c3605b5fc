#include "engine/kinematics/solvers/jacobian_solvers.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <utility>

#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

// A matrix is singular if its smallest pivot is not above this share of its largest pivot.
constexpr double kSingular = 1e-12;
constexpr int kMaxPasses = 4;  // maximum number of active-set passes per step

// Computes the step α JᵀdX at `angles`. An angle at an end of its range does not move if its step points out of the
// range.
void ComputeStep(const LinearTargets& linear, std::span<const double> angles, std::span<const AngleRange> ranges,
                 double gain, Eigen::VectorXd& step) {
  const Eigen::Map<const Eigen::MatrixXd> jacobian(linear.jacobian().data(), linear.rows(), linear.columns());
  const Eigen::Map<const Eigen::VectorXd> residuals(linear.residuals().data(), linear.rows());
  step.noalias() = jacobian.transpose() * residuals;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    double& torque = step[static_cast<Eigen::Index>(i)];
    const bool is_blocked = torque < 0 ? angles[i] <= ranges[i].lower : angles[i] >= ranges[i].upper;
    if (is_blocked) torque = 0;
  }
  const Eigen::VectorXd gained = jacobian * step;
  const double length = gained.squaredNorm();
  if (length > 0) step *= gain * residuals.dot(gained) / length;
}

// The range of λ in damped least squares, and the factor by which it changes.
constexpr double kMinDamping = 1e-9;
constexpr double kMaxDamping = 1e6;
constexpr double kDampingStep = 5;
// The solver stalls if a step lowers the sum by less than this share: about a million such steps would be needed to
// change the sum noticeably.
constexpr double kMinGain = 1e-6;

}  // namespace

void DampedInverse::Build(const LinearTargets& linear) {
  rows_ = linear.rows();
  columns_ = linear.columns();
  jacobian_.assign(linear.jacobian().begin(), linear.jacobian().end());
  residuals_.assign(linear.residuals().begin(), linear.residuals().end());
  gram_.assign(static_cast<std::size_t>(rows_) * rows_, 0.0);
  if (rows_ == 0) return;  // Eigen must not map empty matrices
  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  Eigen::Map<Eigen::MatrixXd>(gram_.data(), rows_, rows_).selfadjointView<Eigen::Lower>().rankUpdate(jacobian);
}

bool DampedInverse::Step(double damping, std::span<const double> preferred, std::vector<double>& step) {
  step.assign(preferred.begin(), preferred.end());
  if (rows_ == 0) return true;  // no target: only the preferred posture determines the step
  damped_ = gram_;
  Eigen::Map<Eigen::MatrixXd> damped(damped_.data(), rows_, rows_);
  damped.diagonal().array() += damping;
  const Eigen::LDLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped);
  const auto pivots = factor.vectorD();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return false;

  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  const Eigen::Map<const Eigen::VectorXd> residuals(residuals_.data(), rows_);
  Eigen::Map<Eigen::VectorXd> out(step.data(), columns_);
  // Compute J⁺e + (I − J⁺J) z as z + J⁺ (e − J z).
  const Eigen::VectorXd multipliers = factor.solve(residuals - jacobian * out);
  out.noalias() += jacobian.transpose() * multipliers;
  return true;
}

// Solves (J_F J_Fᵀ + μI) y = e − J step, where F are the free angles. Before the call, `duals_` is the right-hand side;
// afterwards, it is y. Returns false if the matrix is singular.
bool DampedInverse::SolveDuals(double damping) {
  if (rows_ == 0) return true;  // no target: only the preferred posture determines the step
  damped_ = gram_;
  Eigen::Map<Eigen::MatrixXd> damped(damped_.data(), rows_, rows_);
  damped.diagonal().array() += damping;
  for (int i = 0; i < columns_; ++i) {
    if (sides_[i] == 0) continue;
    const Eigen::Map<const Eigen::VectorXd> column(&jacobian_[static_cast<std::size_t>(i) * rows_], rows_);
    damped.selfadjointView<Eigen::Lower>().rankUpdate(column, -1);
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped);
  if (factor.info() != Eigen::Success) return false;
  const auto pivots = factor.matrixLLT().diagonal();
  const double least = pivots.minCoeff(), most = pivots.maxCoeff();
  if (!(least * least > kSingular * most * most)) return false;
  Eigen::Map<Eigen::VectorXd> duals(duals_.data(), rows_);
  factor.solveInPlace(duals);
  return true;
}

bool DampedInverse::StepWithin(double damping, std::span<const double> preferred, std::span<const double> angles,
                               std::span<const AngleRange> ranges, std::vector<double>& step) {
  step.resize(columns_);
  sides_.assign(columns_, 0);
  duals_.resize(rows_);
  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  const Eigen::Map<const Eigen::VectorXd> residuals(residuals_.data(), rows_);
  Eigen::Map<Eigen::VectorXd> out(step.data(), columns_), duals(duals_.data(), rows_);
  is_exact_ = false;
  for (int pass = 0; pass < kMaxPasses && !is_exact_; ++pass) {
    // Fix the active angles at the ends of their ranges. Let the other angles make the preferred change.
    for (int i = 0; i < columns_; ++i) {
      step[i] = sides_[i] < 0   ? ranges[i].lower - angles[i]
                : sides_[i] > 0 ? ranges[i].upper - angles[i]
                                : preferred[i];
    }
    // Solve for y.
    duals = residuals;
    duals.noalias() -= jacobian * out;
    if (!SolveDuals(damping)) return false;
    // Compute the primal step from y, and update the active set.
    is_exact_ = true;
    for (int i = 0; i < columns_; ++i) {
      const Eigen::Map<const Eigen::VectorXd> column(&jacobian_[static_cast<std::size_t>(i) * rows_], rows_);
      const double best = preferred[i] + column.dot(duals);
      const double lower = ranges[i].lower - angles[i], upper = ranges[i].upper - angles[i];
      const signed char side = best < lower ? -1 : best > upper ? 1 : 0;
      is_exact_ = is_exact_ && side == sides_[i];
      sides_[i] = side;
      step[i] = std::clamp(best, lower, upper);
    }
  }
  return true;
}

double DampedInverse::Gain(std::span<const double> step) const {
  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  const Eigen::Map<const Eigen::VectorXd> residuals(residuals_.data(), rows_);
  const Eigen::Map<const Eigen::VectorXd> taken(step.data(), columns_);
  const Eigen::VectorXd moved = jacobian * taken;
  return moved.dot(2 * residuals - moved);
}

IkSolution SolveJacobianTranspose(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                  const JacobianTransposeOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    LinearTargets linear(tree, problem.targets);
    Eigen::VectorXd step;
    while (run.MustGoOn()) {
      linear.Build(frames);
      ComputeStep(linear, state.angles, run.ranges(), own.gain, step);
      const std::span<double> turns(step.data(), static_cast<std::size_t>(step.size()));
      Shorten(turns);
      if (MoveWithin(run.ranges(), state.angles, turns, state.angles) < options.stall_change) run.Stall();
      ComputeFrames(tree, state, frames);
      run.RecordFrames(frames, state.angles);
    }
  });
}

IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                             const JacobianPinvOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    LinearTargets linear(tree, problem.targets);
    DampedInverse inverse;
    std::vector<double> to_preferred(state.angles.size()), step;
    while (run.MustGoOn()) {
      linear.Build(frames);
      inverse.Build(linear);
      for (std::size_t i = 0; i < to_preferred.size(); ++i) to_preferred[i] = run.start_angles()[i] - state.angles[i];
      if (!inverse.Step(own.damping, to_preferred, step)) return run.Stall();
      Shorten(step);
      if (MoveWithin(run.ranges(), state.angles, step, state.angles) < options.stall_change) run.Stall();
      ComputeFrames(tree, state, frames);
      run.RecordFrames(frames, state.angles);
    }
  });
}

IkSolution SolveDampedLeastSquares(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const DampedLeastSquaresOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    LinearTargets linear(tree, problem.targets);
    DampedInverse inverse;
    const std::vector<double> no_preference(state.angles.size(), 0.0);
    std::vector<double> step;
    linear.Build(frames);
    inverse.Build(linear);
    double cost = linear.Cost(frames);
    double damping = own.first_damping;
    TreeState trial = state;
    TreeFrames trial_frames = frames;
    while (run.MustGoOn()) {
      // Compute the step. If the matrix is singular, raise the damping until it is regular.
      if (own.bounds == Bounds::kClamped) {
        while (!inverse.Step(damping, no_preference, step)) damping *= kDampingStep;
        for (double& turn : step) turn = std::clamp(turn, -kMaxTurn, kMaxTurn);
      } else {
        while (!inverse.StepWithin(damping, no_preference, state.angles, run.ranges(), step)) damping *= kDampingStep;
        Shorten(step);
      }
      // Compute the sum of squares after the step.
      const double largest = MoveWithin(run.ranges(), state.angles, step, trial.angles);
      ComputeFrames(tree, trial, trial_frames);
      const double trial_cost = linear.Cost(trial_frames);
      if (largest < options.stall_change || damping > kMaxDamping) run.Stall();
      // Accept the step and lower the damping, or reject it and raise the damping.
      if (trial_cost < cost) {
        if (cost - trial_cost < kMinGain * cost) run.Stall();
        std::swap(state, trial);
        std::swap(frames, trial_frames);
        cost = trial_cost;
        damping = std::max(damping / kDampingStep, kMinDamping);
        linear.Build(frames);
        inverse.Build(linear);
      } else {
        damping *= kDampingStep;
      }
      run.RecordFrames(frames, state.angles);
    }
  });
}

namespace {

// Range of the factor that multiplies the damping (Nielsen's rule). With a smaller factor, steps would be too long
// where the residual stays large.
constexpr double kMinFactor = 1e-2, kMaxFactor = 1e9;
// The damping's factor is multiplied by kFirstGrowth after a rejected step. The multiplier doubles with each further
// step that is rejected in succession.
constexpr double kFirstGrowth = 2;
// Minimum damping. Without it, JJᵀ is singular when limbs are at their limits.
constexpr double kMinMu = 1e-9;

// A descent is stuck if the sum of squares, after kMaxPatience steps, is still at least kMinProgress of its old value.
// If few iterations are allowed, max_iterations / kPartOfIterations steps are enough, so that iterations remain for
// restarts.
constexpr int kMaxPatience = 6;
constexpr int kPartOfIterations = 5;
constexpr double kMinProgress = 0.7;
constexpr double kSettledProgress = 1 - 1e-5;  // replaces kMinProgress in the last descent

// The descents of one problem: from the start, from restarts, and from the best pose.
class Minimiser {
 public:
  Minimiser(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, double damping_share,
            IkRun& run, TreeState& state, TreeFrames& frames)
      : tree_(tree),
        problem_(problem),
        options_(options),
        damping_share_(damping_share),
        run_(run),
        state_(state),
        frames_(frames),
        linear_(tree, problem.targets),
        trial_(state),
        trial_frames_(frames),
        no_preference_(state.angles.size(), 0.0),
        best_angles_(state.angles) {}

  void Minimise() {
    // Run the first descent.
    const int patience = std::clamp(options_.max_iterations / kPartOfIterations, 1, kMaxPatience);
    Descend(kMinProgress, patience);
    // Run the restarts, unless no pose can meet the targets.
    const int restarts = run_.MustGoOn() && !IsOutOfReach(tree_, problem_) ? kRestarts : 0;
    for (int restart = 1; restart <= restarts && run_.MustGoOn(); ++restart) {
      ScatterAround(run_.start_angles(), run_.ranges(), restart, state_.angles);
      Place();
      Descend(kMinProgress, patience);
    }
    // Refine the best pose, which is the answer if no descent has converged.
    if (run_.MustGoOn()) {
      state_.angles = best_angles_;
      Place();
      Descend(kSettledProgress, kMaxPatience);
    }
    if (run_.HasConverged()) return;
    if (run_.iterations() < options_.max_iterations) run_.Stall();
    run_.DiscardErrors();
    state_.angles = best_angles_;
  }

 private:
  /// Computes the forward kinematics at the start of a restart or at the best pose, and counts this additional pass.
  void Place() {
    ComputeFrames(tree_, state_, frames_);
    run_.CountPass();
  }

  /// Steps from `state_` until the targets are met, or until `patience` steps have not reduced the sum below `progress`
  /// times its old value.
  void Descend(double progress, int patience) {
    double cost = linear_.Cost(frames_), fallen_to = cost;
    double factor = 1, growth = kFirstGrowth;
    bool has_moved = true;
    for (int left = patience; left > 0 && factor <= kMaxFactor && run_.MustGoOn();) {
      // Try a step. After a rejected step the linearisation is still valid.
      if (has_moved) Linearise();
      if (FindStep(std::max(kMinMu, factor * damping_share_ * cost)) < options_.stall_change) break;
      ComputeFrames(tree_, trial_, trial_frames_);
      const double trial_cost = linear_.Cost(trial_frames_);
      has_moved = trial_cost < cost;
      // Accept the step and update the factor by Nielsen's rule, or reject it and raise the factor.
      if (has_moved) {
        const double surplus = 2 * (cost - trial_cost) / inverse_.Gain(step_) - 1;
        factor = std::max(kMinFactor, factor * std::max(1.0 / 3, 1 - surplus * surplus * surplus));
        growth = kFirstGrowth;
        std::swap(state_.angles, trial_.angles);
        std::swap(frames_, trial_frames_);
        cost = trial_cost;
      } else {
        factor *= growth;
        growth *= 2;
      }
      run_.RecordFrames(frames_, state_.angles);
      // Count the steps since the last sufficient reduction of the sum.
      if (cost < progress * fallen_to) {
        fallen_to = cost;
        left = patience;
      } else {
        --left;
      }
    }
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_angles_ = state_.angles;
    }
  }

  void Linearise() {
    linear_.Build(frames_);
    inverse_.Build(linear_);
  }

  /// Sets `trial_` to the pose after the step with damping `mu`. Returns the largest change of an angle, 0 if there is
  /// no step.
  double FindStep(double mu) {
    if (!inverse_.StepWithin(mu, no_preference_, state_.angles, run_.ranges(), step_)) return 0;
    Shorten(step_);
    return MoveWithin(run_.ranges(), state_.angles, step_, trial_.angles);
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions& options_;
  const double damping_share_;
  IkRun& run_;
  TreeState& state_;
  TreeFrames& frames_;
  LinearTargets linear_;
  DampedInverse inverse_;
  TreeState trial_;
  TreeFrames trial_frames_;
  std::vector<double> step_;
  const std::vector<double> no_preference_;  // zeros: no step has a preferred change
  double best_cost_ = std::numeric_limits<double>::infinity();
  std::vector<double> best_angles_;
};

}  // namespace

IkSolution SolveLevenbergMarquardt(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const LevenbergMarquardtOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    Minimiser(tree, problem, options, own.damping_share, run, state, frames).Minimise();
  });
}

}  // namespace etude

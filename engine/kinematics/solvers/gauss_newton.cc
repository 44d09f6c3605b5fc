#include "engine/kinematics/solvers/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/kinematics/solvers/gauss_newton_step.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/restarts.h"

namespace etude {
namespace {

// The damping is this share of the squared residual, times a factor that follows the steps' success.
constexpr double kDamping = 0.1;
constexpr double kLeastDamping = 1e-7, kMostDamping = 10;
constexpr double kDampingUp = 10;       // times the factor after a step that has raised the residual,
constexpr double kDampingDown = 3;      // divided by this after one that has not,
constexpr double kDampingFloor = 1e-3;  // at least 1, or this where the residual, and the damping with it, stays large

// Below this damping a step gets extra active-set passes.
constexpr double kSmallDamping = 0.01;

// Steps are stuck when this many of them have not brought the squared residual down to the share kProgress; when
// iterations are few, a share of them counts, so that restarts get theirs.
constexpr int kPatience = 6;
constexpr int kShareOfPatience = 5;
constexpr double kProgress = 0.7;
constexpr double kSettled = 1 - 1e-5;  // instead, where targets cannot be met

constexpr int kRestartSweeps = 2;

class Solver {
 public:
  Solver(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, const GaussNewtonOptions& own,
         IkRun& run, TreeState& state, TreeFrames& frames)
      : tree_(tree),
        problem_(problem),
        options_(options),
        own_(own),
        run_(run),
        state_(state),
        frames_(frames),
        step_(tree, problem.targets) {
    options_.weights = WeightRule::kAdaptivePower;
    options_.refresh = WeightRefresh::kSweep;
  }

  void Solve() {
    Sweep(own_.first_sweeps);
    const int patience = std::clamp(options_.max_iterations / kShareOfPatience, 1, kPatience);
    Approach(Preferred::kStart, kProgress, patience);
    Approach(Preferred::kHere, kProgress, patience);
    const int restarts = run_.MustGoOn() && !IsOutOfReach(tree_, problem_) ? kRestarts : 0;
    for (int restart = 1; restart <= restarts && run_.MustGoOn(); ++restart) {
      ScatterAround(run_.start_angles(), run_.ranges(), restart, state_.angles);
      Place();
      Sweep(kRestartSweeps);
      Approach(Preferred::kHere, kProgress, patience);
    }
    Settle();
    if (run_.HasConverged()) return;
    if (run_.iterations() < options_.max_iterations) run_.Stall();
    run_.DiscardErrors();
    state_.angles = best_angles_;
  }

 private:
  /// Which pose a step stays near to, where the targets leave a choice.
  enum class Preferred { kStart, kHere };

  /// Forward kinematics of angles that are not the outcome of an iteration.
  void Place() {
    ComputeFrames(tree_, state_, frames_);
    run_.CountPass();
  }

  /// Forward kinematics after an iteration, and how far it is off.
  void Measure() {
    ComputeFrames(tree_, state_, frames_);
    run_.RecordFrames(frames_, state_.angles);
  }

  void Sweep(int count) {
    if (count == 0 || !run_.MustGoOn()) return;
    const IkProblem from_here{state_, problem_.targets, run_.ranges()};
    IkOptions within_ranges = options_;
    within_ranges.limits = true;
    within_ranges.angle_change_tolerance.reset();
    MomentSweep sweep(tree_, from_here, within_ranges);
    for (int i = 0; i < count && run_.MustGoOn(); ++i) {
      sweep.Sweep();
      state_.angles = sweep.Angles();
      Measure();
    }
  }

  /// One step from `frames_`, at which `step_` is built. Returns the largest change of an angle.
  double Step(Preferred preferred, double damping) {
    const std::vector<double>& posture = preferred == Preferred::kStart ? run_.start_angles() : state_.angles;
    std::span<const double> change = step_.Solve(state_.angles, posture, run_.ranges(), damping);
    for (int pass = 0; pass < own_.extra_passes && damping < kSmallDamping && !step_.is_exact(); ++pass) {
      change = step_.Solve(state_.angles, posture, run_.ranges(), damping);
    }
    double largest = 0;
    for (const double c : change) largest = std::max(largest, std::abs(c));
    // Overflow, from weights and limbs of absurd sizes: no step.
    if (!std::ranges::all_of(change, [](double c) { return std::isfinite(c); })) largest = 0;
    const double share = largest > kLargestTurn ? kLargestTurn / largest : 1;
    for (std::size_t d = 0; d < state_.angles.size() && largest > 0; ++d) {
      const AngleRange& range = run_.ranges()[d];
      state_.angles[d] = std::clamp(state_.angles[d] + share * change[d], range.lower, range.upper);
    }
    Measure();
    return largest;
  }

  /// Steps until the targets are met or the residual falls no more. Steps that stay near where they begin never raise
  /// it: one that does is undone and tried again with more damping (Levenberg–Marquardt).
  void Approach(Preferred preferred, double progress, int patience, double damping_floor = 1) {
    double fallen_to = std::numeric_limits<double>::infinity(), before = fallen_to, damping_factor = 1;
    int left = patience;
    while (run_.MustGoOn()) {
      double squares = step_.Build(frames_);
      if (preferred == Preferred::kHere && squares > before) {
        state_.angles = last_angles_;
        Place();
        squares = step_.Build(frames_);
        damping_factor *= kDampingUp;
      } else {
        damping_factor = std::max(damping_floor, damping_factor / kDampingDown);
      }
      if (squares < progress * fallen_to) {
        fallen_to = squares;
        left = patience;
      } else if (--left == 0) {
        break;
      }
      RecordBest(squares);
      last_angles_ = state_.angles;
      before = squares;
      const double damping = damping_factor * std::clamp(kDamping * squares, kLeastDamping, kMostDamping);
      if (Step(preferred, damping) < options_.stall_change) break;
    }
    if (!run_.HasConverged()) RecordBest(step_.Build(frames_));
  }

  /// Steps on from the best pose so far, for targets that cannot be met.
  void Settle() {
    if (!run_.MustGoOn()) return;
    state_.angles = best_angles_;
    Place();
    Approach(Preferred::kHere, kSettled, kPatience, kDampingFloor);
  }

  void RecordBest(double squares) {
    if (squares >= best_squares_) return;
    best_squares_ = squares;
    best_angles_ = state_.angles;
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  IkOptions options_;
  const GaussNewtonOptions& own_;
  IkRun& run_;
  TreeState& state_;
  TreeFrames& frames_;
  GaussNewtonStep step_;
  double best_squares_ = std::numeric_limits<double>::infinity();
  std::vector<double> best_angles_, last_angles_;
};

}  // namespace

IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const GaussNewtonOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    Solver(tree, problem, options, own, run, state, frames).Solve();
  });
}

}  // namespace etude

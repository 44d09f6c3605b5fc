#include "engine/kinematics/solvers/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/gauss_newton_step.h"

namespace etude {
namespace {

// The damping is this share of the squared residual.
constexpr double kDamping = 0.1;
constexpr double kLeastDamping = 1e-7, kMostDamping = 10;
constexpr double kCaution = 10;       // times more damping after a step that has made it worse,
constexpr double kConfidence = 3;     // so many times less after one that has not, down to the share above;
constexpr double kBoldness = 1e-3;    // to so much of it where the residual stays, and with it the damping would
constexpr double kLargestTurn = 0.6;  // radians, of one step

// So many more passes may settle which angles are held by their limits, in the last steps, which the hidden angles
// depend on: those with less damping than this.
constexpr int kMorePasses = 3;
constexpr double kNear = 0.01;

// Steps have got stuck when so many of them have not brought the squared residual down to this share; fewer where the
// iterations are few, of which one in so many is spent on that: other poses shall have their turn.
constexpr int kPatience = 6;
constexpr int kShareOfPatience = 5;
constexpr double kProgress = 0.7;
constexpr double kSettled = 1 - 1e-5;  // instead, where targets cannot be met

constexpr int kRestarts = 20;
constexpr int kRestartSweeps = 2;
constexpr double kScatter = 1.5;  // radians

class Solver {
 public:
  Solver(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)
      : tree_(tree),
        problem_(problem),
        options_(options),
        run_(tree, problem, options),
        state_(problem.start),
        step_(tree, problem.targets) {
    options_.weights = WeightRule::kAdaptivePower;
    options_.refresh = WeightRefresh::kSweep;
    state_.angles = run_.start_angles();
  }

  IkSolution Solve() {
    Measure();
    Sweep(options_.tuning.first_sweeps);
    const int patience = std::clamp(options_.max_iterations / kShareOfPatience, 1, kPatience);
    Approach(Wanted::kStart, kProgress, patience);
    Approach(Wanted::kHere, kProgress, patience);
    const int restarts = run_.MustGoOn() && !IsOutOfReach(tree_, problem_) ? kRestarts : 0;
    for (int restart = 1; restart <= restarts && run_.MustGoOn(); ++restart) {
      Scatter(restart);
      Sweep(kRestartSweeps);
      Approach(Wanted::kHere, kProgress, patience);
    }
    Settle();
    if (run_.HasConverged()) return run_.Finish(std::move(state_.angles));
    if (run_.iterations() < options_.max_iterations) run_.Stall();
    run_.Forget();
    return run_.Finish(std::move(best_angles_));
  }

 private:
  /// Which pose a step stays near to, where the targets leave a choice.
  enum class Wanted { kStart, kHere };

  /// Forward kinematics of angles that no iteration has led to.
  void Place() {
    ComputeFrames(tree_, state_, frames_);
    run_.CountPass();
  }

  /// Forward kinematics after an iteration, and how far it is off.
  void Measure() {
    ComputeFrames(tree_, state_, frames_);
    run_.NoteFrames(frames_, state_.angles);
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
  double Step(Wanted wanted, double damping) {
    const std::vector<double>& nearby = wanted == Wanted::kStart ? run_.start_angles() : state_.angles;
    std::span<const double> change = step_.Solve(state_.angles, nearby, run_.ranges(), damping);
    for (int more = 0; more < kMorePasses && damping < kNear && !step_.is_exact(); ++more) {
      change = step_.Solve(state_.angles, nearby, run_.ranges(), damping);
    }
    double largest = 0, sum = 0;
    for (const double c : change) {
      largest = std::max(largest, std::abs(c));
      sum += std::abs(c);
    }
    if (!std::isfinite(sum)) largest = 0;  // weights and limbs of absurd sizes: better no step
    const double share = largest > kLargestTurn ? kLargestTurn / largest : 1;
    for (std::size_t d = 0; d < state_.angles.size() && largest > 0; ++d) {
      const AngleRange& range = run_.ranges()[d];
      state_.angles[d] = std::clamp(state_.angles[d] + share * change[d], range.lower, range.upper);
    }
    Measure();
    return largest;
  }

  /// Steps until the targets are met or nothing improves any more. Steps that stay near where they begin never make it
  /// worse: one that does is taken back and tried again with more damping (Levenberg–Marquardt).
  void Approach(Wanted wanted, double progress, int patience, double least_caution = 1) {
    double fallen_to = std::numeric_limits<double>::infinity(), before = fallen_to, caution = 1;
    int left = patience;
    while (run_.MustGoOn()) {
      double squares = step_.Build(frames_);
      if (wanted == Wanted::kHere && squares > before) {
        state_.angles = last_angles_;
        Place();
        squares = step_.Build(frames_);
        caution *= kCaution;
      } else {
        caution = std::max(least_caution, caution / kConfidence);
      }
      if (squares < progress * fallen_to) {
        fallen_to = squares;
        left = patience;
      } else if (--left == 0) {
        break;
      }
      Remember(squares);
      last_angles_ = state_.angles;
      before = squares;
      const double damping = caution * std::clamp(kDamping * squares, kLeastDamping, kMostDamping);
      if (Step(wanted, damping) < options_.stall_change) break;
    }
    if (!run_.HasConverged()) Remember(step_.Build(frames_));
  }

  /// Moves to another pose around the start, a different one for every number and every start: along a motion, a solver
  /// that is lost and has few iterations tries others in every frame.
  void Scatter(int number) {
    constexpr double kGoldenShare = 0.6180339887498949;  // its multiples, modulo 1, are spread evenly
    constexpr double kStir = 300;                        // a fifth of a degree goes all the way round
    for (std::size_t d = 0; d < state_.angles.size(); ++d) {
      const double start = run_.start_angles()[d];
      double x = kGoldenShare * number * (static_cast<double>(d) + 1) + kStir * start;
      x -= std::floor(x);
      const AngleRange& range = run_.ranges()[d];
      state_.angles[d] = std::clamp(start + kScatter * (2 * x - 1), range.lower, range.upper);
    }
    Place();
  }

  /// Goes from the best pose so far to the nearest one to targets that cannot be met.
  void Settle() {
    if (!run_.MustGoOn()) return;
    state_.angles = best_angles_;
    Place();
    Approach(Wanted::kHere, kSettled, kPatience, kBoldness);
  }

  void Remember(double squares) {
    if (squares >= best_squares_) return;
    best_squares_ = squares;
    best_angles_ = state_.angles;
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  IkOptions options_;
  IkRun run_;
  TreeState state_;
  TreeFrames frames_;
  GaussNewtonStep step_;
  double best_squares_ = std::numeric_limits<double>::infinity();
  std::vector<double> best_angles_, last_angles_;
};

}  // namespace

IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  return Solver(tree, problem, options).Solve();
}

}  // namespace etude

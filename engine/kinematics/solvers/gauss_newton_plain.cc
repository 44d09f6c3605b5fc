#include "engine/kinematics/solvers/gauss_newton_plain.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/kinematics/solvers/gauss_newton_course.h"
#include "engine/kinematics/solvers/gauss_newton_step.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/restarts.h"

namespace etude {
namespace {

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
        step_(tree, problem.targets),
        course_(options, own, {}) {}

  void Solve() {
    using enum GaussNewtonCourse::Act;
    const auto is_out_of_reach = [&] { return IsOutOfReach(tree_, problem_); };
    while (true) {
      const bool is_met = run_.HasConverged();
      const auto next = course_.Arrive(is_met ? 0 : step_.Build(frames_), is_met, is_out_of_reach);
      if (next.is_best) best_angles_ = state_.angles;
      switch (next.act) {
        case kStep:
          last_angles_ = state_.angles;
          course_.Stepped(Step(next));
          break;
        case kGoBack:
          state_.angles = last_angles_;
          Place();
          break;
        case kSweep:
          if (next.restart > 0) {
            ScatterAround(run_.start_angles(), run_.ranges(), next.restart, state_.angles);
            Place();
          }
          Sweep(next.sweeps);
          break;
        case kTakeBest:
          state_.angles = best_angles_;
          Place();
          break;
        case kEnd:
          if (course_.has_converged()) return;
          if (course_.HasStalled()) run_.Stall();
          run_.DiscardErrors();
          state_.angles = best_angles_;
          return;
      }
    }
  }

 private:
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
    const IkProblem from_here{state_, problem_.targets, run_.ranges()};
    MomentSweep sweep(tree_, from_here, GaussNewtonSweepOptions(options_));
    for (int i = 0; i < count; ++i) {
      sweep.Sweep();
      state_.angles = sweep.Angles();
      Measure();
      if (!course_.CountSweep() || run_.HasConverged()) break;
    }
  }

  /// One step from `frames_`, at which `step_` is built. Returns the largest change of an angle.
  double Step(const GaussNewtonCourse::Next& next) {
    const std::vector<double>& posture = next.to_start ? run_.start_angles() : state_.angles;
    std::span<const double> change = step_.Solve(state_.angles, posture, run_.ranges(), next.damping);
    const int extra_passes = GaussNewtonCourse::HasExtraPasses(next.damping) ? own_.extra_passes : 0;
    for (int pass = 0; pass < extra_passes && !step_.is_exact(); ++pass) {
      change = step_.Solve(state_.angles, posture, run_.ranges(), next.damping);
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

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions& options_;
  const GaussNewtonOptions& own_;
  IkRun& run_;
  TreeState& state_;
  TreeFrames& frames_;
  GaussNewtonStep step_;
  GaussNewtonCourse course_;
  std::vector<double> best_angles_, last_angles_;
};

}  // namespace

IkSolution SolveGaussNewtonPlainly(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const GaussNewtonOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    Solver(tree, problem, options, own, run, state, frames).Solve();
  });
}

}  // namespace etude

#include "engine/kinematics/solvers/null_space.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/null_space_step.h"

namespace etude {
namespace {

constexpr int kMoreSweeps = 10;  // doubled every time
constexpr int kStepsInTurn = 12;
constexpr double kDamping = 1e-7;
constexpr double kLargestTurn = 0.6;  // radians

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
    for (int turn = 0; run_.MustGoOn() && turn <= kLastTurn; ++turn) {
      Sweep(turn == 0 ? options_.tuning.first_sweeps : kMoreSweeps << (turn - 1));
      Step(turn % 2 == 0);
    }
    if (run_.iterations() < options_.max_iterations) run_.Stall();
    return run_.Finish(std::move(state_.angles));
  }

 private:
  static constexpr int kLastTurn = 6;

  /// Forward kinematics of the present angles, and how far they are off.
  void Measure() {
    ComputeFrames(tree_, state_, frames_);
    MeasureErrors(frames_, problem_.targets, errors_);
    run_.Note(errors_, state_.angles);
  }

  void Sweep(int count) {
    IkProblem from_here{state_, problem_.targets, run_.ranges()};
    IkOptions within_ranges = options_;
    within_ranges.limits = true;
    within_ranges.angle_change_tolerance.reset();
    MomentSweep sweep(tree_, from_here, within_ranges);
    for (int i = 0; i < count && run_.MustGoOn(); ++i) {
      sweep.Sweep();
      run_.Note(sweep.errors(), [&] { return sweep.Angles(); });
    }
    state_.angles = sweep.Angles();
    ComputeFrames(tree_, state_, frames_);
  }

  void Step(bool is_pulled) {
    for (int i = 0; i < kStepsInTurn && run_.MustGoOn(); ++i) {
      step_.Build(frames_);
      const auto change =
          step_.Solve(state_.angles, is_pulled ? run_.start_angles() : state_.angles, run_.ranges(), kDamping);
      if (change.empty()) return;
      double largest = 0;
      for (const double c : change) largest = std::max(largest, std::abs(c));
      const double share = largest > kLargestTurn ? kLargestTurn / largest : 1;
      for (std::size_t d = 0; d < state_.angles.size(); ++d) {
        const AngleRange& range = run_.ranges()[d];
        state_.angles[d] = std::clamp(state_.angles[d] + share * change[d], range.lower, range.upper);
      }
      Measure();
      if (largest < options_.stall_change) return;
    }
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  IkOptions options_;
  IkRun run_;
  TreeState state_;
  TreeFrames frames_;
  std::vector<EffectorError> errors_;
  NullSpaceStep step_;
};

}  // namespace

IkSolution SolveNullSpace(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  return Solver(tree, problem, options).Solve();
}

}  // namespace etude

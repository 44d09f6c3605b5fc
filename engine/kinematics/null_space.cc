#include "engine/kinematics/null_space.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/moment_sweep.h"
#include "engine/kinematics/null_space_step.h"

namespace etude {
namespace {

constexpr int kFirstSweeps = 2;
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
        ranges_(AllowedRanges(problem, options)),
        state_(problem.start),
        step_(tree, problem.targets) {
    options_.weights = WeightRule::kAdaptivePower;
    options_.refresh = WeightRefresh::kSweep;
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      state_.angles[i] = std::clamp(state_.angles[i], ranges_[i].lower, ranges_[i].upper);
    }
    wanted_ = state_.angles;
    solution_.errors.resize(tree.effectors.size());
  }

  IkSolution Solve() {
    Measure();
    for (int turn = 0; CanGoOn(); ++turn) {
      Sweep(turn == 0 ? kFirstSweeps : kMoreSweeps << (turn - 1));
      Step(turn % 2 == 0);
      if (turn >= kLastTurn) break;
    }
    solution_.status = worst_.Within(options_)                           ? IkStatus::kConverged
                       : solution_.iterations >= options_.max_iterations ? IkStatus::kIterationLimit
                                                                         : IkStatus::kStalled;
    solution_.angles = state_.angles;
    return std::move(solution_);
  }

 private:
  static constexpr int kLastTurn = 6;

  bool CanGoOn() const { return !worst_.Within(options_) && solution_.iterations < options_.max_iterations; }

  /// Forward kinematics of the present angles, and how far they are off.
  void Measure() {
    ComputeFrames(tree_, state_, frames_);
    ++solution_.fk_evaluations;
    for (std::size_t e = 0; e < solution_.errors.size(); ++e) {
      solution_.errors[e] = ErrorOf(frames_.effectors[e], problem_.targets[e]);
    }
    worst_ = FindWorst(solution_.errors, problem_.targets);
    if (options_.trace) solution_.trace.push_back({worst_.position, worst_.axis, state_.angles});
  }

  void Sweep(int count) {
    IkProblem from_here{state_, problem_.targets, ranges_};
    IkOptions within_ranges = options_;
    within_ranges.limits = true;
    within_ranges.angle_change_tolerance.reset();
    MomentSweep sweep(tree_, from_here, within_ranges);
    for (int i = 0; i < count && CanGoOn(); ++i) {
      sweep.Sweep();
      ++solution_.iterations;
      if (!options_.trace && i + 1 < count) continue;
      state_.angles = sweep.Angles();
      Measure();
    }
    solution_.fk_evaluations += sweep.fk_evaluations();
  }

  void Step(bool is_pulled) {
    for (int i = 0; i < kStepsInTurn && CanGoOn(); ++i) {
      step_.Build(frames_);
      const auto change = step_.Solve(state_.angles, is_pulled ? wanted_ : state_.angles, ranges_, kDamping);
      if (change.empty()) return;
      double largest = 0;
      for (const double c : change) largest = std::max(largest, std::abs(c));
      const double share = largest > kLargestTurn ? kLargestTurn / largest : 1;
      for (std::size_t d = 0; d < ranges_.size(); ++d) {
        state_.angles[d] = std::clamp(state_.angles[d] + share * change[d], ranges_[d].lower, ranges_[d].upper);
      }
      ++solution_.iterations;
      Measure();
      if (largest < options_.stall_change) return;
    }
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  IkOptions options_;
  const std::vector<AngleRange> ranges_;
  TreeState state_;
  std::vector<double> wanted_;
  TreeFrames frames_;
  NullSpaceStep step_;
  IkSolution solution_;
  WorstError worst_;
};

}  // namespace

IkSolution SolveNullSpace(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  IkSolution solution;
  if (!FindFault(tree, problem, options).empty()) {
    solution.angles.assign(tree.limits.size(), 0.0);
    return solution;
  }
  return Solver(tree, problem, options).Solve();
}

}  // namespace etude

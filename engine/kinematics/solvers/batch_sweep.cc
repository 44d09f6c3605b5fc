#include "engine/kinematics/solvers/batch_sweep.h"

#include <algorithm>
#include <memory>

#include "engine/kinematics/solvers/batch_lanes.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/sweep_tree.h"

namespace etude {
namespace {

// A problem in a lane, with the records that `SolveCcdHinges` keeps.
struct Seat {
  Seat(const KinematicTree& tree, const SweepTree& sweep_tree, const IkProblem& problem, const IkOptions& options)
      : run(tree, problem, options), numbers(sweep_tree, problem, run.ranges()), state(problem.start) {
    state.angles = run.start_angles();
  }

  IkRun run;
  SweepProblem numbers;
  TreeState state;
};

class Batch final : public LaneQueue {
 public:
  Batch(const KinematicTree& tree, const SweepTree& sweep_tree, std::span<const IkProblem> problems,
        const IkOptions& options)
      : tree_(tree),
        sweep_tree_(sweep_tree),
        problems_(problems),
        options_(options),
        solutions_(problems.size()),
        seats_(problems.size()) {}

  int Next() override {
    while (next_ < problems_.size()) {
      const std::size_t n = next_++;
      if (!MomentSweep::CanServe(options_) || !FindFault(tree_, problems_[n], options_).empty()) {
        solutions_[n] = BadInput(tree_);
        continue;
      }
      seats_[n] = std::make_unique<Seat>(tree_, sweep_tree_, problems_[n], options_);
      if (Record(n)) return static_cast<int>(n);
    }
    return -1;
  }

  const SweepProblem& Numbers(int problem) const override { return seats_[problem]->numbers; }

  bool Report(int problem, int sweeps, bool has_stalled, std::span<const double> cosines,
              std::span<const double> sines) override {
    Seat& seat = *seats_[problem];
    for (std::size_t d = 0; d < seat.state.angles.size(); ++d) {
      seat.state.angles[d] = seat.numbers.Angle(static_cast<int>(d), cosines[d], sines[d]);
    }
    if (sweeps > 1) seat.run.RecordMisses(sweeps - 1);
    if (has_stalled) seat.run.Stall();
    return Record(problem);
  }

  std::vector<IkSolution> TakeSolutions() { return std::move(solutions_); }

 private:
  /// Judges the present angles in double. Whether to go on; if not, the problem is done.
  bool Record(std::size_t n) {
    Seat& seat = *seats_[n];
    ComputeFrames(tree_, seat.state, frames_);
    seat.run.RecordFrames(frames_, seat.state.angles);
    if (seat.run.MustGoOn()) return true;
    solutions_[n] = seat.run.Finish(std::move(seat.state.angles));
    seats_[n].reset();
    return false;
  }

  const KinematicTree& tree_;
  const SweepTree& sweep_tree_;
  const std::span<const IkProblem> problems_;
  const IkOptions& options_;
  std::vector<IkSolution> solutions_;
  std::vector<std::unique_ptr<Seat>> seats_;  // of the problems in lanes
  std::size_t next_ = 0;
  TreeFrames frames_;
};

}  // namespace

std::vector<IkSolution> SolveCcdBatch(const KinematicTree& tree, std::span<const IkProblem> problems,
                                      const IkOptions& options, Precision precision) {
  LaneRules rules;
  rules.formula = FormulaOf(options.weights);
  rules.position_goal = options.position_goal;
  rules.axis_goal = options.axis_goal;
  rules.stall_change =
      precision == Precision::kFloat ? std::max(options.stall_change, kFloatStall) : options.stall_change;
  rules.max_sweeps = options.max_iterations;
  rules.reports_every_sweep = options.trace;
  const SweepTree sweep_tree(tree);
  Batch batch(tree, sweep_tree, problems, options);
  SweepLanes(sweep_tree, tree.dof_count(), rules, precision, batch);
  return batch.TakeSolutions();
}

}  // namespace etude
